"""What forces and motions depart by at references that stay: under another load, or where a contact is not in place."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING

import numpy as np

from synergrip.conic.affine import times
from synergrip.grasps.compliance import joint_compliance, total_compliance
from synergrip.linalg import Array, frozen
from synergrip.statics.shifts import of_shifts
from synergrip.values import Value

if TYPE_CHECKING:
    from synergrip.conic.each_knot import Statics
    from synergrip.grasps.grasp import Grasp

Map = Callable[[Callable[["Statics"], Array]], Array]
"""Returns a map of the statics, the same at all knots or (T, ...) with one for each."""


@dataclass(frozen=True, eq=False, repr=False)
class Departure(Value):
    """What is added at every knot, the same at all (1, ...) or (T, ...) with one for each."""

    force: Array  # (T, n_l) contact forces [N, N m]
    torque: Array  # (T, n_q) of the joints [N m], or forces of slides [N]
    joint: Array  # (T, n_q) joint displacement [rad or m]
    displacement: Array  # (T, 6) of the object [m, rad]

    def beside(self, other: Departure | None) -> Departure:
        """Return this and another one."""
        return self if other is None else together((1, 1), (self, other))


def together(signs: Sequence[int], parts: Sequence[Departure]) -> Departure:
    """Return the sum of some departures, each with its sign."""
    names = [each.name for each in fields(Departure)]
    sums = (sum(sign * getattr(part, name) for sign, part in zip(signs, parts, strict=True)) for name in names)
    return Departure(*(frozen(np.asarray(each)) for each in sums))


def under_load(map_of: Map, change: Array, force: Array | None = None) -> Departure:
    """Return what another load adds, by the maps of each knot: ``-G+ dw``, ``dq/dw dw``, ``du/dw dw``.

    Args:
        map_of: of the formulation.
        change: (T, 6) of the wrench [N, N m].
        force: (T, n_l) what it really adds to the forces, where that is known.
    """
    known = times(map_of(lambda at: at.response.dlambda_dw), change) if force is None else force
    joint, moved = (times(map_of(of), change) for of in (lambda at: at.response.dq_dw, lambda at: at.response.du_dw))
    torque = times(map_of(lambda at: at.response.grasp.J.mT), known)
    return Departure(frozen(known), frozen(torque), frozen(joint), frozen(moved))


def off_place(map_of: Map, grasp: Grasp, gaps: Array) -> list[Departure]:
    """Return what it adds that one contact after the other meets the object early by its gap (n_c,) [m].

    The springs of the contact are shortened by g along its normal. Late is the opposite.

    Args:
        map_of: of the formulation.
        grasp: at the start, whose compliances hold at all knots.
        gaps: of its contacts; one of 0 adds nothing, and is left out.
    """
    if not np.any(gaps > 0):
        return []
    J, S, G = (map_of(of) for of in (
        lambda at: at.response.grasp.J, lambda at: at.response.grasp.S, lambda at: at.response.grasp.G
    ))  # fmt: skip
    of_joints = joint_compliance(grasp.C_q, S, grasp.C_z)
    C = total_compliance(grasp.C_s, J, of_joints)
    own = np.flatnonzero(gaps > 0)
    shifts = np.zeros((grasp.n_l, len(own)))
    shifts[np.asarray(grasp.normal_rows)[own], range(len(own))] = gaps[own]
    found = []
    for force, moved in zip(*(np.moveaxis(each, -1, 0) for each in of_shifts(C, G, shifts)), strict=True):
        torque = (force[..., None, :] @ J)[..., 0, :]
        joint = -(torque[..., None, :] @ of_joints.mT)[..., 0, :]
        found.append(Departure(*(frozen(np.atleast_2d(part)) for part in (force, torque, joint, moved))))
    return found
