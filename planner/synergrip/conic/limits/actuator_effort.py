"""|sigma| within the limit of every synergy actuator, sigma = S' tau."""

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
class ActuatorEffort:
    """One bound for each of them; infinity for none."""

    limit: Array
    key: str = "limits.actuator_effort"
    watches: ClassVar[Watches] = "forces"
    couples_knots: ClassVar[bool] = False

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return two bounds for each, in units of the limit."""
        return symmetric_rows(self.key, formulation.response.grasp.synergies, formulation.effort, self.limit)

    def bounded(self, formulation: Formulation, *, cones_hold: bool) -> tuple[Affine, Array]:
        """Return them and their limits."""
        return formulation.effort, self.limit

    def loosened(self, share: float) -> Self:
        """Return it with every bound larger by `share`."""
        return replace(self, limit=frozen(self.limit * (1 + share)))

    def usage(self, formulation: Formulation, motion: Motion) -> Usage:
        """Return the values that the motion reaches."""
        items = formulation.response.grasp.synergies
        return symmetric_usage("actuator effort", "synergy units", items, motion.efforts, self.limit, motion.times)
