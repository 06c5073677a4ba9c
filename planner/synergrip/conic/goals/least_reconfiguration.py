"""The smallest use of redundancy, with all forces and rigid motions held."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from synergrip.conic.goals.goal import Objective
from synergrip.conic.rows import Kind, Rows
from synergrip.conic.situation import Situation
from synergrip.linalg import Array, frozen


@dataclass(frozen=True)
class LeastReconfiguration:
    """Minimise ``sum ||gamma||^2`` with alpha and beta fixed: the last word, so that nothing is left arbitrary."""

    v: Array
    """(T, n_v) unknowns of which all but gamma is held."""
    name: str = "least reconfiguration"

    def rows(self, situation: Situation) -> Sequence[Rows]:
        """Return ``alpha = alpha of v`` and, where it is an unknown, ``beta = beta of v``."""
        result = []
        parts = (("forces", "alpha", situation.alpha), ("rigid motion", "beta", situation.beta))
        for key, letter, part in parts:
            kept = np.flatnonzero(np.any(part.matrix, axis=0))
            if len(kept):
                items = tuple(f"{letter}_{i + 1}" for i in range(len(kept)))
                chosen, zero = np.eye(situation.n_v)[kept], np.zeros(len(kept))
                result.append(Rows(key, Kind.ZERO, 1, items, frozen(chosen), frozen(-self.v[:, kept]), frozen(zero)))
        return result

    def objective(self, situation: Situation) -> Objective:
        """Return the squares of gamma in reference units."""
        free = np.any(situation.gamma.matrix, axis=0).astype(float)
        return Objective(np.diag(free), np.zeros((situation.knots, situation.n_v)), None)
