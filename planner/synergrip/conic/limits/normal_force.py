"""Normal force of every contact within a range."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import ClassVar, Self

import numpy as np

from synergrip.conic.formulation import Affine, Formulation
from synergrip.conic.limits.friction_cone import carried
from synergrip.conic.limits.limit import Usage, Watches
from synergrip.conic.rows import Rows, within
from synergrip.linalg import Array
from synergrip.statics.motion import Motion

FAR = 1e3
"""A bound this many times the force unit hardly binds."""


@dataclass(frozen=True)
class NormalForce:
    """``lower <= n <= upper`` at every contact."""

    lower: float  # [N]
    upper: float  # [N], infinity for none
    key: str = "limits.normal_force"
    watches: ClassVar[Watches] = "forces"
    couples_knots: ClassVar[bool] = False

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return two bounds per contact, in `bound_unit`; that contacts push, friction cones say already."""
        grasp = formulation.response.grasp
        value = formulation.force.after(normal_selection(formulation))
        lower, none = self.lower if self.lower > 0 else -np.inf, np.full(grasp.n_c, np.inf)
        low, high = np.full(grasp.n_c, lower), np.full(grasp.n_c, self.upper)
        units = [np.full(grasp.n_c, bound_unit(bound, formulation.force_unit)) for bound in (lower, self.upper)]
        names = _names(formulation)
        return [
            *within(self.key, names, value, low, none, units[0]),
            *within(self.key, names, value, -none, high, units[1]),
        ]

    def bounded(self, formulation: Formulation, *, cones_hold: bool) -> tuple[Affine, Array] | None:
        """Return the whole forces, which a largest normal force bounds through the cones; nothing without them."""
        if not cones_hold or not np.isfinite(self.upper):
            return None
        contacts = formulation.response.grasp.contacts
        return formulation.force, np.concatenate([contact.kind.most * self.upper for contact in contacts])

    def loosened(self, share: float) -> Self:
        """Return it with a range wider by `share` of its ends."""
        return replace(self, lower=self.lower - share * abs(self.lower), upper=self.upper + share * abs(self.upper))

    def usage(self, formulation: Formulation, motion: Motion) -> Usage:
        """Return the normal forces."""
        starts = formulation.response.grasp.normal_rows
        count = len(starts)
        return Usage(
            "normal force", "N", _names(formulation), motion.forces[:, starts],
            np.full(count, self.lower), np.full(count, self.upper), np.full(count, formulation.load_size), motion.times,
            carried(formulation, motion),
        )  # fmt: skip


def bound_unit(bound: float, force_unit: float) -> float:
    """Return the unit [N] of the rows of a bound: its own where it is far from all forces, to drown nothing."""
    return abs(bound) if np.isfinite(bound) and abs(bound) > FAR * force_unit else force_unit


def normal_selection(formulation: Formulation) -> Array:
    """Return (n_c, n_l): the normal component of each contact."""
    grasp = formulation.response.grasp
    return np.eye(grasp.n_l)[grasp.normal_rows]


def _names(formulation: Formulation) -> tuple[str, ...]:
    return tuple(contact.name for contact in formulation.response.grasp.contacts)
