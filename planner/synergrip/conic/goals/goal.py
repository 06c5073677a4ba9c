"""What every goal is: squares to be small, or a scalar to be small, and the rows that tie the scalar to the plan."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from synergrip.conic.affine import Affine, times
from synergrip.conic.formulation import Formulation
from synergrip.conic.rows import Earlier, Rows
from synergrip.linalg import Array, frozen


@dataclass(frozen=True)
class Squares:
    """Half the sum of squares of ``matrix v_k + constant[k]``, and of what earlier knots add to it."""

    matrix: Array  # (m, n_v), or (T, m, n_v) with one for each knot
    constant: Array  # (K, m); K = T, or T - lag when earlier knots add to it
    earlier: tuple[Earlier, ...] = ()

    def at(self, v: Array) -> Array:
        """Return the values (K, m) whose squares are summed, at unknowns v (T, n_v)."""
        count = len(self.constant)
        value = self.constant + times(self.matrix, v)[len(v) - count :]
        for part in self.earlier:
            start = len(v) - count - part.lag
            value = value + part.weights[:, None] * times(part.matrix, v)[start : start + count]
        return np.asarray(value)


@dataclass(frozen=True)
class Objective:
    """The squares of a goal, plus ``epigraph`` times its scalar s when it has one."""

    squares: tuple[Squares, ...] = ()
    epigraph: float | None = None

    def squared(self, v: Array) -> float:
        """Return half the sum of the squares at unknowns v (T, n_v)."""
        return sum(float((part.at(v) ** 2).sum()) / 2 for part in self.squares)

    @property
    def empty(self) -> bool:
        """True when nothing is minimised."""
        return not self.squares and self.epigraph is None


class Goal(Protocol):
    """What is best among the plans that hold."""

    @property
    def name(self) -> str:
        """Name in messages."""

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return the rows that tie the scalar to the plan; none for a goal without one."""

    def objective(self, formulation: Formulation) -> Objective:
        """Return what is minimised."""


def squares_of(value: Affine, weights: Array | float = 1.0) -> Squares:
    """Return the squares of affine quantities (m) times `weights` (m,), at every knot."""
    each = np.broadcast_to(np.asarray(weights, dtype=float), (value.constant.shape[1],))
    return Squares(frozen(each[:, None] * value.matrix), frozen(value.constant * each))
