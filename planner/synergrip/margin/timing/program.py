"""The second-order cone program of the fastest timing.

With the lengths h of the parts the time is the sum of ``2 h / (sqrt(b_k) + sqrt(b_k+1))``. Three unknowns stand for it:
b, ``c <= sqrt(b)`` and ``d >= 1 / (c_k + c_k+1)``, both rotated cones, and the sum of ``2 h d`` is to be small.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy import sparse

from synergrip.conic.program import Block, Program
from synergrip.conic.relaxed import heads
from synergrip.conic.rows import Item, Kind
from synergrip.conic.variable_bounds import LARGEST
from synergrip.linalg import Array, Places, frozen
from synergrip.margin.timing.by_length import seconds_of
from synergrip.margin.timing.matrices import Sparse, below, beside, empty, ends, eye, interleaved, scaled
from synergrip.margin.timing.question import TimingQuestion
from synergrip.values import Value

TIMING = "timing"
"""What its own rows are called."""
FASTEST = 100.0
"""Of b, in its unit: far beyond it numbers differ too much in size, and it is asked again in another unit."""


@dataclass(frozen=True, eq=False, repr=False)
class TimingProgram(Value):
    """A program whose unknowns are v at the grid points, b and c where the palm moves, and d of each part."""

    question: TimingQuestion
    unit: float
    """Of b [m^2/s^2]."""

    @cached_property
    def moving(self) -> Places:
        """The grid points where the palm is not at rest."""
        points = np.arange(len(self.question.parts) + 1)
        return np.setdiff1d(points, self.question.stops)

    @property
    def sizes(self) -> tuple[int, int, int, int]:
        """How many unknowns v, b, c and d are."""
        count, n = len(self.moving), len(self.question.parts)
        return (n + 1) * self.question.formulation.n_v, count, count, n

    @cached_property
    def spread(self) -> Sparse:
        """(n + 1, m) from the unknowns b, or c, to all grid points."""
        return sparse.csr_matrix(eye(len(self.question.parts) + 1)[:, self.moving])

    @property
    def seconds(self) -> float:
        """Of one unit of the objective: the time on the way at a speed of one unit [s]."""
        return self.question.length / float(np.sqrt(self.unit))

    @cached_property
    def program(self) -> Program:
        """The program: rows of all limits first."""
        return self.with_reserve(np.zeros(len(self.question.parts)))

    def with_reserve(self, reserve: Array) -> Program:
        """Return the program with less room (n,) in the cones of each part, in the units of their rows."""
        rest, instant = self.question.rows.at_rest, self.question.rows.instant
        timing, right, blocks = self._own()
        n = sum(self.sizes)
        cost = np.zeros(n)
        cost[n - self.sizes[3] :] = 2 * self.question.parts / self.question.length
        return Program(
            sparse.csc_matrix((n, n)), frozen(cost), sparse.csc_matrix(below((self._of_limits(), timing))),
            frozen(np.concatenate([rest.b - reserve[instant // 2] * heads(rest), right])), (*rest.blocks, *blocks),
            len(self.question.parts) + 1, self.question.formulation.n_v, frozen(np.full(n, LARGEST)),
        )  # fmt: skip

    def _of_limits(self) -> Sparse:
        """Return the rows of all limits, (m, N): v and b at the instants that they speak of, a as the slope of b."""
        rows, parts = self.question.rows, self.question.parts
        sides = ends(len(parts))
        slope = scaled(1 / (2 * parts), sides[1] - sides[0])
        points, slopes = interleaved(sides), interleaved((slope, slope))
        of_v = rows.at_rest.A @ sparse.kron(points, eye(self.question.formulation.n_v))
        of_b = scaled(rows.of_a, slopes[rows.instant]) + scaled(rows.of_b, points[rows.instant])
        rest = empty(len(rows.of_a), self.sizes[2] + self.sizes[3])
        return beside(sparse.csr_matrix(of_v), sparse.csr_matrix(-self.unit * of_b @ self.spread), rest)

    def _own(self) -> tuple[Sparse, Array, tuple[Block, ...]]:
        """Return the rows of the timing itself: ``c^2 <= b``, ``1 <= d (c_k + c_k+1)``, and b is not without end."""
        n_v, m, _, n = self.sizes
        both = sparse.csr_matrix(sum(ends(n), empty(n, n + 1)) @ self.spread)
        of_b = beside(empty(m, n_v), -eye(m), empty(m, m + n))
        of_c = beside(empty(m, n_v + m), -2 * eye(m), empty(m, n))
        more = beside(empty(n, n_v + m), -both, -eye(n))
        less = beside(empty(n, n_v + m), both, -eye(n))
        root, time = interleaved((of_b, of_c, of_b)), interleaved((more, empty(n, sum(self.sizes)), less))
        right = np.concatenate([np.tile([1.0, 0.0, -1.0], m), np.tile([0.0, 2.0, 0.0], n), np.full(m, FASTEST)])
        blocks = (
            Block(TIMING, Kind.SECOND_ORDER, 3, (Item("speed"),), 0, m),
            Block(TIMING, Kind.SECOND_ORDER, 3, (Item("time"),), 0, n),
            Block(TIMING, Kind.NONNEGATIVE, 1, (Item("speed", "highest"),), 0, m),
        )
        return below((root, time, -of_b)), right, blocks

    def plan(self, x: Array) -> tuple[Array, Array]:
        """Return v (n + 1, n_v) and b (n + 1,) [m^2/s^2] of a solution."""
        n_v, m, *_ = self.sizes
        v = x[:n_v].reshape(len(self.question.parts) + 1, -1)
        return v, np.maximum(self.unit * (self.spread @ x[n_v : n_v + m]), 0.0)


def duration(question: TimingQuestion, b: Array) -> float:
    """Return how long the way takes with squares of the speed b (n + 1,) at the grid points [s]."""
    return float(seconds_of(question.parts, b).sum())
