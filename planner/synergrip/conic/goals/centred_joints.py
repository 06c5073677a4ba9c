"""Joints near the middle of their ranges."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from synergrip.conic.formulation import Formulation
from synergrip.conic.goals.goal import Objective, squares_of
from synergrip.conic.rows import Rows
from synergrip.linalg import Array


@dataclass(frozen=True)
class CentredJoints:
    """Minimise the sum of squared distances of the joints from the middle of their ranges, in half ranges.

    Joints without two ends are left out.
    """

    start: Array  # (n_q,) joint values at the start [rad or m]
    lower: Array  # (n_q,)
    upper: Array  # (n_q,)
    name: str = "centred joints"

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return none."""
        return ()

    def objective(self, formulation: Formulation) -> Objective:
        """Return the squares."""
        half = (self.upper - self.lower) / 2
        ends = np.isfinite(half) & (half > 0)
        middle = np.where(ends, (self.lower + self.upper) / 2, 0.0)
        weights = np.where(ends, 1 / np.where(ends, half, 1.0), 0.0)
        return Objective((squares_of(formulation.joint.plus(self.start - middle), weights),))
