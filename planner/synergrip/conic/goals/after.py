"""A goal that comes after others: what they determined stays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from synergrip.conic.goals.goal import Goal, Objective, Squares
from synergrip.conic.rows import Kind, Rows
from synergrip.conic.situation import Situation
from synergrip.linalg import Array, frozen, split


@dataclass(frozen=True)
class Held:
    """What an earlier goal determined: the best plans by a sum of squares agree in everything that is squared."""

    squares: Squares
    v: Array
    """(T, n_v) unknowns of a best plan."""
    key: str = "goals before"

    def rows(self) -> Rows:
        """Return equality rows: the squared quantities are what they are at `v`, without repeating themselves."""
        parts = (self.squares.matrix, *(part.matrix for part in self.squares.earlier))
        kept = split(np.hstack(parts).T).row_space.T  # (rank, m): combinations that say all there is to say
        matrix, *others = (kept @ part for part in parts)
        earlier = tuple(
            replace(part, matrix=frozen(other)) for part, other in zip(self.squares.earlier, others, strict=True)
        )
        still = replace(self.squares, constant=frozen(0 * self.squares.constant))
        items = tuple(f"combination {i + 1}" for i in range(len(kept)))
        zero = frozen(np.zeros(len(kept)))
        return Rows(self.key, Kind.ZERO, 1, items, frozen(matrix), frozen(-still.at(self.v) @ kept.T), zero, earlier)

    @property
    def determines(self) -> Array:
        """(n_v, r) orthonormal directions of the unknowns of a knot that cannot change; none with earlier knots."""
        if self.squares.earlier:
            return np.zeros((self.v.shape[1], 0))
        return split(self.squares.matrix).row_space


@dataclass(frozen=True)
class After:
    """A goal among the plans that are best by the goals before it."""

    goal: Goal
    held: tuple[Held, ...]

    @property
    def name(self) -> str:
        """Name in messages."""
        return self.goal.name

    def rows(self, situation: Situation) -> Sequence[Rows]:
        """Return the rows of the goal and of what is held."""
        return [*self.goal.rows(situation), *(held.rows() for held in self.held)]

    def objective(self, situation: Situation) -> Objective:
        """Return that of the goal."""
        return self.goal.objective(situation)
