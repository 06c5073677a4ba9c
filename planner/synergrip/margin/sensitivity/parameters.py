"""The numbers of a grasp and a task that margins are differentiated by, and what comes of another value of each."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from synergrip.changes.asked import Asked
from synergrip.changes.turning import contact_dials, friction_dial, limit_dials, load_dial, mass_dial
from synergrip.conic.limits.dial import Dial
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array
from synergrip.margin.sensitivity.moved_contacts import POINT, has_kinematics, moved, turned
from synergrip.margin.sensitivity.sensitivity import Sensitivity
from synergrip.statics.response import Response
from synergrip.tasks.timed_task import TimedTask
from synergrip.values import Value

PER_CENT, PER_MM, PER_DEGREE = ("1 %", 0.01), ("1 mm", 1e-3), ("1 deg", float(np.pi / 180))
"""What is told of a number, a place and a normal: the change, and its size in the unit of the parameter."""
STEP = 1e-4
"""Half of the distance of central differences, in the scale of a parameter."""
ALONG = ("along the normal", "along t", "along o")
ABOUT = ("about t", "about o")
LIMITS = {
    "force_cap": "force cap", "torque": "torque limit", "effort": "effort limit", "rate": "rate limit",
    "acceleration": "acceleration limit", "synergy_range": "reference limit", "joint_range": "joint range",
    "drift": "drift limit", "limit": "limit",
}  # fmt: skip
"""Cause of a dial of a limit -> what it is called here; the margin itself has no dial."""


@dataclass(frozen=True, eq=False, repr=False)
class Parameter(Value):
    """One number, whose own value stands for 0."""

    name: str
    of: str
    direction: str
    at: float | None
    """What it is [SI], where it is one number."""
    told: tuple[str, float]
    """The change that derivatives are told for, and its size in the unit of the parameter."""
    scale: float
    """Size of a change that is a large one: 1, or the length of the grasp [m]."""
    turned: Callable[[float], Asked]
    """What is asked after a change: by a share of a number, by a length [m] or an angle [rad]."""
    same_statics: bool = False
    """Whether G, J and the compliances stay what they are."""
    of_place: bool = False
    """Whether it is the place or the normal of a contact."""
    same_task: bool = False
    """Whether loads and limits stay what they are."""
    of_plan: bool = True
    """Whether the forces or cones of a plan that is there depend on it, and not only what plans there are."""

    def sensitivity(
        self, kind: str, model: str, sides: tuple[float | None, float | None], nothing: float, why: str = ""
    ) -> Sensitivity:  # fmt: skip
        """Return what one-sided derivatives are by it.

        Args:
            kind: of what.
            model: in which model.
            sides: toward less and more, in the scale of the parameter; None where it is not known.
            nothing: [N] what is rounding and told as 0.
            why: there are two; empty where they are one.
        """
        per, step = self.told
        left, right = (
            None if each is None else 0.0 if abs(each) <= nothing else each * step / self.scale for each in sides
        )
        return Sensitivity(
            kind, model, self.name, self.of, self.direction, self.at, per, step, left, right, not why, why
        )


def parameters(asked: Asked, timed: TimedTask, response: Response) -> tuple[Parameter, ...]:
    """Return all numbers that margins are differentiated by.

    Args:
        asked: what is asked, limits filled in.
        timed: the same at its knots.
        response: of the grasp.
    """
    length = response.scale.length
    return (*_frictions(asked), *_loads(asked, timed), *_limits(asked), *_compliances(asked), *_places(asked, length))


def left_out(asked: Asked) -> Mapping[str, str]:
    """Return what there is no derivative by, and why."""
    grasp, missing = asked.grasp, dict[str, str]()
    if not has_kinematics(grasp):
        given = "a grasp given as matrices has no kinematics" if grasp.held is None else "G, J or forces are given"
        missing["position"] = f"{given}: how J changes with the place of a contact is not known"
    if any(grasp.held is None and contact.kind.components != POINT for contact in grasp.contacts):
        missing["normal"] = "a grasp given as matrices says what turned normals do for hard-finger contacts only"
    elif grasp.held is not None and not has_kinematics(grasp):
        missing["normal"] = missing["position"]
    for name, matrix in (("joint", grasp.C_q), ("synergy", grasp.C_z)):
        if not np.any(matrix):
            missing[f"{name} stiffness"] = "they are rigid"
    return missing


def _of_dial(
    dial: Dial[Asked], name: str, of: str, *, same_task: bool = False, of_plan: bool = True
) -> Parameter:  # fmt: skip
    value = dial.value
    return Parameter(
        name, of, "", value, PER_CENT, 1.0, lambda share: dial.turned(value * (1 + share)), same_statics=True,
        same_task=same_task, of_plan=of_plan,
    )  # fmt: skip


def _frictions(asked: Asked) -> Iterator[Parameter]:
    common, each = friction_dial(asked), contact_dials(asked)
    if common is not None and len(each) > 1:
        yield replace(_of_dial(common, "friction", "all contacts", same_task=True), at=None)
    for contact, dial in each.items():
        yield _of_dial(dial, "friction", contact, same_task=True)


def _loads(asked: Asked, timed: TimedTask) -> Iterator[Parameter]:
    if (mass := mass_dial(asked)) is not None:
        yield _of_dial(mass, "mass", "the object")
    elif np.any(timed.wrench) and (load := load_dial(asked, timed)) is not None:
        yield _of_dial(load, "load", "the object")


def _limits(asked: Asked) -> Iterator[Parameter]:
    for dial in limit_dials(asked):
        if dial.cause in LIMITS and dial.value > 0:
            name = "least normal force" if dial.cause == "force_cap" and dial.eased == "down" else LIMITS[dial.cause]
            several = dial.cause in ("drift", "limit")
            yield _of_dial(dial, name, dial.key if several else "the task", of_plan=False)


def _compliances(asked: Asked) -> Iterator[Parameter]:
    """Yield the stiffness of contacts, joints and synergies, each alone; what is rigid stays so."""
    grasp = asked.grasp
    contacts = [(contact.name, rows) for contact, rows in zip(grasp.contacts, grasp.rows, strict=True)]
    joints = [(name, slice(i, i + 1)) for i, name in enumerate(grasp.joints)]
    synergies = [(name, slice(i, i + 1)) for i, name in enumerate(grasp.synergies)]
    of = (
        ("contact", "contacts", "C_s", contacts), ("joint", "joints", "C_q", joints),
        ("synergy", "synergies", "C_z", synergies),
    )  # fmt: skip
    for what, several, matrix, parts in of:
        soft = [(name, rows) for name, rows in parts if np.any(getattr(grasp, matrix)[rows])]
        everything = [(f"all {several}", slice(None))] if len(soft) > 1 else []
        for name, rows in (*everything, *soft):
            yield Parameter(
                f"{what} stiffness", name, "", None, PER_CENT, 1.0, _stiffer(asked, matrix, rows), same_task=True
            )


def _stiffer(asked: Asked, matrix: str, rows: slice) -> Callable[[float], Asked]:
    """Return what comes of a part of a compliance that is stiffer by a share; what couples it goes half along."""
    old = getattr(asked.grasp, matrix)

    def stiffened(share: float) -> Asked:
        sizes = np.ones(len(old))
        sizes[rows] = (1 + share) ** -0.5
        new = {matrix: old * np.outer(sizes, sizes)}
        held = asked.grasp.held
        if held is not None and matrix == "C_q":
            held = replace(held, **new)
        return replace(asked, grasp=replace(asked.grasp, held=held, **new))

    return stiffened


def _places(asked: Asked, length: float) -> Iterator[Parameter]:
    """Yield places and normals of contacts, as far as it is known what comes of others."""
    grasp = asked.grasp
    moves = has_kinematics(grasp)
    for index, contact in enumerate(grasp.contacts):
        if moves:
            for axis, name in zip(np.eye(3), ALONG, strict=True):
                yield Parameter(
                    "position", contact.name, name, None, PER_MM, length, _changed(asked, moved, index, axis),
                    of_place=True, same_task=True,
                )  # fmt: skip
        if moves or (grasp.held is None and contact.kind.components == POINT):
            for axis, name in zip(np.eye(3)[1:], ABOUT, strict=True):
                yield Parameter(
                    "normal", contact.name, name, None, PER_DEGREE, 1.0, _changed(asked, turned, index, axis),
                    of_place=True, same_task=True,
                )  # fmt: skip


def _changed(
    asked: Asked, change: Callable[[Grasp, int, Array], Grasp], index: int, axis: Array
) -> Callable[[float], Asked]:
    return lambda size: replace(asked, grasp=change(asked.grasp, index, size * axis))
