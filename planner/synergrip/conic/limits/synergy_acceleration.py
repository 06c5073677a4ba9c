"""|second difference of dz_r| over the knots within an acceleration for every synergy."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import ClassVar, Self

import numpy as np

from synergrip.conic.formulation import Affine, Formulation
from synergrip.conic.limits.limit import Usage, Watches
from synergrip.conic.limits.symmetric import symmetric_usage
from synergrip.conic.rows import Earlier, Rows, items_of, nonnegative
from synergrip.linalg import Array, frozen
from synergrip.statics.motion import Motion


@dataclass(frozen=True)
class SynergyAcceleration:
    """One bound [synergy units / s^2] for each synergy; infinity for none.

    The acceleration at knot k - 1 is that of the parabola through knots k - 2, k - 1, k:
    ``2 ((z_k - z_(k-1)) / h_k - (z_(k-1) - z_(k-2)) / h_(k-1)) / (h_k + h_(k-1))``, whatever the steps h.
    """

    limit: Array
    key: str = "limits.synergy_acceleration"
    watches: ClassVar[Watches] = "references"
    couples_knots: ClassVar[bool] = True

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return two bounds for each synergy and inner knot, in units of the longest steps' bound."""
        keep = np.isfinite(self.limit)
        if formulation.knots < 3 or not np.any(keep):
            return []
        ratio, step = _steps(formulation.times)
        room = step[:, None] * self.limit[keep]
        unit = room.max(axis=0)
        matrix = formulation.reference.matrix[..., keep, :] / unit[:, None]
        z = formulation.reference.constant[:, keep]
        known = (z[2:] - (1 + ratio[:, None]) * z[1:-1] + ratio[:, None] * z[:-2]) / unit
        names = [name for name, kept in zip(formulation.response.grasp.synergies, keep, strict=True) if kept]
        result = []
        for side, sign in (("falling", 1.0), ("rising", -1.0)):
            value = Affine(frozen(sign * matrix), frozen(room / unit + sign * known))
            earlier = (
                Earlier(1, frozen(-sign * matrix), frozen(1 + ratio)),
                Earlier(2, frozen(sign * matrix), frozen(ratio)),
            )
            result.append(nonnegative(self.key, items_of(names, side), value, earlier))
        return result

    def bounded(self, formulation: Formulation, *, cones_hold: bool) -> None:
        """Return nothing: an acceleration bounds no value."""

    def loosened(self, share: float) -> Self:
        """Return it with every bound larger by `share`."""
        return replace(self, limit=frozen(self.limit * (1 + share)))

    def usage(self, formulation: Formulation, motion: Motion) -> Usage:
        """Return the accelerations, each at its knot; 0 at the first and the last."""
        found = np.zeros_like(motion.dz_r)
        if len(motion.times) > 2:
            h = np.diff(motion.times)[:, None]
            rates = np.diff(motion.dz_r, axis=0) / h
            found[1:-1] = 2 * np.diff(rates, axis=0) / (h[1:] + h[:-1])
        items = formulation.response.grasp.synergies
        return symmetric_usage("synergy acceleration", "synergy units/s²", items, found, self.limit, motion.times)


def _steps(times: Array) -> tuple[Array, Array]:
    """Return h_k / h_(k-1) and h_k (h_k + h_(k-1)) / 2, both (T - 2,)."""
    h = np.diff(times)
    return h[1:] / h[:-1], h[1:] * (h[1:] + h[:-1]) / 2
