"""The method of `numpy_kernel.py` for eight problems at a time, compiled by Numba; sizes are known at run time only.

Imported only where Numba is there. Quantities are at offsets of one workspace, eight numbers an entry; a lane that is
through stays where it is until the others are.
"""

from __future__ import annotations

from typing import Any

import numba
import numpy as np

from synergrip.batch.lanes import LANES, all_of, any_above_zero, load, root, store, where_less
from synergrip.batch.lanes_algebra import (
    add_scaled,
    carried_on,
    compiled,
    divided,
    larger,
    less_product,
    longest_step,
    magnitude,
    unscaled,
    unscaled_rows,
)
from synergrip.batch.numpy_kernel import BOUNDARY, MOST, NO_PIVOT, STUCK

SOLVED, ENOUGH, NOTHING = 0.0, 1.0, 2.0


@compiled  # type: ignore[untyped-decorator]
def _factor(w: Any, P: int, R: int, H: int, n: int, wide: int, m: int) -> None:
    """Write the Cholesky factor of ``P + R'R``; two columns by two at a time."""
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


@compiled  # type: ignore[untyped-decorator]
def _solved(w: Any, H: int, R: int, wide: int, n: int, m: int, sign: Any, rx: int, rs: int, dx: int, dz: int) -> None:
    """Write dx and dz with ``P dx + R'dz = sign rx`` and ``R dx - dz = rs``."""
    for j in range(n):
        total = sign * load(w, rx + j)
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


@compiled  # type: ignore[untyped-decorator]
def _moved_inside(w: Any, a: int, m: int, cones: Any) -> None:
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


@compiled  # type: ignore[untyped-decorator]
def _residuals(w: Any, P: int, q: int, A: int, b: int, x: int, s: int, z: int, rx: int, rs: int, n: int, m: int) -> Any:
    """Write what is missing to an optimum; return the largest of both, the size of the first, and the objective."""
    value, of_x, of_s, size = all_of(0.0), all_of(0.0), all_of(0.0), all_of(1.0)
    for i in range(n):
        of_P = all_of(0.0)
        for j in range(n):
            of_P = of_P + load(w, P + i * n + j) * load(w, x + j)
        value = value + load(w, x + i) * (all_of(0.5) * of_P + load(w, q + i))
        size = larger(size, magnitude(of_P))
        total = of_P + load(w, q + i)
        for r in range(m):
            total = total + load(w, A + r * n + i) * load(w, z + r)
        store(w, rx + i, total)
        of_x = larger(of_x, magnitude(total))
    for r in range(m):
        total = load(w, s + r) - load(w, b + r)
        for j in range(n):
            total = total + load(w, A + r * n + j) * load(w, x + j)
        store(w, rs + r, total)
        of_s = larger(of_s, magnitude(total))
    return of_x, of_s, size, value


@compiled  # type: ignore[untyped-decorator]
def _eight(w: Any, n: int, m: int, cones: Any, residual: float, most_gap: float) -> None:
    """Solve eight problems: P, q, A, b and `enough` come first in the workspace, then what is told of them."""
    wide = n + n % 2
    P, q = 0, n * n
    A, b = q + n, q + n + m * n
    enough = b + m
    x, s, z = enough + 1, enough + 1 + n, enough + 1 + n + m
    told = z + m  # status and iterations
    v, beta, point = told + 2, told + 2 + m, told + 2 + m + len(cones)
    R, H = point + m, point + m + m * wide
    rx, rs, dx = H + wide * wide, H + wide * wide + n, H + wide * wide + n + m
    dz, ds, aim, scaled_rs = dx + n, dx + n + m, dx + n + 2 * m, dx + n + 3 * m
    zero, one, degree = all_of(0.0), all_of(1.0), all_of(float(len(cones)))

    for r in range(m):
        for j in range(wide):
            store(w, R + r * wide + j, load(w, A + r * n + j) if j < n else zero)
    _factor(w, P, R, H, n, wide, m)
    _solved(w, H, R, wide, n, m, zero - one, q, b, x, z)
    for r in range(m):
        store(w, s + r, zero - load(w, z + r))
        store(w, v + r, zero)
    for c in range(len(cones)):
        store(w, v + cones[c, 0], one)
        store(w, beta + c, one)
    _moved_inside(w, s, m, cones)
    _moved_inside(w, z, m, cones)
    carried_on(w, v, beta, point, s, z, cones)

    active, status, count = one, all_of(NOTHING), zero
    for iteration in range(MOST + 1):
        of_x, of_s, size, value = _residuals(w, P, q, A, b, x, s, z, rx, rs, n, m)
        gap = zero
        for r in range(m):
            gap = gap + load(w, point + r) * load(w, point + r)
        kept = where_less(of_s, all_of(residual), one, zero)
        right = where_less(of_x, all_of(residual) * size, kept, zero)
        right = where_less(gap, all_of(most_gap) * larger(one, magnitude(value)), right, zero)
        found = where_less(zero, right, all_of(SOLVED), all_of(NOTHING))
        good = where_less(load(w, enough), value, zero, kept)
        found = where_less(zero, good - right, all_of(ENOUGH), found)
        status = where_less(zero, active, found, status)
        active = where_less(found, all_of(NOTHING), zero, active)
        if iteration == MOST or not any_above_zero(active):
            break
        unscaled_rows(w, v, beta, A, R, n, wide, cones)
        _factor(w, P, R, H, n, wide, m)
        unscaled(w, v, beta, rs, scaled_rs, cones)
        for r in range(m):
            store(w, aim + r, load(w, point + r) - load(w, scaled_rs + r))
        _solved(w, H, R, wide, n, m, zero - one, rx, aim, dx, dz)
        for r in range(m):
            store(w, ds + r, zero - load(w, point + r) - load(w, dz + r))
        reach = longest_step(w, point, ds, cones)
        other = longest_step(w, point, dz, cones)
        reach = where_less(other, reach, other, reach)
        short = larger(zero, one - reach)
        less_product(w, ds, dz, short * short * short * gap / degree, ds, cones)
        divided(w, ds, point, aim, cones)
        for r in range(m):
            wanted = load(w, aim + r) - load(w, point + r)
            store(w, ds + r, wanted)
            store(w, aim + r, zero - wanted - load(w, scaled_rs + r))
        _solved(w, H, R, wide, n, m, zero - one, rx, aim, dx, dz)
        for r in range(m):
            store(w, ds + r, load(w, ds + r) - load(w, dz + r))
        step = longest_step(w, point, ds, cones)
        other = longest_step(w, point, dz, cones)
        step = all_of(BOUNDARY) * where_less(other, step, other, step)
        step = where_less(one, step, one, step)
        active = where_less(all_of(STUCK), step, active, zero)
        for j in range(n):
            moved = step * load(w, dx + j)
            active = where_less(magnitude(moved), all_of(np.inf), active, zero)
        count = count + active
        for j in range(n):
            moved = step * load(w, dx + j)
            store(w, x + j, load(w, x + j) + where_less(zero, active, moved, zero))
        for r in range(m):
            store(w, ds + r, where_less(zero, active, step * load(w, ds + r), zero))
            store(w, dz + r, where_less(zero, active, step * load(w, dz + r), zero))
        unscaled(w, v, beta, dz, aim, cones)
        for r in range(m):
            store(w, z + r, load(w, z + r) + load(w, aim + r))
            store(w, dz + r, load(w, point + r) + load(w, dz + r))
        add_scaled(w, v, beta, ds, s, cones)
        for r in range(m):
            store(w, ds + r, load(w, point + r) + load(w, ds + r))
        carried_on(w, v, beta, point, ds, dz, cones)
    store(w, told, status)
    store(w, told + 1, count)


def made(stamp: int) -> Any:
    """Return the function that solves groups of eight; its compiled form is kept for this `stamp` alone.

    It takes the problems (groups, entries, 8), the cones (cones, 2) and the tolerances, and returns what comes after
    the problems in each workspace: x, s, z, status, iterations.
    """

    @numba.njit(cache=True, error_model="numpy", nogil=True)  # type: ignore[untyped-decorator]
    def solved(given: Any, n: int, m: int, cones: Any, residual: float, most_gap: float, size: int) -> Any:
        entries, answers = given.shape[1], n + 2 * m + 2
        found = np.empty((given.shape[0], answers, LANES))
        w = np.zeros(size * LANES + stamp * 0)
        for group in range(given.shape[0]):
            for k in range(entries):
                for lane in range(LANES):
                    w[k * LANES + lane] = given[group, k, lane]
            _eight(w, n, m, cones, residual, most_gap)
            for k in range(answers):
                for lane in range(LANES):
                    found[group, k, lane] = w[(entries + k) * LANES + lane]
        return found

    return solved
