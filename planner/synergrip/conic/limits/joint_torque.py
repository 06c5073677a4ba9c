"""|tau| within the limit of every joint (6)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import ClassVar, Self

from synergrip.conic.formulation import Affine, Formulation
from synergrip.conic.limits.limit import Usage, Watches
from synergrip.conic.limits.symmetric import symmetric_rows, symmetric_usage
from synergrip.conic.rows import Rows
from synergrip.linalg import Array, frozen
from synergrip.statics.motion import Motion


@dataclass(frozen=True)
class JointTorque:
    """One bound for each of them; infinity for none."""

    limit: Array
    unit: str = "N m"
    """Of all joints: "N" when all slide; empty when some turn and some slide."""
    key: str = "limits.joint_torque"
    watches: ClassVar[Watches] = "forces"
    couples_knots: ClassVar[bool] = False

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return two bounds for each, in units of the limit."""
        return symmetric_rows(self.key, formulation.response.grasp.joints, formulation.torque, self.limit)

    def bounded(self, formulation: Formulation, *, cones_hold: bool) -> tuple[Affine, Array]:
        """Return them and their limits."""
        return formulation.torque, self.limit

    def loosened(self, share: float) -> Self:
        """Return it with every bound larger by `share`."""
        return replace(self, limit=frozen(self.limit * (1 + share)))

    def usage(self, formulation: Formulation, motion: Motion) -> Usage:
        """Return the values that the motion reaches."""
        items = formulation.response.grasp.joints
        return symmetric_usage("joint torque", self.unit, items, motion.torques, self.limit, motion.times)
