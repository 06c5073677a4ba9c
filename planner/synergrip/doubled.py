"""Matrices in twice the precision of float64: each entry the unevaluated sum of two floats, about 31 digits.

Only sums and products whose errors are exact in IEEE arithmetic are used (Dekker, Knuth), so every platform gives the
same digits; `numpy.longdouble` is no more than float64 on many of them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from synergrip.linalg import Array

ROUNDOFF = 2.0**-104
"""Error of one operation, relative to the numbers that go into it, at most."""
_SPLIT = 2.0**27 + 1


@dataclass(frozen=True, eq=False)
class Doubled:
    """Numbers ``high + low``; operators work entry by entry as numpy's do, ``@`` on matrices."""

    high: Array
    """The numbers rounded to float64."""
    low: Array
    """What is left, at most half a unit in the last place of `high`."""

    __array_ufunc__ = None  # numpy leaves ``array - doubled`` to us

    @classmethod
    def of(cls, values: Array | Doubled) -> Doubled:
        """Return `values` as they are."""
        return values if isinstance(values, Doubled) else cls(np.asarray(values), np.zeros_like(values))

    @property
    def mT(self) -> Doubled:
        """The transpose."""
        return Doubled(self.high.T, self.low.T)

    def __getitem__(self, place: Any) -> Doubled:
        """Return entries as numpy does."""
        return Doubled(self.high[place], self.low[place])

    def __neg__(self) -> Doubled:
        """Return the negative."""
        return Doubled(-self.high, -self.low)

    def __add__(self, other: Array | Doubled) -> Doubled:
        """Return the sum."""
        other = Doubled.of(other)
        high, error = _sum(self.high, other.high)
        return Doubled(*_renormalised(high, error + (self.low + other.low)))

    def __sub__(self, other: Array | Doubled) -> Doubled:
        """Return the difference."""
        return self + -Doubled.of(other)

    def __mul__(self, other: Array | Doubled) -> Doubled:
        """Return the products of entries."""
        other = Doubled.of(other)
        high, error = _product(self.high, other.high)
        return Doubled(*_renormalised(high, error + (self.high * other.low + self.low * other.high)))

    def __truediv__(self, other: Doubled) -> Doubled:
        """Return the quotients of entries."""
        first = self.high / other.high
        rest = self - other * first
        second = rest.high / other.high
        third = (rest - other * second).high / other.high
        return Doubled(*_renormalised(first, second)) + third

    def __matmul__(self, other: Doubled) -> Doubled:
        """Return the matrix product."""
        total, error = _product(self.high.T[:, :, None], other.high[:, None, :])  # (k, m, n)
        low = error.sum(axis=0) + self.high @ other.low + self.low @ other.high
        while (count := len(total)) > 1:  # in pairs, the last one left over for the next round
            half = count // 2
            pairs, error = _sum(total[:half], total[half : 2 * half])
            low += error.sum(axis=0)
            total = np.concatenate([pairs, total[2 * half :]])
        return Doubled(*_renormalised(total.sum(axis=0), low))


def block(rows: Sequence[Sequence[Doubled]]) -> Doubled:
    """Return the matrix of blocks, as `numpy.block` does."""
    return _joined([_joined(row, axis=-1) for row in rows], axis=-2)


def solve(A: Doubled, B: Doubled) -> Doubled:
    """Return X (n, m) of ``A X = B`` by elimination; the rows of A (n, n) should be of one size.

    Raises:
        numpy.linalg.LinAlgError: A is singular.
    """
    size = len(A.high)
    rows = _joined((A, B), axis=1)
    for k in range(size):
        pick = k + int(np.argmax(np.abs(rows.high[k:, k])))
        if not np.abs(rows.high[pick, k]) > 0:
            raise np.linalg.LinAlgError("Singular matrix")
        pivot = rows[pick, k:] / rows[pick, k : k + 1]
        for part in (rows.high, rows.low):
            part[pick] = part[k]
        factors = rows[:, k : k + 1]
        rest = rows[:, k:] - factors * pivot[None]
        for part, new, own in ((rows.high, rest.high, pivot.high), (rows.low, rest.low, pivot.low)):
            part[:, k:], part[k, k:] = new, own
    return rows[:, size:]


def _joined(parts: Sequence[Doubled], axis: int) -> Doubled:
    return Doubled(*(np.concatenate([getattr(p, name) for p in parts], axis=axis) for name in ("high", "low")))


def _sum(a: Array, b: Array) -> tuple[Array, Array]:
    """Return ``a + b`` rounded, and its error."""
    total = a + b
    of_b = total - a
    return total, (a - (total - of_b)) + (b - of_b)


def _renormalised(high: Array, low: Array) -> tuple[Array, Array]:
    """Return the sum of a number and one not larger, rounded, and its error."""
    total = high + low
    return total, low - (total - high)


def _product(a: Array, b: Array) -> tuple[Array, Array]:
    """Return ``a b`` rounded, and its error."""
    product = a * b
    a_high, a_low = _halves(a)
    b_high, b_low = _halves(b)
    return product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low


def _halves(a: Array) -> tuple[Array, Array]:
    """Return the upper and the lower half of the digits."""
    wide = _SPLIT * a
    high = wide - (wide - a)
    return high, a - high
