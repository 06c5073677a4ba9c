"""Several sums of squares at once, each with its weight."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from synergrip.conic.formulation import Formulation
from synergrip.conic.goals.goal import Goal, Objective, Squares
from synergrip.conic.rows import Rows
from synergrip.linalg import frozen


@dataclass(frozen=True)
class WeightedSum:
    """Minimise the sum of weight times goal, over goals that are sums of squares, each in the units stated for it."""

    goals: tuple[tuple[Goal, float], ...]

    @property
    def name(self) -> str:
        """Name in messages."""
        return " + ".join(f"{weight:g} {goal.name}" for goal, weight in self.goals)

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return none: sums of squares have no scalar."""
        return ()

    def objective(self, formulation: Formulation) -> Objective:
        """Return all the squares, each times the root of its weight."""
        stated = replace(formulation, units=formulation.stated)
        parts = ((part, weight) for goal, weight in self.goals for part in goal.objective(stated).squares)
        return Objective(tuple(_times(part, float(np.sqrt(weight))) for part, weight in parts))


def _times(squares: Squares, factor: float) -> Squares:
    earlier = tuple(replace(part, weights=frozen(factor * part.weights)) for part in squares.earlier)
    matrix, constant = frozen(factor * squares.matrix), frozen(factor * squares.constant)
    return replace(squares, matrix=matrix, constant=constant, earlier=earlier)
