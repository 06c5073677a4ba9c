"""The statics of eight grasps at a time: response, how well it is known, subspaces and Theorem 1, in lanes.

The formulas are those of `statics/saddle.py`, `statics/response.py` and `statics/subspaces.py`, for grasps in which all
is clear: contacts hold the object, the synergies control as many forces as they can and rigid motions with the rest,
no singular value is near a tolerance. Of the others a mark says that they are for somebody else. Imported only where
Numba is there.
"""

from __future__ import annotations

from typing import Any

from synergrip.batch.lanes import LANES, all_of, any_above_zero, kept_apart, load, store, where_less
from synergrip.batch.lanes_algebra import compiled, magnitude, workspace
from synergrip.batch.lanes_bases import bases
from synergrip.batch.lanes_centroid import about_centroid, in_place
from synergrip.batch.lanes_confirmed import confirmed
from synergrip.batch.lanes_dense import (
    Matrix,
    cholesky,
    lower_solved,
    lower_transposed_solved,
    product,
    product_within,
)
from synergrip.batch.lanes_rows import lanes_into_rows, rows_into_lanes
from synergrip.statics.saddle import APART, CAUTION, ROUNDOFF

AGREED = 1e-12
"""Share of a map that the arithmetic may have lost, at most: what the maps of one grasp and of many agree to."""
PLAIN = 1e-8
"""A pivot above this share of its diagonal is far from rounding: no contact direction is rigid."""


@compiled
def _factors(w: Any, at: Any, spans: Any) -> Any:
    """Write the factors ``C = L L'``, ``L^-1 G' = Y`` and ``Y'Y = R R'``; return the least share of a pivot."""
    kept_apart()
    l, q, z = at.l, at.q, at.z  # noqa: E741 - the usual letter
    S, J = Matrix(at.S, z, 1), Matrix(at.J, q, 1)
    product_within(w, at.JS, J, spans.J, S, l, z, 0.0)
    product_within(w, at.wide, S, spans.S, Matrix(at.C_z, z, 1), q, z, 0.0)
    for i in range(q * q):
        store(w, at.K + i, load(w, at.C_q + i))
    product(w, at.K, Matrix(at.wide, z, 1), Matrix(at.S, 1, z), q, z, q, 1.0)
    product_within(w, at.wide, J, spans.J, Matrix(at.K, q, 1), l, q, 0.0)
    for i in range(l * l):
        store(w, at.L + i, load(w, at.C_s + i))
    product(w, at.L, Matrix(at.wide, q, 1), Matrix(at.J, 1, q), l, q, l, 1.0)
    of_forces = cholesky(w, at.L, l, spans.L)
    for i in range(l):
        for j in range(6):
            store(w, at.Y + 6 * i + j, load(w, at.turned + j * l + i))
    lower_solved(w, at.L, l, spans.L, at.Y, 6)
    product(w, at.R, Matrix(at.Y, 1, 6), Matrix(at.Y, 6, 1), 6, l, 6, 0.0)
    of_motions = cholesky(w, at.R, 6, spans.R)
    return where_less(of_forces, of_motions, of_forces, of_motions)


@compiled
def _solved(w: Any, at: Any, spans: Any, b: int) -> None:
    """Write lambda and u over the right-hand sides (l + 6, k) of ``C lambda + G'u = f``, ``G lambda = g``."""
    kept_apart()
    l, k = at.l, at.k  # noqa: E741
    lower_solved(w, at.L, l, spans.L, b, k)
    u = b + l * k
    for i in range(6 * k):
        store(w, u + i, all_of(0.0) - load(w, u + i))
    product(w, u, Matrix(at.Y, 1, 6), Matrix(b, k, 1), 6, l, k, 1.0)
    lower_solved(w, at.R, 6, spans.R, u, k)
    lower_transposed_solved(w, at.R, 6, spans.R, u, k)
    product(w, b, Matrix(at.Y, 6, 1), Matrix(u, k, 1), l, 6, k, -1.0)
    lower_transposed_solved(w, at.L, l, spans.L_T, b, k)


@compiled
def _followed(w: Any, at: Any, spans: Any, a: int, still: float) -> None:
    """Write tau, sigma, z and q below lambda and u (n, k); `still` is z of synergies that do not yield."""
    kept_apart()
    l, q, z, k = at.l, at.q, at.z, at.k  # noqa: E741
    tau = a + (l + 6) * k
    sigma, of_z, of_q = tau + q * k, tau + (q + z) * k, tau + (q + 2 * z) * k
    product_within(w, tau, Matrix(at.J, 1, q), spans.J_T, Matrix(a, k, 1), q, k, 0.0)
    product_within(w, sigma, Matrix(at.S, 1, z), spans.S_T, Matrix(tau, k, 1), z, k, 0.0)
    for i in range(z):
        for j in range(k):
            store(w, of_z + i * k + j, all_of(still if i == j else 0.0))
    product_within(w, of_z, Matrix(at.C_z, z, 1), spans.C_z, Matrix(sigma, k, 1), z, k, -1.0)
    product_within(w, of_q, Matrix(at.S, z, 1), spans.S, Matrix(of_z, k, 1), q, k, 0.0)
    product_within(w, of_q, Matrix(at.C_q, q, 1), spans.C_q, Matrix(tau, k, 1), q, k, -1.0)


@compiled
def _corrected(w: Any, at: Any, spans: Any, a: int, out: int) -> None:
    """Write what is to be added to lambda and u, by what is left over of the equations, told from the matrices."""
    kept_apart()
    l, q, z, k = at.l, at.q, at.z, at.k  # noqa: E741
    product_within(w, out, Matrix(at.J, q, 1), spans.J, Matrix(a + (l + 6 + q + 2 * z) * k, k, 1), l, k, 0.0)
    product_within(w, out, Matrix(at.C_s, l, 1), spans.C_s, Matrix(a, k, 1), l, k, -1.0)
    product(w, out, Matrix(at.turned, 1, l), Matrix(a + l * k, k, 1), l, 6, k, -1.0)
    balance = out + l * k
    for i in range(6):
        for j in range(k):
            store(w, balance + i * k + j, all_of(-1.0 if j == z + i else 0.0))
    product(w, balance, Matrix(at.turned, l, 1), Matrix(a, k, 1), 6, l, k, -1.0)
    _solved(w, at, spans, out)


@compiled
def _added(w: Any, at: Any, a: int, b: int) -> None:
    for i in range((at.l + 6) * at.k):
        store(w, a + i, load(w, a + i) + load(w, b + i))


@compiled
def _largest(w: Any, at: Any, values: int, out: int, times: float, beside: int, share: float) -> None:
    """Raise the largest entries of the twelve maps to those of ``times |values| + share |beside|``, scaled."""
    kept_apart()
    l, q, z, k = at.l, at.q, at.z, at.k  # noqa: E741
    ends, first = (l, l + 6, l + 6 + q, l + 6 + q + z, l + 6 + q + 2 * z, l + 6 + 2 * q + 2 * z), 0
    for part in range(6):
        of_references, of_load = load(w, out + 2 * part), load(w, out + 2 * part + 1)
        for i in range(first, ends[part]):
            size = all_of(1.0)
            if part < 2:
                size = load(w, at.force + i) if part == 0 else load(w, at.motion + 7 * (i - first))
            for j in range(k):
                entry = all_of(times) * magnitude(load(w, values + i * k + j))
                entry = (entry + all_of(share) * magnitude(load(w, beside + i * k + j))) * size
                if j < z:
                    of_references = where_less(entry, of_references, of_references, entry)
                else:
                    entry = entry * load(w, at.motion + 7 * (j - z))
                    of_load = where_less(entry, of_load, of_load, entry)
        store(w, out + 2 * part, of_references)
        store(w, out + 2 * part + 1, of_load)
        first = ends[part]


@compiled
def _maps(w: Any, at: Any, spans: Any) -> None:
    """Write the maps, and the largest entries of each and of what the arithmetic may have lost.

    What is left over of the equations corrects them once, and once more where that was much.
    """
    l, z, k = at.l, at.z, at.k  # noqa: E741
    for i in range(l + 6):
        for j in range(k):
            fit = load(w, at.JS + i * z + j) if i < l and j < z else all_of(-1.0 if i - l == j - z else 0.0)
            store(w, at.maps + i * k + j, fit)
    _solved(w, at, spans, at.maps)
    for _ in range(2):
        _followed(w, at, spans, at.maps, 1.0)
        _corrected(w, at, spans, at.maps, at.other)
        _added(w, at, at.maps, at.other)
        _followed(w, at, spans, at.other, 0.0)
        _followed(w, at, spans, at.maps, 1.0)
        for i in range(24):
            store(w, at.size + i, all_of(0.0))
        _largest(w, at, at.maps, at.size, 1.0, at.maps, 0.0)
        _largest(w, at, at.other, at.lost, CAUTION, at.maps, ROUNDOFF)
        if not any_above_zero(all_of(1.0) - _kept(w, at)):
            break


@compiled
def _kept(w: Any, at: Any) -> Any:
    """Return 1 where no map has lost more than its digits allow, else 0."""
    kept = all_of(1.0)
    for i in range(12):  # a map that is nothing and has lost nothing is 0 for sure
        allowed = all_of(AGREED) * load(w, at.size + i) + all_of(1e-300)
        kept = where_less(load(w, at.lost + i), allowed, kept, all_of(0.0))
    return kept


@compiled
def _doubts(w: Any, at: Any, spans: Any, half_units: Any) -> Any:
    """Move the numbers of the grasp by what they are not known to; return 1 where the maps are known in spite of it."""
    for i in range(at.motion):
        store(w, i, load(w, i) * all_of(half_units[i]))
    for i in range((at.l + 6) * at.k):
        store(w, at.other + i, load(w, at.maps + i))
    about_centroid(w, at)
    _followed(w, at, spans, at.other, 1.0)
    _corrected(w, at, spans, at.other, at.rest)
    _added(w, at, at.other, at.rest)
    _followed(w, at, spans, at.other, 1.0)
    for i in range(at.n * at.k):
        store(w, at.other + i, load(w, at.other + i) - load(w, at.maps + i))
    _largest(w, at, at.other, at.lost, CAUTION / APART, at.maps, 0.0)
    return _kept(w, at)


@compiled
def _eight(w: Any, at: Any, spans: Any, half_units: Any) -> None:
    """Work out the statics of eight grasps, whose numbers come first in the workspace."""
    about_centroid(w, at)
    clear = where_less(all_of(PLAIN), _factors(w, at, spans), all_of(1.0), all_of(0.0))
    _maps(w, at, spans)
    clear = clear * bases(w, at)
    clear = clear * _doubts(w, at, spans, half_units)
    in_place(w, at)
    store(w, at.clear, clear)


def made(stamp: int) -> Any:
    """Return the function that works out the statics of grasps; its compiled form is kept for this `stamp` alone.

    It takes the numbers of the grasps, a row for each (N or 1, ...), where things are, where rows are not 0, what the
    numbers of a grasp are multiplied by to tell how far they are known, and normal numbers to confirm by; it writes a
    row for each grasp, from `at.clear` on. Where `known`, what these rows have is confirmed, and nothing worked out.
    """

    def worked_out(given: Any, at: Any, spans: Any, half_units: Any, chances: Any, found: Any, known: bool) -> None:
        w = workspace(at.end + stamp * 0)
        for group in range((len(found) + LANES - 1) // LANES):
            here = min(LANES, len(found) - group * LANES)
            if not known:
                _numbers(w, given, group, here)
                _eight(w, at, spans, half_units)
                lanes_into_rows(w, at.clear, found, group, here)
            _numbers(w, given, group, here)
            rows_into_lanes(w, at.clear, found, 0, found.shape[1], group, here)
            store(w, at.clear, load(w, at.clear) * confirmed(w, at, chances))
            for lane in range(here):
                found[group * LANES + lane, 0] = w[at.clear * LANES + lane]

    return compiled(worked_out, inner=False)


@compiled
def _numbers(w: Any, given: Any, group: int, here: int) -> None:
    """Write the numbers of eight grasps, which come first in the workspace."""
    entry = 0
    for rows in given:
        entry = rows_into_lanes(w, entry, rows, 0, rows.shape[1], group, here)
