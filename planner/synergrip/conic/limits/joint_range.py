"""Every joint within its range along the plan, not only at the start."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import ClassVar, Self

import numpy as np

from synergrip.conic.formulation import Affine, Formulation
from synergrip.conic.limits.limit import Usage, Watches
from synergrip.conic.rows import Rows, within
from synergrip.linalg import Array, frozen
from synergrip.statics.motion import Motion


@dataclass(frozen=True)
class JointRange:
    """``lower <= q + dq <= upper`` for every joint; infinity for none."""

    start: Array  # (n_q,) joint values at the start [rad or m]
    lower: Array  # (n_q,)
    upper: Array  # (n_q,)
    unit: str = "rad"
    """Of all joints; empty when some turn and some slide."""
    key: str = "limits.joint_range"
    watches: ClassVar[Watches] = "references"
    couples_knots: ClassVar[bool] = False

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return two bounds for each joint, in units of half its range."""
        names = formulation.response.grasp.joints
        return within(self.key, names, formulation.joint.plus(self.start), self.lower, self.upper, self._unit)

    def bounded(self, formulation: Formulation, *, cones_hold: bool) -> tuple[Affine, Array]:
        """Return the joint displacements and how far they may go."""
        return formulation.joint, np.maximum(self.upper - self.start, self.start - self.lower)

    def loosened(self, share: float) -> Self:
        """Return it with ranges wider by `share` of half of each."""
        more = share * self._unit
        return replace(self, lower=frozen(self.lower - more), upper=frozen(self.upper + more))

    def usage(self, formulation: Formulation, motion: Motion) -> Usage:
        """Return the joint values that the motion reaches."""
        names = formulation.response.grasp.joints
        value = frozen(self.start + motion.dq)
        return Usage("joint value", self.unit, names, value, self.lower, self.upper, self._unit, motion.times)

    @property
    def _unit(self) -> Array:
        half = (self.upper - self.lower) / 2
        return np.where(np.isfinite(half) & (half > 0), half, 1.0)
