"""The corners of what a task allows for, on one grasp: contacts with the least friction, and every extreme load."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np

from synergrip.conic.allowed import Allowed, Case
from synergrip.errors import InputError, Issue, one_of, raise_issues
from synergrip.grasps.contacts.kind import ContactKind
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, frozen
from synergrip.tasks.allowances import MOST_CASES, Allowances
from synergrip.tasks.profiles import Profile
from synergrip.tasks.scenarios import refuse_scenarios
from synergrip.values import Value

if TYPE_CHECKING:
    from synergrip.tasks.task import Task

KEY = "Task.allow"
FEW = 32
"""Corners, with contacts off to either side, up to which each is a case of its own: a reserve in every cone asks for
more than is needed, and takes less time."""


@dataclass(frozen=True, eq=False, repr=False)
class More(Value):
    """A load beyond the one stated: a share more of the weight and inertia of the object, and a wrench that stays."""

    share: float
    """Of the mass stated, by which there is more of it; less where it is below 0."""
    weight: tuple[Profile, ...]
    """Gravity and inertia of the mass stated."""
    wrench: Array  # (6,)
    factor: float
    """By which the whole load is multiplied."""

    def at(self, times: Array) -> Array:
        """Return it (T, 6) at any times."""
        weight = sum((part.at(times) for part in self.weight), np.zeros((len(times), 6)))
        return frozen(self.factor * (self.share * weight + self.wrench))


def allowed_on(task: Task, grasp: Grasp, weight: tuple[Profile, ...]) -> Allowed | None:
    """Return the corners of what a task allows for; None where it allows for nothing.

    Args:
        task: what is asked.
        grasp: of whom.
        weight: gravity and inertia of its object over the time of the task.

    Raises:
        InputError: no such contact, a mass where nothing is weighed, or more corners than are looked at.
    """
    allow = task.allow
    if allow is None:
        return None
    if allow.scenarios is not None:
        refuse_scenarios(grasp, allow.scenarios, between=task.between == "hold")
    raise_issues([*_unknown(allow, grasp), *_unweighed(allow, grasp, weight)])
    masses, wrenches = _masses(allow, grasp), _wrenches(allow)
    if (count := len(masses) * len(wrenches)) > MOST_CASES:
        message = f"{count} corners of what is allowed are more than the {MOST_CASES} that are looked at"
        raise InputError.at(f"{KEY}.load", f"{message}; give fewer loads, or a box on fewer components")
    cases = [Case("")]
    for (mass, share), wrench in product(masses, wrenches):
        if share or np.any(wrench):
            said = ", ".join(part for part in (mass, _said(wrench)) if part)
            cases.append(Case(said, More(share, weight, frozen(wrench), task.load_factor)))
    found = Allowed(_kinds(allow, grasp), tuple(cases), _gaps(allow, grasp), scenarios=allow.scenarios)
    return replace(found, cornered=found.corners <= FEW)


def _unknown(allow: Allowances, grasp: Grasp) -> Iterator[Issue]:
    names = grasp.contact_names
    for key in ("friction", "contact_gap"):
        given = getattr(allow, key)
        for name in given if isinstance(given, Mapping) else ():
            if name not in names:
                yield Issue(one_of(name, names), key=f"{KEY}.{key}.{name}", on_key=True)
            elif key == "friction" and not grasp.contacts[names.index(name)].friction:
                yield Issue("this contact has no friction", key=f"{KEY}.{key}.{name}", on_key=True)


def _unweighed(allow: Allowances, grasp: Grasp, weight: tuple[Profile, ...]) -> Iterator[Issue]:
    if allow.mass is None:
        return
    if grasp.held is None:
        message = (
            "a grasp given as matrices has no object; give what its weight differs by at both ends as two of 'load'"
        )
        yield Issue(message, key=f"{KEY}.mass", on_key=True)
    elif not weight:
        message = "another mass changes nothing without gravity, or a palm that moves with inertia"
        yield Issue(message, key=f"{KEY}.mass", on_key=True)


def _kinds(allow: Allowances, grasp: Grasp) -> tuple[ContactKind, ...]:
    """Return the contacts (n_c) with the least friction that is allowed, the one stated among it."""
    found = []
    for contact in grasp.contacts:
        kind, own = contact.kind.slippery(1 - allow.friction_share), allow.friction
        given: Any = own.get(contact.name) if isinstance(own, Mapping) else own
        least = kind if given is None else kind.with_friction(given[0])
        found.append(least if least.least_friction < kind.least_friction else kind)
    return tuple(found)


def _masses(allow: Allowances, grasp: Grasp) -> list[tuple[str, float]]:
    """Return the extreme masses, in words and as shares by which they differ from the one stated."""
    if allow.mass is None or grasp.held is None:
        return [("", 0.0)]
    own = grasp.held.body.mass
    ends = sorted({min(allow.mass[0], own), max(allow.mass[1], own)})
    return [(f"mass {end:.6g} kg" if end != own else "", end / own - 1.0) for end in ends]


def _wrenches(allow: Allowances) -> list[Array]:
    """Return the extreme wrenches (6,): the listed ones and none, at every corner of the box."""
    listed = [np.zeros(6), *np.asarray(allow.load)] if len(allow.load) else [np.zeros(6)]
    box = box_corners(np.asarray(allow.load_box))
    return [each + corner for each in listed for corner in box]


def box_corners(half_widths: Array) -> Array:
    """Return the corners (2^k, n) of a box with half-widths (n,), k of which are not 0."""
    return frozen(list(product(*((-half, half) if half else (0.0,) for half in half_widths.tolist()))))


def _said(wrench: Array) -> str:
    return f"load [{' '.join(f'{each:.4g}' for each in wrench)}]" if np.any(wrench) else ""


def _gaps(allow: Allowances, grasp: Grasp) -> Array:
    gap = allow.contact_gap
    if isinstance(gap, Mapping):
        return frozen([gap.get(contact.name, 0.0) for contact in grasp.contacts])
    return frozen(np.full(grasp.n_c, gap))
