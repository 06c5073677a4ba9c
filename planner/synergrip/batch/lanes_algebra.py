"""The algebra of `cone_algebra.py` in lanes: one workspace of eight problems, quantities by their offsets in it.

A cone is its first row and its number of rows. Imported only where Numba is there.
"""

from __future__ import annotations

from typing import Any

import numba
import numpy as np

from synergrip.batch.lanes import LANES, all_of, load, root, store, where_less


def compiled(function: Any, *, inner: bool = True) -> Any:
    """Return a function as Numba compiles it: kept on the disk, where there is a folder for that.

    An inner one is called by others that are compiled, and by nobody else: it is kept as a part of them alone, since
    what is kept of a function is not made anew when another file, which it calls, has changed.
    """
    options = {"error_model": "numpy", "nogil": True, "no_cpython_wrapper": inner, "no_cfunc_wrapper": True}
    try:
        return numba.njit(cache=not inner, **options)(function)
    except RuntimeError:  # no folder can be written
        return numba.njit(**options)(function)


@compiled
def workspace(entries: int) -> Any:
    """Return zeros (entries * 8,) that begin at a multiple of 64 bytes, so that no entry lies in two cache lines."""
    whole = np.zeros((entries + 1) * LANES)
    first = (64 - np.int64(whole.ctypes.data % 64)) % 64 // whole.itemsize
    return whole[first : first + entries * LANES]


@compiled
def larger(a: Any, b: Any) -> Any:
    """Return the larger of two in every lane."""
    return where_less(a, b, b, a)


@compiled
def magnitude(a: Any) -> Any:
    """Return |a|."""
    return larger(a, all_of(0.0) - a)


@compiled
def determinant(w: Any, a: int, first: int, size: int) -> Any:
    """Return ``a'J a`` of a cone."""
    squares = all_of(0.0)
    for i in range(first + 1, first + size):
        part = load(w, a + i)
        squares = squares + part * part
    length, head = root(squares), load(w, a + first)
    return (head - length) * (head + length)


@compiled
def dot(w: Any, a: int, b: int, first: int, size: int) -> Any:
    """Return a'b of a cone."""
    total = load(w, a + first) * load(w, b + first)
    for i in range(first + 1, first + size):
        total = total + load(w, a + i) * load(w, b + i)
    return total


@compiled
def flipped_dot(w: Any, a: int, b: int, first: int, size: int) -> Any:
    """Return a'J b of a cone."""
    total = load(w, a + first) * load(w, b + first)
    for i in range(first + 1, first + size):
        total = total - load(w, a + i) * load(w, b + i)
    return total


@compiled
def add_scaled(w: Any, v: int, beta: int, x: int, out: int, cones: Any) -> None:
    """Add ``W x`` to what is there."""
    two = all_of(2.0)
    for c in range(len(cones)):
        first, size = cones[c, 0], cones[c, 1]
        factor = load(w, beta + c)
        if size == 1:
            store(w, out + first, load(w, out + first) + factor * load(w, x + first))
            continue
        twice = two * dot(w, v, x, first, size)
        head = twice * load(w, v + first) - load(w, x + first)
        store(w, out + first, load(w, out + first) + factor * head)
        for i in range(first + 1, first + size):
            part = twice * load(w, v + i) + load(w, x + i)
            store(w, out + i, load(w, out + i) + factor * part)


@compiled
def unscaled(w: Any, v: int, beta: int, x: int, out: int, cones: Any) -> None:
    """Write ``W^-1 x``."""
    two, one = all_of(2.0), all_of(1.0)
    for c in range(len(cones)):
        first, size = cones[c, 0], cones[c, 1]
        factor = one / load(w, beta + c)
        if size == 1:
            store(w, out + first, factor * load(w, x + first))
            continue
        twice = two * flipped_dot(w, v, x, first, size)
        store(w, out + first, factor * (twice * load(w, v + first) - load(w, x + first)))
        for i in range(first + 1, first + size):
            store(w, out + i, factor * (load(w, x + i) - twice * load(w, v + i)))


@compiled
def unscaled_rows(w: Any, v: int, beta: int, A: int, out: int, n: int, wide: int, cones: Any) -> None:
    """Write ``W^-1 A``, rows of n numbers, as rows of `wide` numbers."""
    two, one = all_of(2.0), all_of(1.0)
    for c in range(len(cones)):
        first, size = cones[c, 0], cones[c, 1]
        factor = one / load(w, beta + c)
        if size == 1:
            for j in range(n):
                store(w, out + first * wide + j, factor * load(w, A + first * n + j))
            continue
        for j in range(n):
            total = load(w, v + first) * load(w, A + first * n + j)
            for i in range(first + 1, first + size):
                total = total - load(w, v + i) * load(w, A + i * n + j)
            twice = two * total
            head = twice * load(w, v + first) - load(w, A + first * n + j)
            store(w, out + first * wide + j, factor * head)
            for i in range(first + 1, first + size):
                store(w, out + i * wide + j, factor * (load(w, A + i * n + j) - twice * load(w, v + i)))


@compiled
def divided(w: Any, b: int, a: int, out: int, cones: Any) -> None:
    """Write c whose Jordan product with a is b."""
    for c in range(len(cones)):
        first, size = cones[c, 0], cones[c, 1]
        if size == 1:
            store(w, out + first, load(w, b + first) / load(w, a + first))
            continue
        head = flipped_dot(w, a, b, first, size) / determinant(w, a, first, size)
        over = all_of(1.0) / load(w, a + first)
        for i in range(first + 1, first + size):
            store(w, out + i, over * (load(w, b + i) - head * load(w, a + i)))
        store(w, out + first, head)


@compiled
def less_product(w: Any, a: int, b: int, centre: Any, out: int, cones: Any) -> None:
    """Write ``centre e - a o b`` with the unit e of every cone."""
    for c in range(len(cones)):
        first, size = cones[c, 0], cones[c, 1]
        of_a, of_b = load(w, a + first), load(w, b + first)
        head = centre - dot(w, a, b, first, size)
        for i in range(first + 1, first + size):
            store(w, out + i, all_of(0.0) - of_a * load(w, b + i) - of_b * load(w, a + i))
        store(w, out + first, head)


@compiled
def longest_step(w: Any, at: int, step: int, cones: Any) -> Any:
    """Return how far a step may go before it leaves a cone."""
    zero, one = all_of(0.0), all_of(1.0)
    most = all_of(1e-300)
    for c in range(len(cones)):
        first, size = cones[c, 0], cones[c, 1]
        if size == 1:
            most = larger(most, (zero - load(w, step + first)) / load(w, at + first))
            continue
        over = one / root(determinant(w, at, first, size))
        head = over * over * flipped_dot(w, at, step, first, size)
        factor = (head + over * load(w, step + first)) / (over * load(w, at + first) + one)
        squares = zero
        for i in range(first + 1, first + size):
            part = over * (load(w, step + i) - factor * load(w, at + i))
            squares = squares + part * part
        most = larger(most, root(squares) - head)
    return one / most


@compiled
def carried_on(w: Any, v: int, beta: int, point: int, s: int, z: int, cones: Any) -> None:
    """Write v, beta and lambda of a pair that is s and z in the coordinates of the old scaling."""
    one, half = all_of(1.0), all_of(0.5)
    for c in range(len(cones)):
        first, size = cones[c, 0], cones[c, 1]
        if size == 1:
            ours, theirs = load(w, s + first), load(w, z + first)
            store(w, beta + c, load(w, beta + c) * root(ours / theirs))
            store(w, point + first, root(ours * theirs))
            continue
        of_s, of_z = root(determinant(w, s, first, size)), root(determinant(w, z, first, size))
        over_s, over_z = one / of_s, one / of_z
        middle = root(half * (one + over_s * over_z * dot(w, s, z, first, size)))
        with_s = over_s * dot(w, v, s, first, size)
        with_z = over_z * flipped_dot(w, v, z, first, size)
        over = half / middle
        mean, apart = over * (with_s + with_z), with_s - with_z
        v_0, s_0, z_0 = load(w, v + first), over_s * load(w, s + first), over_z * load(w, z + first)
        head = v_0 * (mean + mean) - over * (s_0 + z_0)
        turn = (v_0 * apart - half * s_0 + half * z_0) / (head + one)
        by_v = apart - (turn + turn) * mean
        by_s, by_z = half * (one - turn / middle), half * (one + turn / middle)
        size_of = root(of_s * of_z)
        norm = one / root(all_of(2.0) * (head + one))
        for i in range(first + 1, first + size):
            v_i, s_i, z_i = load(w, v + i), over_s * load(w, s + i), over_z * load(w, z + i)
            store(w, point + i, size_of * (by_v * v_i + by_s * s_i + by_z * z_i))
            store(w, v + i, norm * ((mean + mean) * v_i + over * (s_i - z_i)))
        store(w, point + first, size_of * middle)
        store(w, v + first, norm * (head + one))
        store(w, beta + c, load(w, beta + c) * root(of_s / of_z))


@compiled
def moved_inside(w: Any, a: int, m: int, cones: Any) -> None:
    """Move a point along the unit where it is not well inside its cones."""
    least, squares = all_of(np.inf), all_of(0.0)
    for r in range(m):
        part = load(w, a + r)
        squares = squares + part * part
    for c in range(len(cones)):
        first, size = cones[c, 0], cones[c, 1]
        tail = all_of(0.0)
        for i in range(first + 1, first + size):
            part = load(w, a + i)
            tail = tail + part * part
        inside = load(w, a + first) - root(tail)
        least = where_less(inside, least, inside, least)
    enough = all_of(1e-8) * larger(all_of(1.0), root(squares))
    shift = where_less(enough, least, all_of(0.0), all_of(1.0) - least)
    for c in range(len(cones)):
        store(w, a + cones[c, 0], load(w, a + cones[c, 0]) + shift)
