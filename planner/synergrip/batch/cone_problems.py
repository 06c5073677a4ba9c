"""Many small cone programs of one shape, and what a solver says of them: plain arrays, so that any solver fits."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import IntEnum
from itertools import groupby
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from synergrip.documents.judging import Arguments, described
from synergrip.linalg import Array
from synergrip.values import Value


class Group(NamedTuple):
    """Consecutive cones of one size."""

    rows: slice
    cones: int
    size: int
    """Rows of each cone; 1 for half-lines."""


@dataclass(frozen=True, eq=False, repr=False)
class ConeProblems(Value):
    """N programs: minimise ``x'P x / 2 + q'x`` with ``b - A x`` in a product of second-order cones and half-lines.

    A leading axis of 1 stands for N of the same.

    Raises:
        InputError: arrays that do not fit each other.
    """

    P: Array  # (N or 1, n, n) symmetric, positive semidefinite
    q: Array  # (N or 1, n)
    A: Array  # (N or 1, m, n)
    b: Array  # (N, m)
    sizes: tuple[int, ...]
    """Rows of each cone, in the order of the rows; a cone of 1 row is a half-line."""
    pairs: int = 0
    """How many half-lines come first whose rows of A are, in their order, minus those of as many that come next: lower
    and upper bounds of the same. A solver may make use of it."""

    def __post_init__(self) -> None:
        """Judge the shapes."""
        judge = Arguments("ConeProblems")
        N, n = len(self.b), self.q.shape[-1]
        for name, shape in (("P", (n, n)), ("q", (n,)), ("A", (sum(self.sizes), n)), ("b", (sum(self.sizes),))):
            value = getattr(self, name)
            if value.shape[1:] != shape or len(value) not in {1, N}:
                judge.refuse(name, f"expected shape {(N, *shape)} or {(1, *shape)}; got {described(value)}")
        judge.finish()

    def __len__(self) -> int:
        """Return N."""
        return len(self.b)

    @property
    def groups(self) -> tuple[Group, ...]:
        """Consecutive cones of one size."""
        return groups_of(self.sizes)

    def taken(self, places: Any) -> ConeProblems:
        """Return the problems at some places."""
        P, q, A = (each if len(each) == 1 < len(self) else each[places] for each in (self.P, self.q, self.A))
        return ConeProblems(P, q, A, self.b[places], self.sizes, self.pairs)


def groups_of(sizes: tuple[int, ...]) -> tuple[Group, ...]:
    """Return consecutive cones of one size together."""
    return tuple(_groups(sizes))


def _groups(sizes: tuple[int, ...]) -> Iterator[Group]:
    start = 0
    for size, cones in groupby(sizes):
        count = len(list(cones))
        yield Group(slice(start, start + count * size), count, size)
        start += count * size


class Status(IntEnum):
    """What a solver says of one problem. A claim, nothing more: `verifier` decides."""

    SOLVED = 0
    ENOUGH = 1
    """Stopped at a point that keeps all cones, because it was good enough."""
    NOTHING = 2


@dataclass(frozen=True, eq=False, repr=False)
class ConeSolutions(Value):
    """What a solver found of N problems."""

    x: Array  # (N, n)
    s: Array  # (N, m) slack b - A x
    z: Array  # (N, m) multipliers
    status: NDArray[np.int8]  # (N,) of `Status`
    iterations: NDArray[np.int32]  # (N,)


class Tolerance(NamedTuple):
    """To which a kernel solves."""

    residual: float = 1e-8
    """Of ``P x + q + A'z``, relative to its terms, and of ``A x + s - b``."""
    gap: float = 1e-8
    """``s'z``, relative to the objective or to 1."""
