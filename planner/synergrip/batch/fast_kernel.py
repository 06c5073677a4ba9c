"""The way from plain arrays to the compiled kernel and back: eight problems side by side in every entry."""

from __future__ import annotations

from itertools import accumulate
from typing import Any, NamedTuple

import numpy as np

from synergrip.batch.compiling import Compiled
from synergrip.batch.cone_problems import ConeProblems, ConeSolutions, Tolerance
from synergrip.linalg import Array

SOURCES = ("lanes.py", "lanes_algebra.py", "lanes_linear.py", "lanes_kernel.py", "numpy_kernel.py")
"""What the compiled kernel is made of."""


class Layout(NamedTuple):
    """Where things are in the workspace of eight problems, and how many: given, answers, and what is on the way."""

    n: int
    m: int
    wide: int
    """Columns of R and H: n, or one more, so that they are even."""
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
    point: int
    R: int
    H: int
    rx: int
    rs: int
    scaled_rs: int
    dx: int
    ds: int
    dz: int
    aim: int
    end: int

    @classmethod
    def of(cls, n: int, m: int, cones: int) -> Layout:
        """Return the layout of programs with n unknowns and m rows in so many cones."""
        wide = n + n % 2
        given, answers = (n * n, n, m * n, m, 1), (n, m, m, 1, 1)
        on_the_way = (m, cones, m, m * wide, wide * wide, n, m, m, n, m, m, m)
        return cls(n, m, wide, *accumulate((0, *given, *answers, *on_the_way)))


def solve(problems: ConeProblems, tolerance: Tolerance, enough: Array) -> ConeSolutions:
    """Solve problems side by side; arguments as of `numpy_kernel.solve`."""
    N, n, m = len(problems), problems.q.shape[-1], problems.b.shape[1]
    starts = np.cumsum((0, *problems.sizes[:-1]))
    cones = np.array([starts, problems.sizes], dtype=np.int64).T.copy()
    found = compiled()(_in_lanes(problems, enough), Layout.of(n, m, len(cones)), cones, *tolerance)
    flat = found.transpose(0, 2, 1).reshape(-1, found.shape[1])[:N]
    x, s, z, told = np.split(flat, (n, n + m, n + 2 * m), axis=1)
    return ConeSolutions(x, s, z, told[:, 0].astype(np.int8), told[:, 1].astype(np.int32))


def _in_lanes(problems: ConeProblems, enough: Array) -> Array:
    """Return all numbers of the problems (groups, entries, 8); the last group is filled up with its last problem."""
    from synergrip.batch.lanes import LANES

    N, parts = len(problems), (problems.P, problems.q, problems.A, problems.b, enough[:, None])
    entries = sum(part[0].size for part in parts)
    groups = -(-N // LANES)
    given, at = np.empty((groups, entries, LANES)), 0
    whole, rest = N // LANES, N % LANES
    for part in parts:
        flat = part.reshape(len(part), -1)
        here = given[:, at : at + flat.shape[1]]
        at += flat.shape[1]
        if len(flat) == 1:
            here[:] = flat[0, :, None]
            continue
        here[:whole] = flat[: whole * LANES].reshape(whole, LANES, flat.shape[1]).transpose(0, 2, 1)
        if rest:
            last = flat[whole * LANES :]
            here[whole, :, :rest], here[whole, :, rest:] = last.T, last[-1][:, None]
    return given


def _made(stamp: int) -> Any:
    from synergrip.batch.lanes_kernel import made

    return made(stamp)


def _prepare(function: Any) -> None:
    """Solve no problem at all."""
    function(np.zeros((0, 1, 1)), Layout.of(1, 1, 1), np.ones((1, 2), dtype=np.int64), *Tolerance())


compiled = Compiled("kernel", SOURCES, _made, _prepare)
