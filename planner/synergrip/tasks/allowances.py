"""What a plan is to hold for beside what its task states, as one value: friction, mass, loads, contacts off place."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from synergrip.documents.naming import naming_arguments
from synergrip.errors import InputError
from synergrip.linalg import Array, frozen
from synergrip.tasks.arguments import Numbers, TaskArguments, keep
from synergrip.tasks.scenarios import Scenarios
from synergrip.tasks.wrenches import COLUMNS
from synergrip.values import ByContent

Interval = tuple[float, float]
MOST_CASES = 256
"""Corners of what is allowed, at most: each is a copy of every friction cone."""


@naming_arguments
@dataclass(frozen=True, eq=False, kw_only=True)
class Allowances(ByContent):
    """Values for all of which a plan is to hold, those that grasp and task state among them.

    Friction: the smallest decides, since the cone of less friction lies in those of more. Loads: forces are affine in
    the load at given references, ``lambda = lambda_0 - G+ dw + E_s alpha``, so that the corners of what is allowed
    decide. Contact gap: a contact that meets the object early or late by g changes the forces by
    ``(I - G+ G) K g``: more corners, or where these are many a reserve in every cone. All of them together are allowed
    for. On a hand corners are executed, too, with contacts early and late.

    Args:
        friction: least and largest coefficient of all contacts, or of those named: ``{"thumb": (0.4, 0.6)}``. Spin
            friction stays.
        friction_share: share by which the friction of all contacts may be less or more, spin friction too, below 1.
        mass: least and largest mass of the object [kg]; gravity and inertia go with it.
        load: (K, 6) wrenches that may act beside the task's, about B [N, N m], each or any mean of them and none.
        load_box: (6,) how large each component of a further wrench may be, either way [N, N m].
        contact_gap: how far contacts may be off along their normals, either way [m]: all of them, or those named.
        scenarios: random errors of places and normals of contacts and of compliance, of which the plan holds for a
            stated share, under the load stated: of a grasp given as matrices at its knots, on a hand as fresh samples
            that are executed say.

    Raises:
        InputError: nothing allowed, or no such numbers.

    Example:
        >>> Allowances(friction=(0.4, 0.8), mass=(0.15, 0.25), load=[(1, 0, 0, 0, 0, 0)]).mass
        (0.15, 0.25)
    """

    friction: Interval | Mapping[str, Interval] | None = None
    friction_share: float = 0.0
    mass: Interval | None = None
    load: Sequence[Numbers] | Array = ()
    load_box: Numbers = (0.0,) * 6
    contact_gap: float | Mapping[str, float] = 0.0
    scenarios: Scenarios | None = None

    def __post_init__(self) -> None:
        """Judge the arguments."""
        judge = TaskArguments("Allowances")
        friction = self.friction
        if isinstance(friction, Mapping):
            friction = {name: _interval(judge, f"friction[{name!r}]", each) for name, each in friction.items()}
        elif friction is not None:
            friction = _interval(judge, "friction", friction)
        share = judge.real("friction_share", self.friction_share, at_least=0)
        if share >= 1:
            judge.refuse("friction_share", f"expected a share of at least 0 and less than 1, got {share:g}")
        mass = None if self.mass is None else _interval(judge, "mass", self.mass, "kg")
        load = self._loads(judge)
        box = np.array(judge.vector("load_box", self.load_box, 6, COLUMNS))
        if np.any(box < 0):
            judge.refuse("load_box", f"expected sizes of at least 0, got {box.min():g}")
        gap: Any = self.contact_gap
        if isinstance(gap, Mapping):
            gap = {name: judge.real(f"contact_gap[{name!r}]", each, at_least=0, unit="m") for name, each in gap.items()}
        else:
            gap = judge.real("contact_gap", gap, at_least=0, unit="m")
        if self.scenarios is not None:
            judge.one("scenarios", self.scenarios, Scenarios, "Scenarios(position=1e-3)")
        keep(self, judge, friction=friction, friction_share=share, mass=mass, load=load, load_box=box, contact_gap=gap)
        if not self.asked:
            what = "friction, friction_share, mass, load, load_box, contact_gap or scenarios"
            raise InputError.at("Allowances", f"nothing is allowed for; give {what}")

    def _loads(self, judge: TaskArguments) -> Array:
        given: Any = self.load
        rows = given.ndim == 2 if isinstance(given, np.ndarray) else isinstance(given, list | tuple)
        if not rows:
            judge.refuse("load", "expected a list of wrenches of 6 numbers each")
            return frozen(np.zeros((0, 6)))
        return frozen(
            np.array([judge.vector(f"load[{i}]", each, 6, COLUMNS) for i, each in enumerate(given)]).reshape(-1, 6)
        )

    @property
    def asked(self) -> bool:
        """Whether anything is allowed for."""
        return self.scenarios is not None or self._guaranteed

    @property
    def without_scenarios(self) -> Allowances | None:
        """What is guaranteed alone; None where that is nothing."""
        return replace(self, scenarios=None) if self._guaranteed else None

    @property
    def _guaranteed(self) -> bool:
        gaps = self.contact_gap.values() if isinstance(self.contact_gap, Mapping) else (self.contact_gap,)
        some = (
            self.friction,
            self.friction_share,
            self.mass,
            np.any(np.asarray(self.load)),
            np.any(self.load_box),
            any(gaps),
        )
        return any(each is not None and bool(each) for each in some)


def _interval(judge: TaskArguments, name: str, value: Any, unit: str = "") -> Interval:
    """Return a least and a largest value greater than 0, after noting that they are none."""
    before = len(judge.issues)
    low, high = judge.vector(name, value, 2, f"the least and the largest value{f' in {unit}' if unit else ''}")
    if len(judge.issues) == before and not 0 < low <= high:
        wrong = f"the least value {low:g} exceeds the largest, {high:g}; swap them" if low > 0 else ""
        judge.refuse(name, wrong or f"expected numbers greater than 0, got {low:g}")
    return (low, high)
