"""Linear equations in lanes: the factor of ``P + R'R`` of eight problems, and steps by it.

Imported only where Numba is there.
"""

from __future__ import annotations

from typing import Any

from synergrip.batch.lanes import all_of, load, root, store, where_less
from synergrip.batch.lanes_algebra import compiled, larger
from synergrip.batch.numpy_kernel import NO_PIVOT


@compiled
def factor(w: Any, at: Any) -> None:
    """Write the Cholesky factor of ``P + R'R``; two columns by two at a time."""
    P, R, H, n, wide, m = at.P, at.R, at.H, at.n, at.wide, at.m
    for i in range(0, wide, 2):
        for j in range(0, i + 2, 2):
            h00, h01, h10, h11 = all_of(0.0), all_of(0.0), all_of(0.0), all_of(0.0)
            for r in range(m):
                a, b = load(w, R + r * wide + i), load(w, R + r * wide + i + 1)
                c, d = load(w, R + r * wide + j), load(w, R + r * wide + j + 1)
                h00, h01, h10, h11 = h00 + a * c, h01 + a * d, h10 + b * c, h11 + b * d
            store(w, H + i * wide + j, h00)
            store(w, H + i * wide + j + 1, h01)
            store(w, H + (i + 1) * wide + j, h10)
            store(w, H + (i + 1) * wide + j + 1, h11)
    for j in range(n):
        diagonal = load(w, H + j * wide + j) + load(w, P + j * n + j)
        pivot = diagonal
        for k in range(j):
            part = load(w, H + j * wide + k)
            pivot = pivot - part * part
        none = all_of(1e30) * larger(diagonal, all_of(1.0))
        pivot = root(where_less(all_of(NO_PIVOT) * diagonal, pivot, pivot, none))
        over = all_of(1.0) / pivot
        store(w, H + j * wide + j, over)  # the diagonal is kept as what one multiplies by
        for i in range(j + 1, n):
            entry = load(w, H + i * wide + j) + load(w, P + i * n + j)
            for k in range(j):
                entry = entry - load(w, H + i * wide + k) * load(w, H + j * wide + k)
            store(w, H + i * wide + j, entry * over)


@compiled
def solution(w: Any, at: Any, rx: int, rs: int, dx: int, dz: int) -> None:
    """Write dx and dz with ``P dx + R'dz = -rx`` and ``R dx - dz = rs``."""
    H, R, n, wide, m = at.H, at.R, at.n, at.wide, at.m
    for j in range(n):
        total = all_of(0.0) - load(w, rx + j)
        for r in range(m):
            total = total + load(w, R + r * wide + j) * load(w, rs + r)
        store(w, dx + j, total)
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
    for r in range(m):
        total = all_of(0.0) - load(w, rs + r)
        for j in range(n):
            total = total + load(w, R + r * wide + j) * load(w, dx + j)
        store(w, dz + r, total)
