"""The controlled subspaces of eight grasps at a time, and Theorem 1, in lanes; where no rank is in doubt.

Ranks are told by bounds that cost no singular values: the least of a matrix is at least 1 over the root of the squares
of its inverse, the largest at most the root of its own. Imported only where Numba is there.
"""

from __future__ import annotations

from typing import Any

from synergrip.batch.lanes import all_of, kept_apart, load, store, where_less
from synergrip.batch.lanes_algebra import compiled
from synergrip.batch.lanes_dense import Matrix, product, reflected, squares_of, turned, upper_inverse

FULL = 1e4
"""How many times as large as the smallest singular value the largest is at most where the rank is full beyond doubt:
ten times less than would be grey (`linalg.GREY_CEILING`)."""
REGULAR = 1e6
"""The same of the matrix M of Theorem 1, and of the force map."""
DRIVEN = 1e6
"""How many times the size of J S the sizes of J and S may make at most: beyond it J S may be their rounding."""


@compiled
def _within(most: float, squares: Any, others: Any) -> Any:
    """Return 1 where the root of a product of squares is at most that, else 0."""
    return where_less(squares * others, all_of(most * most), all_of(1.0), all_of(0.0))


@compiled
def _copied(w: Any, a: Any, out: int, m: int, n: int) -> None:
    """Write a matrix (m, n) with its rows below one another."""
    for i in range(m):
        for j in range(n):
            store(w, out + i * n + j, load(w, a.first + i * a.down + j * a.right))


@compiled
def _unit(w: Any, out: int, m: int, n: int, first: int) -> None:
    """Write (m, n): 1 at row ``first + j`` of column j, else 0."""
    for i in range(m):
        for j in range(n):
            store(w, out + i * n + j, all_of(1.0 if i == first + j else 0.0))


@compiled
def _of_object(w: Any, at: Any) -> Any:
    """Write the factors of the scaled G'; return 1 where the contacts hold the object beyond doubt."""
    kept_apart()
    l = at.l  # noqa: E741 - the usual letter
    for i in range(l):
        for j in range(6):
            scaled = load(w, at.turned + j * l + i) / load(w, at.force + i) / load(w, at.motion + 7 * j)
            store(w, at.held + 6 * i + j, scaled)
    whole = squares_of(w, at.held, 6 * l)
    reflected(w, at.held, l, 6, at.heads)
    return _within(FULL, whole, upper_inverse(w, at.held, 6, at.inner))


@compiled
def _along(w: Any, at: Any) -> Any:
    """Write how synergies move contacts, in the basis of the range of G' and what is across it; return its squares."""
    kept_apart()
    l, q, z = at.l, at.q, at.z  # noqa: E741
    for i in range(l):
        for j in range(z):
            store(w, at.along + i * z + j, load(w, at.JS + i * z + j) / load(w, at.force + i))
    of_hand = all_of(0.0)
    for i in range(l):
        row = squares_of(w, at.J + i * q, q)
        of_hand = of_hand + row / (load(w, at.force + i) * load(w, at.force + i))
    size = squares_of(w, at.along, l * z)
    turned(w, at.held, l, 6, at.heads, at.along, z, False)
    beside = of_hand * squares_of(w, at.S, q * z)
    return where_less(beside, all_of(DRIVEN * DRIVEN) * size, size, all_of(0.0) / all_of(0.0))


@compiled
def _forces(w: Any, at: Any) -> Any:
    """Write E_s and what of the references makes its coordinates (r, z), on top of M; return 1 where that is clear."""
    kept_apart()
    l, z, k, r = at.l, at.z, at.k, at.r  # noqa: E741
    clear = all_of(1.0)
    for i in range(l):
        for j in range(z):
            store(w, at.wide + i * z + j, load(w, at.maps + i * k + j) * load(w, at.force + i))
    turned(w, at.held, l, 6, at.heads, at.wide, z, False)
    across = at.wide + 6 * z
    if r == l - 6:  # all internal forces
        _unit(w, at.E_s, l, r, 6)
        _copied(w, Matrix(across, z, 1), at.M, r, z)
    else:
        squares = squares_of(w, across, (l - 6) * z)
        reflected(w, across, l - 6, z, at.inner_heads)
        clear = _within(REGULAR, squares, upper_inverse(w, across, z, at.inner))
        _unit(w, at.E_s, l, r, 6)
        turned(w, across, l - 6, z, at.inner_heads, at.E_s + 6 * r, r, True)
        for i in range(z):
            for j in range(z):
                store(w, at.M + i * z + j, load(w, across + i * z + j) if j >= i else all_of(0.0))
    turned(w, at.held, l, 6, at.heads, at.E_s, r, True)
    for i in range(l):
        for j in range(r):
            store(w, at.E_s + i * r + j, load(w, at.E_s + i * r + j) / load(w, at.force + i))
    return clear


@compiled
def _motions(w: Any, at: Any, size: Any) -> Any:
    """Write Gamma_zcs, Gamma_ucs and their rows of M; return 1 where the ranks are clear."""
    kept_apart()
    l, z, k, r, d = at.l, at.z, at.k, at.r, at.d  # noqa: E741
    across = at.along + 6 * z
    if d == 0:
        _copied(w, Matrix(across, z, 1), at.wide, l - 6, z)
        reflected(w, at.wide, l - 6, z, at.inner_heads)
        return _within(FULL, size, upper_inverse(w, at.wide, z, at.inner))
    _copied(w, Matrix(across, 1, z), at.wide, z, r)
    reflected(w, at.wide, z, r, at.inner_heads)
    clear = _within(FULL, size, upper_inverse(w, at.wide, r, at.inner))
    _unit(w, at.other, z, d, r)
    turned(w, at.wide, z, r, at.inner_heads, at.other, d, True)  # synergy motions that cost no force
    product(w, at.wide, Matrix(at.along, z, 1), Matrix(at.other, d, 1), 6, z, d, 0.0)
    _copied(w, Matrix(at.wide, d, 1), at.rest, 6, d)
    reflected(w, at.wide, 6, d, at.inner_heads)
    clear = clear * _within(FULL, size, upper_inverse(w, at.wide, d, at.inner))
    upper_inverse(w, at.held, 6, at.inner)
    product(w, at.wide, Matrix(at.inner, 6, 1), Matrix(at.rest, d, 1), 6, 6, d, 0.0)
    reflected(w, at.wide, 6, d, at.inner_heads)
    upper_inverse(w, at.wide, d, at.inner)
    product(w, at.Gamma_zcs, Matrix(at.other, d, 1), Matrix(at.inner, d, 1), z, d, d, 0.0)
    _unit(w, at.rest, 6, d, 0)
    turned(w, at.wide, 6, d, at.inner_heads, at.rest, d, True)
    for j in range(6):
        for i in range(d):
            store(w, at.rest + 6 * d + i * 6 + j, load(w, at.rest + j * d + i) * load(w, at.motion + 7 * j))
    product(w, at.M + r * z, Matrix(at.rest + 6 * d, 6, 1), Matrix(at.maps + l * k, k, 1), d, 6, z, 0.0)
    _about_base(w, at)
    return clear


@compiled
def _about_base(w: Any, at: Any) -> None:
    """Write Gamma_ucs [m, rad] about B of the directions in scaled coordinates about the centroid."""
    kept_apart()
    d = at.d
    for j in range(d):
        for i in range(3):
            turn = load(w, at.rest + (3 + i) * d + j) / load(w, at.motion + 7 * (3 + i))
            store(w, at.Gamma_ucs + (3 + i) * d + j, turn)
        for i in range(3):
            total = load(w, at.rest + i * d + j)
            for m in range(3):
                total = total - load(w, at.motion + 6 * i + 3 + m) * load(w, at.Gamma_ucs + (3 + m) * d + j)
            store(w, at.Gamma_ucs + i * d + j, total)


@compiled
def _inverse_of_M(w: Any, at: Any) -> Any:
    """Write the inverse of M; return 1 where its rows, made as long, are far from dependent."""
    kept_apart()
    z = at.z
    _copied(w, Matrix(at.M, 1, z), at.wide, z, z)
    reflected(w, at.wide, z, z, at.inner_heads)
    upper_inverse(w, at.wide, z, at.inner)
    _copied(w, Matrix(at.inner, 1, z), at.inverse, z, z)
    turned(w, at.wide, z, z, at.inner_heads, at.inverse, z, True)
    squares = all_of(0.0)
    for j in range(z):
        row, column = squares_of(w, at.M + j * z, z), all_of(0.0)
        for i in range(z):
            part = load(w, at.inverse + i * z + j)
            column = column + part * part
        squares = squares + row * column
    return _within(REGULAR, squares, all_of(1.0))


@compiled
def bases(w: Any, at: Any) -> Any:
    """Write the bases, M and its inverse; return 1 where every rank behind them is beyond doubt."""
    clear = _of_object(w, at)
    size = _along(w, at)
    clear = clear * _forces(w, at)
    clear = clear * _motions(w, at, size)
    return clear * _inverse_of_M(w, at)
