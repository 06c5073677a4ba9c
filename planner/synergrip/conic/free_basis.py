"""What sums of squares leave open of all unknowns at once: one basis of the knots' unknowns, stacked.

Plans that are best by a sum of squares agree in everything that is squared; they differ by what the squares do not
see, the null space of all their rows. Its size is that of the trajectory, so it is never looked for as a whole. Where
all knots have one matrix it is made of products of courses in time and directions of a knot's unknowns (`_Product`);
else it is found from knot to knot, as a few combinations of what came before go on and the others end
(`_from_knot_to_knot`).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from scipy import sparse

from synergrip.conic.goals.goal import Squares
from synergrip.linalg import RANK_TOLERANCE, Array, null_spaces, split

ROUNDING = 1e-12
"""An entry this small beside the largest of its column is 0."""
MOST_OPEN = 8
"""Values at the first knots from which a recursion in time goes on, at most; with more it is no short recursion."""


def free_basis(squares: Sequence[Squares], knots: int, n_v: int) -> sparse.csc_matrix:
    """Return orthogonal columns (T n_v, m) that span all stacked unknowns that none of the squares see.

    A column is at most 1 in size at the knot where it is largest, so that unknowns stay what they are at a knot.

    Args:
        squares: of the goals so far, all in the same unknowns.
        knots: T.
        n_v: unknowns of a knot.
    """
    products = _products(squares, knots, n_v)
    if products is None:
        return _scaled(_from_knot_to_knot(squares, knots, n_v), n_v)
    products = [each for each in products if each.directions.size]
    if not products:
        return sparse.csc_matrix((knots * n_v, 0))
    own = sparse.eye_array(knots, format="csr")
    parts = [
        sparse.kron(own if each.time is None else sparse.csr_matrix(each.time), sparse.csr_matrix(each.directions))
        for each in products
    ]
    return _scaled(sparse.csc_matrix(sparse.hstack(parts)), n_v)


def _scaled(basis: sparse.csc_matrix, n_v: int) -> sparse.csc_matrix:
    """Return the columns without rounding, each 1 in size at the knot where it is largest."""
    column, knots = np.repeat(np.arange(basis.shape[1]), np.diff(basis.indptr)), basis.shape[0] // n_v
    places, which = np.unique(column * knots + basis.indices // n_v, return_inverse=True)
    largest = np.zeros(basis.shape[1])
    np.maximum.at(largest, places // knots, np.bincount(which, basis.data**2))
    shares = basis.data / np.sqrt(largest)[column]
    basis.data = np.where(np.abs(shares) > ROUNDING, shares, 0.0)
    basis.eliminate_zeros()
    return basis


@dataclass(frozen=True)
class _Product:
    """Unknowns ``time @ y @ directions'`` for any y (f, d)."""

    time: Array | None  # (T, f) orthonormal; None when each knot has its own y
    directions: Array  # (n_v, d) orthonormal


@dataclass(frozen=True)
class _Course:
    """Squares of ``sum over l of weights[i, l] matrix v_(k-l)`` for the last K knots k, i counting them."""

    weights: Array  # (K, lags), the newest knot first; the largest of a row is 1
    matrix: Array  # (m, n_v)

    @classmethod
    def of(cls, part: Squares) -> _Course | None:
        """Return squares in this form; None when their matrices differ from one knot to an earlier one."""
        weights = np.zeros((len(part.constant), 1 + max(each.lag for each in part.earlier)))
        whole: Array | None = None
        for lag, matrix, weight in _lags(part):
            if whole is None:
                whole = matrix
            if matrix.ndim > 2 or not (np.array_equal(matrix, whole) or np.array_equal(matrix, -whole)):
                return None
            weights[:, lag] += weight if np.array_equal(matrix, whole) else -weight
        if whole is None:
            return cls(weights, part.matrix)
        size = np.abs(weights).max(axis=1, keepdims=True, initial=0.0)
        return cls(weights / np.where(size > 0, size, 1.0), whole)

    def at(self, time: Array) -> Array:
        """Return what it sees (K, f) of courses (T, f)."""
        count, lags = self.weights.shape
        starts = (len(time) - count - lag for lag in range(lags))
        return np.asarray(sum(self.weights[:, [lag]] * time[at : at + count] for lag, at in enumerate(starts)))

    def unseen(self, knots: int) -> Array | None:
        """Return all courses (T, f) that it does not see; None when they are not few that the first knots determine."""
        count, lags = self.weights.shape
        begin = knots - count
        if begin > MOST_OPEN or np.abs(self.weights[:, 0]).min(initial=1.0) <= RANK_TOLERANCE:
            return None
        first = np.eye(begin)
        known = -self.at(np.vstack([first, np.zeros((count, begin))]))
        band = np.zeros((lags, count))
        for lag in range(min(lags, count)):
            band[lag, : count - lag] = self.weights[lag:, lag]
        from scipy.linalg import solve_banded

        later = solve_banded((lags - 1, 0), band, known)
        return _orthonormal(np.vstack([first, later]))


def _lags(part: Squares) -> Iterator[tuple[int, Array, Array]]:
    """Yield lag, matrix and weights (K,) of each part of some squares that is not 0."""
    if part.matrix.any():
        yield 0, part.matrix, np.ones(len(part.constant))
    for each in part.earlier:
        if each.matrix.any() and each.weights.any():
            yield each.lag, each.matrix, each.weights


def _orthonormal(columns: Array) -> Array:
    return np.asarray(np.linalg.qr(columns)[0])


def _products(squares: Sequence[Squares], knots: int, n_v: int) -> list[_Product] | None:
    """Return what the squares do not see, as products whose columns are all orthonormal; None when it is not such."""
    own = any(matrix.ndim > 2 for part in squares for _, matrix, _ in _lags(part))
    if own or any(len(part.constant) < knots for part in squares if not part.earlier):
        return None
    seen = [split(part.matrix).row_space for part in squares if not part.earlier]
    products: list[_Product] | None = [_Product(None, split(np.hstack([np.zeros((n_v, 0)), *seen]).T).null_space)]
    for part in squares:
        if part.earlier and products is not None:
            course = _Course.of(part)
            products = None if course is None else _without(products, course, knots)
    return products


def _without(products: Sequence[_Product], course: _Course, knots: int) -> list[_Product] | None:
    """Return what further squares leave of products; None when that is not made of products."""
    size = float(np.linalg.norm(course.matrix, 2))
    left: list[_Product] = []
    seen: list[_Product] = []
    for each in products:
        parts = split(course.matrix @ each.directions, size)
        left.append(_Product(each.time, each.directions @ parts.null_space))
        directions = each.directions @ parts.row_space
        if each.time is None:
            seen.append(_Product(None, directions))
            continue
        times = split(np.asarray(np.linalg.qr(course.at(each.time), mode="r")), 1.0)
        left.append(_Product(each.time @ times.null_space, directions))
        seen.append(_Product(each.time @ times.row_space, directions))
    seen = [each for each in seen if each.directions.size and (each.time is None or each.time.size)]
    if len(seen) > 1:
        together = course.matrix @ np.hstack([each.directions for each in seen])
        if split(together, size).decision.rank < together.shape[1]:
            return None  # one product may make up for another
    for each in seen:
        if each.time is None:
            time = course.unseen(knots)
            if time is None:
                return None
            left.append(_Product(time, each.directions))
    return [each for each in left if each.directions.size and (each.time is None or each.time.size)]


@dataclass(frozen=True)
class _Step:
    """What may go on after a knot: combinations of what went on before it, and of the knot's own unknowns."""

    before: int
    """How many went on before it."""
    going_on: Array  # (before + n_v, a)
    ending: Array  # (before + n_v, e): combinations that are 0 at all knots that later ones look at


def _from_knot_to_knot(squares: Sequence[Squares], knots: int, n_v: int) -> sparse.csc_matrix:
    """Return orthonormal columns (T n_v, m) that none of the squares see, whatever their matrices."""
    if not any(lag for part in squares for lag, _, _ in _lags(part)):
        return _at_each_knot(squares, knots, n_v)
    steps: list[_Step] = []
    equations = _equations(squares, knots)
    memory = max((lag for at in equations for lags in at for lag in lags), default=0)
    window = np.zeros((memory, n_v, 0))  # values at the knots before, the newest first, of what goes on
    for k, at in enumerate(equations):
        before = window.shape[2]
        rows = [np.zeros((0, before + n_v))]
        for lags in at:
            earlier = sum((matrix @ window[lag - 1] for lag, matrix in lags.items() if lag), np.zeros((1, before)))
            newest = lags.get(0, np.zeros((len(next(iter(lags.values()))), n_v)))
            rows.append(np.hstack([np.broadcast_to(earlier, (len(newest), before)), newest]))
        open_ = split(np.vstack(rows), 1.0).null_space
        own = np.hstack([np.zeros((n_v, before)), np.eye(n_v)])
        old = np.concatenate([window, np.zeros((memory, n_v, n_v))], axis=2)
        window = np.concatenate([own[None], old])[:memory] @ open_
        parts = split(window.reshape(memory * n_v, open_.shape[1]), 1.0)
        last = k == knots - 1
        going_on = parts.row_space[:, :0] if last else parts.row_space
        steps.append(_Step(before, open_ @ going_on, open_ if last else open_ @ parts.null_space))
        window = window @ going_on
    columns = [_traced(steps, k, knots, n_v) for k in range(knots)]
    return sparse.csc_matrix(sparse.hstack([sparse.csc_matrix((knots * n_v, 0)), *columns]))


def _at_each_knot(squares: Sequence[Squares], knots: int, n_v: int) -> sparse.csc_matrix:
    """Return the columns where no square looks at more than one knot: those of each knot by itself."""
    rows = [np.zeros((knots, 0, n_v))]
    for part in squares:
        size, count = float(np.linalg.norm(part.matrix, 2, axis=(-2, -1)).max(initial=0.0)), len(part.constant)
        if size > 0:
            seen = np.zeros((knots, part.matrix.shape[-2], n_v))
            seen[knots - count :] = (part.matrix if part.matrix.ndim == 2 else part.matrix[-count:]) / size
            rows.append(seen)
    open_ = null_spaces(np.concatenate(rows, axis=1), np.ones(knots)).mT  # directions as rows
    knot, which = np.nonzero(open_.any(axis=2))
    indices = knot[:, None] * n_v + np.arange(n_v)
    shape = (knots * n_v, len(knot))
    return sparse.csc_matrix((open_[knot, which].ravel(), indices.ravel(), n_v * np.arange(len(knot) + 1)), shape)


def _equations(squares: Sequence[Squares], knots: int) -> list[list[dict[int, Array]]]:
    """Return for each knot what squares see of it and of earlier ones: a matrix for each lag, the largest near 1."""
    result: list[list[dict[int, Array]]] = [[] for _ in range(knots)]
    for part in squares:
        lags = list(_lags(part))
        count = len(part.constant)
        sizes = [np.abs(weight) * np.linalg.norm(matrix, 2, axis=(-2, -1)).max() for _, matrix, weight in lags]
        for i, size in enumerate(np.max([np.zeros(count), *sizes], axis=0)):
            if size == 0:
                continue
            at: dict[int, Array] = {}
            for lag, matrix, weight in lags:
                own = matrix if matrix.ndim == 2 else matrix[len(matrix) - count + i - lag]
                at[lag] = at.get(lag, 0.0) + own * (weight[i] / size)
            result[knots - count + i].append(at)
    return result


def _traced(steps: Sequence[_Step], knot: int, knots: int, n_v: int) -> sparse.csc_matrix:
    """Return the columns (T n_v, e) that end at a knot: followed back to the knot where they begin."""
    values = steps[knot].ending
    blocks = []
    first = knot
    for k in range(knot, -1, -1):
        before = steps[k].before
        blocks.append(values[before:])
        values = values[:before]
        first = k
        if not before or np.abs(values).max(initial=0.0) <= ROUNDING:
            break
        values = steps[k - 1].going_on @ values
    block = sparse.csc_matrix(np.vstack(blocks[::-1]))
    above, below = sparse.csc_matrix((first * n_v, block.shape[1])), ((knots - 1 - knot) * n_v, block.shape[1])
    return sparse.csc_matrix(sparse.vstack([above, block, sparse.csc_matrix(below)]))
