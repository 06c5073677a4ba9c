"""|change of dz_r| between knots within a rate for every synergy."""

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
class SynergyRate:
    """One bound [synergy units / s] for each synergy; infinity for none. The first knot is not bounded by it."""

    limit: Array
    key: str = "limits.synergy_rate"
    watches: ClassVar[Watches] = "references"
    couples_knots: ClassVar[bool] = True

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return two bounds for each synergy and step, in units of the limit."""
        if formulation.knots < 2:
            return []
        keep = np.isfinite(self.limit)
        names = [name for name, kept in zip(formulation.response.grasp.synergies, keep, strict=True) if kept]
        steps = np.diff(formulation.times)[:, None] * self.limit[keep]
        moved = np.diff(formulation.reference.constant[:, keep], axis=0) / steps
        # one matrix serves all steps, so the steps are compared in the unit of the longest
        unit = steps.max(axis=0)
        matrix = formulation.reference.matrix[..., keep, :] / unit[:, None]
        result = []
        for side, sign in (("falling", 1.0), ("rising", -1.0)):
            value = Affine(frozen(sign * matrix), frozen((1.0 + sign * moved) * steps / unit))
            before = Earlier(1, frozen(-sign * matrix), frozen(np.ones(len(steps))))
            result.append(nonnegative(self.key, items_of(names, side), value, (before,)))
        return result

    def bounded(self, formulation: Formulation, *, cones_hold: bool) -> None:
        """Return nothing: a rate bounds no value."""

    def loosened(self, share: float) -> Self:
        """Return it with every bound larger by `share`."""
        return replace(self, limit=frozen(self.limit * (1 + share)))

    def usage(self, formulation: Formulation, motion: Motion) -> Usage:
        """Return the rates, each at the knot where its step ends."""
        rates = np.zeros_like(motion.dz_r)
        rates[1:] = np.diff(motion.dz_r, axis=0) / np.diff(motion.times)[:, None]
        items = formulation.response.grasp.synergies
        return symmetric_usage("synergy rate", "synergy units/s", items, rates, self.limit, motion.times)
