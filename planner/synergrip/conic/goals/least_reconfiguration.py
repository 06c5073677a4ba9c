"""The smallest use of redundancy, with all forces held."""

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
    """Minimise ``sum ||gamma||^2`` with alpha fixed: the last word, so that no part of the answer is arbitrary."""

    v: Array
    """(T, n_v) unknowns whose alpha is held."""
    name: str = "least reconfiguration"

    def rows(self, situation: Situation) -> Sequence[Rows]:
        """Return ``alpha = alpha of v``."""
        n, m = situation.n_v, situation.n_alpha
        held = frozen(-self.v[:, :m])
        items = tuple(f"alpha_{i + 1}" for i in range(m))
        return [Rows("forces", Kind.ZERO, 1, items, frozen(np.eye(m, n)), held, frozen(np.zeros(m)))]

    def objective(self, situation: Situation) -> Objective:
        """Return the squares of gamma in reference units."""
        n, m = situation.n_v, situation.n_alpha
        return Objective(np.diag(np.r_[np.zeros(m), np.ones(n - m)]), np.zeros((situation.knots, n)), None)
