"""The method of `numpy_kernel.py` for eight problems at a time, compiled by Numba; sizes are known at run time only.

Imported only where Numba is there. Quantities are at offsets of one workspace, eight numbers an entry; a lane that is
through stays where it is until the others are.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from synergrip.batch.lanes import LANES, all_of, any_above_zero, kept_apart, load, root, store, where_less
from synergrip.batch.lanes_algebra import (
    add_scaled,
    carried_on,
    compiled,
    divided,
    larger,
    less_product,
    longest_step,
    magnitude,
    moved_inside,
    unscaled,
    workspace,
)
from synergrip.batch.lanes_linear import factor, rows_of_step, solution
from synergrip.batch.lanes_rows import lanes_into_rows, rows_into_lanes
from synergrip.batch.numpy_kernel import BOUNDARY, MOST, STUCK

SOLVED, ENOUGH, NOTHING = 0.0, 1.0, 2.0


@compiled
def _residuals(w: Any, at: Any) -> Any:
    """Write what is missing to an optimum; return the largest of both, the size of the first, and the objective."""
    kept_apart()
    zero, n, pairs = all_of(0.0), at.n, at.pairs
    value, of_x, of_s, size = zero, zero, zero, all_of(1.0)
    for r in range(at.rows):
        part = load(w, at.z + pairs + r)
        store(w, at.one + r, load(w, at.z + r) - part if r < pairs else part)
    for i in range(n):
        total = load(w, at.q + i)
        of_P = zero
        if at.quadratic:
            for j in range(n):
                of_P = of_P + load(w, at.P + i * n + j) * load(w, at.x + j)
            size = larger(size, magnitude(of_P))
        value = value + load(w, at.x + i) * (all_of(0.5) * of_P + total)
        total = total + of_P
        for r in range(at.rows):
            total = total + load(w, at.A + r * n + i) * load(w, at.one + r)
        store(w, at.rx + i, total)
        of_x = larger(of_x, magnitude(total))
    for r in range(at.rows):
        total = zero
        for j in range(n):
            total = total + load(w, at.A + r * n + j) * load(w, at.x + j)
        if r < pairs:
            left = load(w, at.s + r) - load(w, at.b + r) + total
            store(w, at.rs + r, left)
            of_s = larger(of_s, magnitude(left))
            total = zero - total
        left = load(w, at.s + pairs + r) - load(w, at.b + pairs + r) + total
        store(w, at.rs + pairs + r, left)
        of_s = larger(of_s, magnitude(left))
    return of_x, of_s, size, value


@compiled
def _begin(w: Any, at: Any, cones: Any) -> None:
    """Write the least-squares point, moved into the cones, and its scaling."""
    zero, one = all_of(0.0), all_of(1.0)
    for r in range(at.m):
        store(w, at.v + r, zero)
    for c in range(len(cones)):
        store(w, at.v + cones[c, 0], one)
        store(w, at.beta + c, one)
        store(w, at.under + c, one)
    for r in range(at.rows):
        store(w, at.R + r * at.wide + at.wide - 1, zero)  # the column that makes their number even
    rows_of_step(w, at, cones)
    factor(w, at)
    solution(w, at, at.q, at.b, at.x, at.z)
    for r in range(at.m):
        store(w, at.s + r, zero - load(w, at.z + r))
    moved_inside(w, at.s, at.m, cones)
    moved_inside(w, at.z, at.m, cones)
    carried_on(w, at, at.s, at.z, cones)


@compiled
def _inside(w: Any, at: Any, cones: Any) -> Any:
    """Return how far ``b - A x`` is inside all cones: the least of head less length of the tail."""
    least = all_of(np.inf)
    for c in range(len(cones)):
        first, size = cones[c, 0], cones[c, 1]
        squares = all_of(0.0)
        for i in range(first + 1, first + size):
            part = load(w, at.s + i) - load(w, at.rs + i)
            squares = squares + part * part
        inside = load(w, at.s + first) - load(w, at.rs + first) - root(squares)
        least = where_less(inside, least, inside, least)
    return least


@compiled
def _judged(w: Any, at: Any, cones: Any, residual: float, most_gap: float) -> Any:
    """Return what is found in every lane, and the gap."""
    zero, one = all_of(0.0), all_of(1.0)
    of_x, of_s, size, value = _residuals(w, at)
    gap = zero
    for r in range(at.m):
        gap = gap + load(w, at.point + r) * load(w, at.point + r)
    kept = where_less(of_s, all_of(residual), one, zero)
    right = where_less(of_x, all_of(residual) * size, kept, zero)
    right = where_less(gap, all_of(most_gap) * larger(one, magnitude(value)), right, zero)
    good = where_less(zero, _inside(w, at, cones), one, zero)
    good = where_less(value, load(w, at.enough), good, zero)  # not where the value is no number
    found = where_less(zero, right, all_of(SOLVED), where_less(zero, good, all_of(ENOUGH), all_of(NOTHING)))
    return found, gap


@compiled
def _reach(w: Any, at: Any, cones: Any) -> Any:
    """Return how far both parts of a step may go."""
    kept_apart()
    of_s = longest_step(w, at.point, at.over, at.ds, cones)
    of_z = longest_step(w, at.point, at.over, at.dz, cones)
    return all_of(1.0) / larger(of_s, of_z)


@compiled
def _direct(w: Any, at: Any, cones: Any, gap: Any) -> Any:
    """Write the step, in scaled coordinates, predicted and corrected; return how far it may go."""
    zero, one = all_of(0.0), all_of(1.0)
    rows_of_step(w, at, cones)
    factor(w, at)
    unscaled(w, at.v, at.under, at.rs, at.scaled_rs, cones)
    for r in range(at.m):
        store(w, at.aim + r, load(w, at.point + r) - load(w, at.scaled_rs + r))
    solution(w, at, at.rx, at.aim, at.dx, at.dz)
    both = zero
    for r in range(at.m):
        ds, dz = zero - load(w, at.point + r) - load(w, at.dz + r), load(w, at.dz + r)
        store(w, at.ds + r, ds)
        both = both + ds * dz
    reach = _reach(w, at, cones)
    reach = where_less(one, reach, one, reach)
    would_be = larger(zero, one - reach + reach * reach * both / gap)
    would_be = where_less(one, would_be, one, would_be)
    centre = would_be * root(would_be) * gap / all_of(float(len(cones)))
    less_product(w, at.ds, at.dz, centre, at.ds, cones)
    divided(w, at.ds, at.point, at.over, at.aim, cones)
    for r in range(at.m):
        wanted = load(w, at.aim + r) - load(w, at.point + r)
        store(w, at.ds + r, wanted)
        store(w, at.aim + r, zero - wanted - load(w, at.scaled_rs + r))
    solution(w, at, at.rx, at.aim, at.dx, at.dz)
    for r in range(at.m):
        store(w, at.ds + r, load(w, at.ds + r) - load(w, at.dz + r))
    step = all_of(BOUNDARY) * _reach(w, at, cones)
    return where_less(one, step, one, step)


@compiled
def _move(w: Any, at: Any, cones: Any, step: Any, active: Any) -> None:
    """Take the step in lanes that are active."""
    zero = all_of(0.0)
    for j in range(at.n):
        moved = step * load(w, at.dx + j)
        store(w, at.x + j, load(w, at.x + j) + where_less(zero, active, moved, zero))
    for r in range(at.m):
        store(w, at.ds + r, where_less(zero, active, step * load(w, at.ds + r), zero))
        store(w, at.dz + r, where_less(zero, active, step * load(w, at.dz + r), zero))
    unscaled(w, at.v, at.under, at.dz, at.aim, cones)
    add_scaled(w, at.v, at.beta, at.ds, at.s, cones)
    for r in range(at.m):
        store(w, at.z + r, load(w, at.z + r) + load(w, at.aim + r))
        store(w, at.dz + r, load(w, at.point + r) + load(w, at.dz + r))
        store(w, at.ds + r, load(w, at.point + r) + load(w, at.ds + r))
    carried_on(w, at, at.ds, at.dz, cones)


@compiled
def _eight(w: Any, at: Any, cones: Any, residual: float, most_gap: float) -> None:
    """Solve eight problems, whose numbers come first in the workspace."""
    zero, one = all_of(0.0), all_of(1.0)
    active, status, count = one, all_of(NOTHING), zero
    _begin(w, at, cones)
    for iteration in range(MOST + 1):
        found, gap = _judged(w, at, cones, residual, most_gap)
        status = where_less(zero, active, found, status)
        active = where_less(found, all_of(NOTHING), zero, active)
        if iteration == MOST or not any_above_zero(active):
            break
        step = _direct(w, at, cones, gap)
        active = where_less(all_of(STUCK), step, active, zero)
        for j in range(at.n):
            active = where_less(magnitude(load(w, at.dx + j)), all_of(np.inf), active, zero)
        count = count + active
        _move(w, at, cones, step, active)
    store(w, at.status, status)
    store(w, at.iterations, count)


def made(stamp: int) -> Any:
    """Return the function that solves groups of eight; its compiled form is kept for this `stamp` alone.

    It takes numbers of the problems, a row for each (N or 1, ...), which of them come one after the other in the
    workspace (from, how many), where things are, the cones (cones, 2) and the tolerances; it writes x, s, z, status and
    iterations (N, entries).
    """

    def solved(given: Any, spans: Any, found: Any, at: Any, cones: Any, residual: float, most_gap: float) -> None:
        w = workspace(at.end + stamp * 0)
        for group in range((len(found) + LANES - 1) // LANES):
            entry, here = 0, min(LANES, len(found) - group * LANES)
            for part, rows in enumerate(given):
                entry = rows_into_lanes(w, entry, rows, spans[part, 0], spans[part, 1], group, here)
            _eight(w, at, cones, residual, most_gap)
            lanes_into_rows(w, at.x, found, group, here)

    return compiled(solved, inner=False)
