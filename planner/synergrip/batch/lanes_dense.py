"""Small dense matrices in lanes: products, Cholesky factors, reflections; eight problems in every entry.

Imported only where Numba is there.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from synergrip.batch.lanes import all_of, kept_apart, load, root, store, where_less
from synergrip.batch.lanes_algebra import compiled


class Matrix(NamedTuple):
    """A matrix in the workspace: where it begins, and how far its rows and its columns are apart."""

    first: int
    down: int
    right: int


@compiled
def product(w: Any, out: int, A: Any, B: Any, m: int, k: int, n: int, add: float) -> None:
    """Write A B (m, n) for A (m, k) and B (k, n), rows below one another; or add it `add` times, where not 0."""
    for i in range(0, m, 2):
        _two_rows(w, out, A, B, i, min(i + 1, m - 1), 0, k, n, add)


@compiled
def product_within(w: Any, out: int, A: Any, spans: Any, B: Any, m: int, n: int, add: float) -> None:
    """Do the same for an A whose rows are 0 outside of their `spans` (m, 2): from, to."""
    for i in range(0, m, 2):
        below = min(i + 1, m - 1)
        first, end = min(spans[i, 0], spans[below, 0]), max(spans[i, 1], spans[below, 1])
        _two_rows(w, out, A, B, i, below, first, end, n, add)


@compiled
def _two_rows(w: Any, out: int, A: Any, B: Any, i: int, below: int, first: int, end: int, n: int, add: float) -> None:
    """Write two rows of A B (..., n), by columns `first` to `end` of A; one where both are the same.

    Three columns are made at once. Where there are fewer the last one is made several times, and put down as often:
    nothing is added twice.
    """
    kept_apart()
    a, b = A.first + i * A.down, A.first + below * A.down
    for j in range(0, n, 3):
        k, l = min(j + 1, n - 1), min(j + 2, n - 1)  # noqa: E741
        c, d, e = B.first + j * B.right, B.first + k * B.right, B.first + l * B.right
        p0, p1, p2, q0, q1, q2 = all_of(0.0), all_of(0.0), all_of(0.0), all_of(0.0), all_of(0.0), all_of(0.0)
        for inner in range(first, end):
            x, y, u = load(w, a + inner * A.right), load(w, b + inner * A.right), load(w, c + inner * B.down)
            p0, q0 = p0 + x * u, q0 + y * u
            u = load(w, d + inner * B.down)
            p1, q1 = p1 + x * u, q1 + y * u
            u = load(w, e + inner * B.down)
            p2, q2 = p2 + x * u, q2 + y * u
        row, other = out + i * n, out + below * n
        if add != 0.0:
            times = all_of(add)
            p0, p1, p2 = load(w, row + j) + times * p0, load(w, row + k) + times * p1, load(w, row + l) + times * p2
            q0, q1, q2 = (
                load(w, other + j) + times * q0,
                load(w, other + k) + times * q1,
                load(w, other + l) + times * q2,
            )
        store(w, row + j, p0)
        store(w, row + k, p1)
        store(w, row + l, p2)
        store(w, other + j, q0)
        store(w, other + k, q1)
        store(w, other + l, q2)


@compiled
def cholesky(w: Any, a: int, n: int, starts: Any) -> Any:
    """Write L of ``A = L L'`` over A (n, n), its diagonal inverted; return the least pivot over its diagonal.

    Rows of A, and so those of L, are 0 before their `starts` (n,).
    """
    kept_apart()
    one, least = all_of(1.0), all_of(1.0)
    for j in range(n):
        whole = load(w, a + j * n + j)
        pivot = whole
        for k in range(starts[j], j):
            part = load(w, a + j * n + k)
            pivot = pivot - part * part
        share = pivot / whole
        least = where_less(least, share, least, share)  # what is no number stays
        over = one / root(pivot)
        store(w, a + j * n + j, over)
        for i in range(j + 1, n):
            if starts[i] > j:
                continue
            entry = load(w, a + i * n + j)
            for k in range(max(starts[i], starts[j]), j):
                entry = entry - load(w, a + i * n + k) * load(w, a + j * n + k)
            store(w, a + i * n + j, entry * over)
    return least


@compiled
def lower_solved(w: Any, L: int, n: int, starts: Any, b: int, columns: int) -> None:
    """Write ``L^-1 B`` over B (n, columns), for L of `cholesky`, whose rows are 0 before their `starts` (n,)."""
    _solved_in_turn(w, Matrix(L, n, 1), n, starts, b, columns, columns)


@compiled
def lower_transposed_solved(w: Any, L: int, n: int, starts: Any, b: int, columns: int) -> None:
    """Write ``L'^-1 B`` over B (n, columns), for L of `cholesky`: from the last row up L' is lower triangular.

    So turned, its rows are 0 before their `starts` (n,).
    """
    _solved_in_turn(w, Matrix(L + n * n - 1, -1, -n), n, starts, b + (n - 1) * columns, -columns, columns)


@compiled
def _solved_in_turn(w: Any, L: Matrix, n: int, starts: Any, b: int, down: int, columns: int) -> None:
    """Write ``L^-1 B`` over B (n, columns), whose rows are `down` apart, for a lower L with an inverted diagonal."""
    kept_apart()
    for c in range(0, columns, 4):
        d, e, f = min(c + 1, columns - 1), min(c + 2, columns - 1), min(c + 3, columns - 1)
        for i in range(n):
            row, here = b + i * down, L.first + i * L.down
            one, two, three, four = load(w, row + c), load(w, row + d), load(w, row + e), load(w, row + f)
            for k in range(starts[i], i):
                part, above = load(w, here + k * L.right), b + k * down
                one, two = one - part * load(w, above + c), two - part * load(w, above + d)
                three, four = three - part * load(w, above + e), four - part * load(w, above + f)
            over = load(w, here + i * L.right)
            store(w, row + c, one * over)
            store(w, row + d, two * over)
            store(w, row + e, three * over)
            store(w, row + f, four * over)


@compiled
def reflected(w: Any, a: int, m: int, n: int, factors: int) -> None:
    """Write the QR factors of A (m, n), m >= n: R (its upper half), below it what reflects, and heads in `factors`.

    The reflection of column j is ``1 - v v' / h`` with v from row j on, its first entry and 1 / h at
    ``factors + 2 j``.
    """
    kept_apart()
    zero, one = all_of(0.0), all_of(1.0)
    for j in range(n):
        squares = zero
        for i in range(j, m):
            part = load(w, a + i * n + j)
            squares = squares + part * part
        first, size = load(w, a + j * n + j), root(squares)
        size = where_less(first, zero, size, zero - size)
        head = first - size
        over = zero - one / (size * head)
        store(w, a + j * n + j, size)
        store(w, factors + 2 * j, head)
        store(w, factors + 2 * j + 1, over)
        _turned_by(w, a, m, n, j, head, over, a, n, j + 1)


@compiled
def turned(w: Any, a: int, m: int, n: int, factors: int, b: int, columns: int, back: bool) -> None:
    """Write ``Q' B``, or ``Q B`` where `back`, over B (m, columns), for the Q that `reflected` left in A (m, n)."""
    kept_apart()
    for step in range(n):
        j = n - 1 - step if back else step
        _turned_by(w, a, m, n, j, load(w, factors + 2 * j), load(w, factors + 2 * j + 1), b, columns, 0)


@compiled
def _turned_by(w: Any, a: int, m: int, n: int, j: int, head: Any, over: Any, b: int, columns: int, first: int) -> None:
    """Write what the reflection of column j of A (m, n) makes of B (m, columns), from its column `first` on."""
    for c in range(first, columns):
        total = head * load(w, b + j * columns + c)
        for i in range(j + 1, m):
            total = total + load(w, a + i * n + j) * load(w, b + i * columns + c)
        total = total * over
        store(w, b + j * columns + c, load(w, b + j * columns + c) - total * head)
        for i in range(j + 1, m):
            store(w, b + i * columns + c, load(w, b + i * columns + c) - total * load(w, a + i * n + j))


@compiled
def upper_inverse(w: Any, a: int, n: int, out: int) -> Any:
    """Write the inverse (n, n) of the upper half of A (..., n), zeros below it; return the sum of its squares."""
    kept_apart()
    zero, one, squares = all_of(0.0), all_of(1.0), all_of(0.0)
    for j in range(n):
        for i in range(j + 1, n):
            store(w, out + i * n + j, zero)
        over = one / load(w, a + j * n + j)
        store(w, out + j * n + j, over)
        squares = squares + over * over
        for back in range(j):
            i = j - 1 - back
            total = zero
            for k in range(i + 1, j + 1):
                total = total + load(w, a + i * n + k) * load(w, out + k * n + j)
            total = zero - total / load(w, a + i * n + i)
            store(w, out + i * n + j, total)
            squares = squares + total * total
    return squares


@compiled
def squares_of(w: Any, a: int, count: int) -> Any:
    """Return the sum of the squares of some entries."""
    total = all_of(0.0)
    for i in range(count):
        part = load(w, a + i)
        total = total + part * part
    return total
