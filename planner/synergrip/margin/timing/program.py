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
    def spread(self) -> sparse.csr_matrix:
        """(n + 1, m) from the unknowns b, or c, to all grid points."""
        count = len(self.moving)
        shape = (len(self.question.parts) + 1, count)
        return sparse.csr_matrix((np.ones(count), (self.moving, np.arange(count))), shape=shape)

    @property
    def seconds(self) -> float:
        """Of one unit of the objective: the time on the way at a speed of one unit [s]."""
        return self.question.length / float(np.sqrt(self.unit))

    @cached_property
    def program(self) -> Program:
        """The program: rows of all limits first."""
        return self.with_reserve(0.0)

    def with_reserve(self, reserve: float) -> Program:
        """Return the program with that much less room in the cones of all limits, in the units of their rows."""
        rest = self.question.rows.at_rest
        timing, right, blocks = self._own()
        n = sum(self.sizes)
        cost = np.zeros(n)
        cost[n - self.sizes[3] :] = 2 * self.question.parts / self.question.length
        return Program(
            sparse.csc_matrix((n, n)), frozen(cost), sparse.csc_matrix(sparse.vstack([self._of_limits(), timing])),
            frozen(np.concatenate([rest.b - reserve * heads(rest), right])), (*rest.blocks, *blocks),
            len(self.question.parts) + 1, self.question.formulation.n_v, frozen(np.full(n, LARGEST)),
        )  # fmt: skip

    def _of_limits(self) -> sparse.csr_matrix:
        """Return the rows of all limits, (m, n)."""
        rows, parts = self.question.rows, self.question.parts
        n, n_v = len(parts), self.question.formulation.n_v
        part, side = np.divmod(np.arange(2 * n), 2)
        points = sparse.csr_matrix((np.ones(2 * n), (np.arange(2 * n), part + side)), shape=(2 * n, n + 1))
        slope = sparse.csr_matrix(
            (np.tile([-1.0, 1.0], 2 * n) / np.repeat(2 * parts[part], 2),
             (np.repeat(np.arange(2 * n), 2), np.column_stack([part, part + 1]).ravel())), shape=(2 * n, n + 1),
        )  # fmt: skip
        of_v = rows.at_rest.A @ sparse.kron(points, sparse.eye_array(n_v))
        at = sparse.csr_matrix((np.ones(len(rows.of_a)), (np.arange(len(rows.of_a)), rows.instant)),
                               shape=(len(rows.of_a), 2 * n))  # fmt: skip
        of_b = sparse.diags_array(rows.of_a) @ at @ slope + sparse.diags_array(rows.of_b) @ at @ points
        rest = sparse.csr_matrix((len(rows.of_a), self.sizes[2] + n))
        return sparse.hstack([of_v, -self.unit * of_b @ self.spread, rest], format="csr")

    def _own(self) -> tuple[sparse.csr_matrix, Array, tuple[Block, ...]]:
        """Return the rows of the timing itself: ``c^2 <= b``, ``1 <= d (c_k + c_k+1)``, and b is not without end."""
        n_v, m, _, n = self.sizes
        one, none = sparse.eye_array(m, format="csr"), sparse.csr_matrix((m, m))
        ends = sparse.csr_matrix(abs(_difference(n)) @ self.spread)
        of_time, empty = sparse.eye_array(n, format="csr"), sparse.csr_matrix((n, m))
        away = [sparse.csr_matrix((count, n_v)) for count in (m, n)]
        far = sparse.csr_matrix((m, n))
        root = _interleaved([
            sparse.hstack([away[0], -one, none, far]), sparse.hstack([away[0], none, -2 * one, far]),
            sparse.hstack([away[0], -one, none, far]),
        ])  # fmt: skip
        time = _interleaved([
            sparse.hstack([away[1], empty, -ends, -of_time]), sparse.csr_matrix((n, n_v + 2 * m + n)),
            sparse.hstack([away[1], empty, ends, -of_time]),
        ])  # fmt: skip
        cap = sparse.hstack([away[0], one, none, far])
        right = np.concatenate([np.tile([1.0, 0.0, -1.0], m), np.tile([0.0, 2.0, 0.0], n), np.full(m, FASTEST)])
        blocks = (
            Block(TIMING, Kind.SECOND_ORDER, 3, (Item("speed"),), 0, m),
            Block(TIMING, Kind.SECOND_ORDER, 3, (Item("time"),), 0, n),
            Block(TIMING, Kind.NONNEGATIVE, 1, (Item("speed", "highest"),), 0, m),
        )
        return sparse.vstack([root, time, cap], format="csr"), right, blocks

    def plan(self, x: Array) -> tuple[Array, Array]:
        """Return v (n + 1, n_v) and b (n + 1,) [m^2/s^2] of a solution."""
        n_v, m, *_ = self.sizes
        v = x[:n_v].reshape(len(self.question.parts) + 1, -1)
        return v, np.maximum(self.unit * (self.spread @ x[n_v : n_v + m]), 0.0)


def duration(question: TimingQuestion, b: Array) -> float:
    """Return how long the way takes with squares of the speed b (n + 1,) at the grid points [s]."""
    speeds = np.sqrt(b)
    return float((2 * question.parts / (speeds[:-1] + speeds[1:])).sum())


def _difference(n: int) -> sparse.csr_matrix:
    """Return (n, n + 1), the end of each part less its start."""
    return sparse.csr_matrix(sparse.diags_array([-np.ones(n), np.ones(n)], offsets=[0, 1], shape=(n, n + 1)))


def _interleaved(parts: list[sparse.csr_matrix]) -> sparse.csr_matrix:
    """Return the first rows of all parts, then the second ones, and so on."""
    count, height = len(parts), parts[0].shape[0]
    order = np.arange(count * height).reshape(count, height).T.ravel()
    return sparse.csr_matrix(sparse.csr_matrix(sparse.vstack(parts))[order])
