"""The way from plain arrays to the compiled kernel and back: eight problems side by side in every entry."""

from __future__ import annotations

from itertools import accumulate
from typing import Any, NamedTuple

import numpy as np

from synergrip.batch.compiling import Compiled, as_rows
from synergrip.batch.cone_problems import ConeProblems, ConeSolutions, Tolerance
from synergrip.linalg import Array

SOURCES = ("lanes.py", "lanes_algebra.py", "lanes_linear.py", "lanes_rows.py", "lanes_kernel.py", "numpy_kernel.py")
"""What the compiled kernel is made of."""


class Layout(NamedTuple):
    """Where things are in the workspace of eight problems, and how many: given, answers, and what is on the way."""

    n: int
    m: int
    wide: int
    """Columns of R and H: n, or one more, so that they are even."""
    pairs: int
    """Half-lines with opposite rows, which come first."""
    rows: int
    """Rows of A without the second ones of these."""
    quadratic: int
    """0 where P is."""
    P: int
    q: int
    A: int
    b: int
    enough: int
    x: int
    s: int
    z: int
    status: int
    iterations: int
    v: int
    beta: int
    under: int
    point: int
    over: int
    turn: int
    R: int
    H: int
    rx: int
    rs: int
    scaled_rs: int
    dx: int
    ds: int
    dz: int
    aim: int
    one: int
    end: int

    @classmethod
    def of(cls, n: int, m: int, cones: int, pairs: int, quadratic: bool) -> Layout:
        """Return the layout of programs with n unknowns and m rows in so many cones."""
        wide, rows = n + n % 2, m - pairs
        given, answers = (n * n, n, rows * n, m, 1), (n, m, m, 1, 1)
        on_the_way = (m, cones, cones, m, cones, 2 * pairs, rows * wide, wide * wide, n, m, m, n, m, m, m, rows)
        return cls(n, m, wide, pairs, rows, int(quadratic), *accumulate((0, *given, *answers, *on_the_way)))


def solve(problems: ConeProblems, tolerance: Tolerance, enough: Array) -> ConeSolutions:
    """Solve problems side by side; arguments as of `numpy_kernel.solve`."""
    N, n, m, pairs = len(problems), problems.q.shape[-1], problems.b.shape[1], problems.pairs
    starts = np.cumsum((0, *problems.sizes[:-1]))
    cones = np.array([starts, problems.sizes], dtype=np.int64).T.copy()
    at = Layout.of(n, m, len(cones), pairs, len(problems.P) > 1 or bool(problems.P.any()))
    P, q, A, b, low = map(as_rows, (problems.P, problems.q, problems.A, problems.b, enough[:, None]))
    spans = np.array([(0, n * n), (0, n), (0, pairs * n), (2 * pairs * n, (m - 2 * pairs) * n), (0, m), (0, 1)])
    found = np.empty((N, at.v - at.x))
    compiled()((P, q, A, A, b, low), spans, found, at, cones, *tolerance)
    x, s, z, told = np.split(found, (n, n + m, n + 2 * m), axis=1)
    return ConeSolutions(x, s, z, told[:, 0].astype(np.int8), told[:, 1].astype(np.int32))


def _made(stamp: int) -> Any:
    from synergrip.batch.lanes_kernel import made

    return made(stamp)


def _prepare(function: Any) -> None:
    """Solve no problem at all."""
    nothing = (as_rows(np.zeros((1, 1))),) * 6
    layout, cones = Layout.of(1, 1, 1, 0, False), np.ones((1, 2), dtype=np.int64)
    function(nothing, np.zeros((6, 2), dtype=np.int64), np.zeros((0, 1)), layout, cones, *Tolerance())


compiled = Compiled("kernel", SOURCES, _made, _prepare, "about ten seconds")
