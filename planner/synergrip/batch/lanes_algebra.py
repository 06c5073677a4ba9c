"""The algebra of `cone_algebra.py` in lanes: one workspace of eight problems, quantities by their offsets in it.

A cone is its first row and its number of rows. Imported only where Numba is there.
"""

from __future__ import annotations

from typing import Any

import numba
import numpy as np

from synergrip.batch.lanes import LANES, all_of, kept_apart, load, root, store, where_less


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
def unscaled(w: Any, v: int, under: int, x: int, out: int, cones: Any) -> None:
    """Write ``W^-1 x``."""
    two = all_of(2.0)
    for c in range(len(cones)):
        first, size = cones[c, 0], cones[c, 1]
        factor = load(w, under + c)
        if size == 1:
            store(w, out + first, factor * load(w, x + first))
            continue
        twice = two * flipped_dot(w, v, x, first, size)
        store(w, out + first, factor * (twice * load(w, v + first) - load(w, x + first)))
        for i in range(first + 1, first + size):
            store(w, out + i, factor * (load(w, x + i) - twice * load(w, v + i)))


@compiled
def divided(w: Any, b: int, a: int, over: int, out: int, cones: Any) -> None:
    """Write c whose Jordan product with a is b."""
    for c in range(len(cones)):
        first, size = cones[c, 0], cones[c, 1]
        inverse = load(w, over + c)
        if size == 1:
            store(w, out + first, load(w, b + first) * inverse)
            continue
        head = flipped_dot(w, a, b, first, size) * inverse * inverse
        over_a = all_of(1.0) / load(w, a + first)
        for i in range(first + 1, first + size):
            store(w, out + i, over_a * (load(w, b + i) - head * load(w, a + i)))
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
def longest_step(w: Any, at: int, over: int, step: int, cones: Any) -> Any:
    """Return the inverse of how far a step may go before it leaves a cone; 1e-300 where it never does."""
    zero, one = all_of(0.0), all_of(1.0)
    most = all_of(1e-300)
    for c in range(len(cones)):
        first, size = cones[c, 0], cones[c, 1]
        inverse = load(w, over + c)
        if size == 1:
            most = larger(most, zero - load(w, step + first) * inverse)
            continue
        head = inverse * inverse * flipped_dot(w, at, step, first, size)
        factor = (head + inverse * load(w, step + first)) / (inverse * load(w, at + first) + one)
        squares = zero
        for i in range(first + 1, first + size):
            part = inverse * (load(w, step + i) - factor * load(w, at + i))
            squares = squares + part * part
        most = larger(most, root(squares) - head)
    return most


@compiled
def carried_on(w: Any, at: Any, s: int, z: int, cones: Any) -> None:
    """Write the scaling of a pair that is s and z in the coordinates of the old one: v, beta, lambda, and inverses.

    These are 1 / beta, and 1 over the size of each cone's part of lambda, ``root(a'J a)``.
    """
    kept_apart()
    one, half = all_of(1.0), all_of(0.5)
    v, beta, under, point, over = at.v, at.beta, at.under, at.point, at.over
    for c in range(len(cones)):
        first, size = cones[c, 0], cones[c, 1]
        if size == 1:
            ours, theirs = load(w, s + first), load(w, z + first)
            middle = root(ours * theirs)
            inverse = one / middle
            store(w, point + first, middle)
            store(w, over + c, inverse)
            store(w, beta + c, load(w, beta + c) * ours * inverse)
            store(w, under + c, load(w, under + c) * theirs * inverse)
            continue
        of_s, of_z = root(determinant(w, s, first, size)), root(determinant(w, z, first, size))
        over_s, over_z = one / of_s, one / of_z
        middle = root(half * (one + over_s * over_z * dot(w, s, z, first, size)))
        with_s = over_s * dot(w, v, s, first, size)
        with_z = over_z * flipped_dot(w, v, z, first, size)
        over_2 = half / middle
        mean, apart = over_2 * (with_s + with_z), with_s - with_z
        v_0, s_0, z_0 = load(w, v + first), over_s * load(w, s + first), over_z * load(w, z + first)
        head = v_0 * (mean + mean) - over_2 * (s_0 + z_0)
        turn = (v_0 * apart - half * s_0 + half * z_0) / (head + one)
        by_v = apart - (turn + turn) * mean
        share = (turn + turn) * over_2
        by_s, by_z = half * (one - share), half * (one + share)
        size_of = root(of_s * of_z)
        inverse = one / size_of
        norm = one / root(head + head + all_of(2.0))
        for i in range(first + 1, first + size):
            v_i, s_i, z_i = load(w, v + i), over_s * load(w, s + i), over_z * load(w, z + i)
            store(w, point + i, size_of * (by_v * v_i + by_s * s_i + by_z * z_i))
            store(w, v + i, norm * ((mean + mean) * v_i + over_2 * (s_i - z_i)))
        store(w, point + first, size_of * middle)
        store(w, over + c, inverse)
        store(w, v + first, norm * (head + one))
        store(w, beta + c, load(w, beta + c) * of_s * inverse)
        store(w, under + c, load(w, under + c) * of_z * inverse)


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
