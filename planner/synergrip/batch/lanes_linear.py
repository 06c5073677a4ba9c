"""Linear equations in lanes: the factor of ``P + R'R`` of eight problems, and steps by it.

Of two half-lines whose rows of A are opposite, a lower and an upper bound, one row stands for both: ``R'R`` has the sum
of their squares, and what either is to the other is a turn (a, b), ``a^2 + b^2 = 1``. Imported only where Numba is
there.
"""

from __future__ import annotations

from typing import Any

from synergrip.batch.lanes import all_of, kept_apart, load, root, store, where_less
from synergrip.batch.lanes_algebra import compiled, larger
from synergrip.batch.numpy_kernel import NO_PIVOT


@compiled
def rows_of_step(w: Any, at: Any, cones: Any) -> None:
    """Write R of ``W^-1 A``, and the turns of opposite rows."""
    kept_apart()
    two, one, n, wide, pairs, v = all_of(2.0), all_of(1.0), at.n, at.wide, at.pairs, at.v
    for d in range(pairs):
        a, b = load(w, at.under + d), load(w, at.under + pairs + d)
        factor = root(a * a + b * b)
        over = one / factor
        store(w, at.turn + 2 * d, a * over)
        store(w, at.turn + 2 * d + 1, b * over)
        for j in range(n):
            store(w, at.R + d * wide + j, factor * load(w, at.A + d * n + j))
    for c in range(2 * pairs, len(cones)):
        first, size = cones[c, 0], cones[c, 1]
        factor, A, R = load(w, at.under + c), at.A + (first - pairs) * n, at.R + (first - pairs) * wide
        if size == 1:
            for j in range(n):
                store(w, R + j, factor * load(w, A + j))
            continue
        for j in range(n):
            total = load(w, v + first) * load(w, A + j)
            for i in range(1, size):
                total = total - load(w, v + first + i) * load(w, A + i * n + j)
            twice = two * total
            store(w, R + j, factor * (twice * load(w, v + first) - load(w, A + j)))
            for i in range(1, size):
                store(w, R + i * wide + j, factor * (load(w, A + i * n + j) - twice * load(w, v + first + i)))


@compiled
def factor(w: Any, at: Any) -> None:
    """Write the Cholesky factor of ``P + R'R``."""
    kept_apart()
    H, n, wide = at.H, at.n, at.wide
    _squares(w, at)
    for j in range(n):
        diagonal = load(w, H + j * wide + j)
        pivot = diagonal
        for k in range(j):
            part = load(w, H + j * wide + k)
            pivot = pivot - part * part
        none = all_of(1e30) * larger(diagonal, all_of(1.0))
        pivot = root(where_less(all_of(NO_PIVOT) * diagonal, pivot, pivot, none))
        over = all_of(1.0) / pivot
        store(w, H + j * wide + j, over)  # the diagonal is kept as what one multiplies by
        for i in range(j + 1, n):
            entry = load(w, H + i * wide + j)
            for k in range(j):
                entry = entry - load(w, H + i * wide + k) * load(w, H + j * wide + k)
            store(w, H + i * wide + j, entry * over)


@compiled
def _squares(w: Any, at: Any) -> None:
    """Write the lower half of ``P + R'R``; two columns by two at a time."""
    P, R, H, n, wide, rows = at.P, at.R, at.H, at.n, at.wide, at.rows
    for i in range(0, wide, 2):
        for j in range(0, i + 2, 2):
            h00, h01, h10, h11 = all_of(0.0), all_of(0.0), all_of(0.0), all_of(0.0)
            for r in range(rows):
                a, b = load(w, R + r * wide + i), load(w, R + r * wide + i + 1)
                c, d = load(w, R + r * wide + j), load(w, R + r * wide + j + 1)
                h00, h01, h10, h11 = h00 + a * c, h01 + a * d, h10 + b * c, h11 + b * d
            store(w, H + i * wide + j, h00)
            store(w, H + i * wide + j + 1, h01)
            store(w, H + (i + 1) * wide + j, h10)
            store(w, H + (i + 1) * wide + j + 1, h11)
    if at.quadratic:
        for i in range(n):
            for j in range(i + 1):
                store(w, H + i * wide + j, load(w, H + i * wide + j) + load(w, P + i * n + j))


@compiled
def solution(w: Any, at: Any, rx: int, rs: int, dx: int, dz: int) -> None:
    """Write dx and dz with ``P dx + R'dz = -rx`` and ``R dx - dz = rs``, for W^-1 A in place of R."""
    kept_apart()
    R, n, wide, pairs = at.R, at.n, at.wide, at.pairs
    _right_side(w, at, rx, rs, dx)
    _substituted(w, at, dx)
    for r in range(at.rows):
        total = all_of(0.0)
        for j in range(n):
            total = total + load(w, R + r * wide + j) * load(w, dx + j)
        if r < pairs:
            store(w, dz + r, load(w, at.turn + 2 * r) * total - load(w, rs + r))
            total = all_of(0.0) - load(w, at.turn + 2 * r + 1) * total
        store(w, dz + pairs + r, total - load(w, rs + pairs + r))


@compiled
def _right_side(w: Any, at: Any, rx: int, rs: int, dx: int) -> None:
    """Write ``R'rs - rx``, with what of rs is along the one row of each pair; two entries at a time."""
    R, n, wide, pairs, one = at.R, at.n, at.wide, at.pairs, at.one
    for d in range(pairs):
        turned = load(w, at.turn + 2 * d) * load(w, rs + d) - load(w, at.turn + 2 * d + 1) * load(w, rs + pairs + d)
        store(w, one + d, turned)
    for d in range(pairs, at.rows):
        store(w, one + d, load(w, rs + pairs + d))
    for j in range(0, n, 2):
        total, beside = all_of(0.0), all_of(0.0)
        for r in range(at.rows):
            part = load(w, one + r)
            total, beside = total + load(w, R + r * wide + j) * part, beside + load(w, R + r * wide + j + 1) * part
        store(w, dx + j, total - load(w, rx + j))
        if j + 1 < n:
            store(w, dx + j + 1, beside - load(w, rx + j + 1))


@compiled
def _substituted(w: Any, at: Any, dx: int) -> None:
    """Write ``(P + R'R)^-1 dx`` over dx, by the factor."""
    H, n, wide = at.H, at.n, at.wide
    for i in range(n):
        total = load(w, dx + i)
        for k in range(i):
            total = total - load(w, H + i * wide + k) * load(w, dx + k)
        store(w, dx + i, total * load(w, H + i * wide + i))
    for back in range(n):
        i = n - 1 - back
        total = load(w, dx + i)
        for k in range(i + 1, n):
            total = total - load(w, H + k * wide + i) * load(w, dx + k)
        store(w, dx + i, total * load(w, H + i * wide + i))
