"""|dz_r| within the limit of every synergy."""

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
class SynergyReference:
    """One bound for each of them; infinity for none."""

    limit: Array
    key: str = "limits.synergy_reference"
    watches: ClassVar[Watches] = "references"
    couples_knots: ClassVar[bool] = False

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return two bounds for each, in units of the limit."""
        return symmetric_rows(self.key, formulation.response.grasp.synergies, formulation.reference, self.limit)

    def bounded(self, formulation: Formulation, *, cones_hold: bool) -> tuple[Affine, Array]:
        """Return them and their limits."""
        return formulation.reference, self.limit

    def loosened(self, share: float) -> Self:
        """Return it with every bound larger by `share`."""
        return replace(self, limit=frozen(self.limit * (1 + share)))

    def usage(self, formulation: Formulation, motion: Motion) -> Usage:
        """Return the values that the motion reaches."""
        items = formulation.response.grasp.synergies
        return symmetric_usage("synergy reference", "synergy units", items, motion.dz_r, self.limit, motion.times)
