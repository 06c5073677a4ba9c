"""How the largest margin changes with a number: by the multipliers of its program.

With rows ``b - A x`` in their cones, optimal unknowns x and multipliers z, the margin grows by ``z'(db - dA x)``. Where
several multipliers are optimal it is the least of these toward more of the number, and the largest toward less.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from scipy import sparse

from synergrip.changes.at_a_value import solved
from synergrip.linalg import Array
from synergrip.margin.sensitivity.faces import Faces, faces, steepest
from synergrip.margin.sensitivity.optimum import Optimum, margin_with, rows_with
from synergrip.margin.sensitivity.parameters import STEP, Parameter
from synergrip.margin.sensitivity.sensitivity import LARGEST, START, Sensitivity
from synergrip.values import Value

VARIES = 1e-6
"""Share of a change, or of the program's units, up to which optima that differ in it are told to agree."""
ALIKE = 1e-6
"""Share of the larger of two derivatives, or of the program's units, up to which they are the same."""
WIDE = 10 * STEP
"""Step, in the scale of a parameter, of one-sided differences of largest margins that are found anew."""
ALIKE_BY_DIFFERENCES = 1e-5
"""The same as `ALIKE` of these, which the digits of a margin allow."""
NOTHING = 1e-9
"""Share of the program's units that is rounding."""
LOST = "there is no plan as soon as it changes one way, or none was verified"
TIED = "several limits are reached at once, and the number decides which of them count"
SEVERAL = "several plans have the largest margin, and the number decides which of them are best"


@dataclass(frozen=True, eq=False, repr=False)
class _Change(Value):
    """How the rows of the program change with a number."""

    A: sparse.csc_matrix
    b: Array

    def of_rows(self, x: Array) -> Array:
        """Return (m,) the change of the rows' values."""
        return np.asarray(self.b - self.A @ x)


def of_largest(parameters: Sequence[Parameter], of: Optimum) -> Iterator[Sensitivity]:
    """Yield how the largest margin changes with each number."""
    found = faces(of)
    for each in parameters:
        change = _change(each, of)
        if isinstance(change, str):
            yield _told(each, of, (None, None), change)
        else:
            yield _derived(each, of, found, change)


def _change(parameter: Parameter, of: Optimum) -> _Change | str:
    """Return the derivative of the rows by central differences, or why there is none."""
    more, less = (rows_with(parameter, change, of) for change in (STEP, -STEP))
    if isinstance(more, str):
        return more
    if isinstance(less, str):
        return less
    return _Change(sparse.csc_matrix((more.A - less.A) / (2 * STEP)), (more.b - less.b) / (2 * STEP))


def _derived(parameter: Parameter, of: Optimum, found: Faces, change: _Change) -> Sensitivity:
    rows = change.of_rows(of.x)
    own = found.W.T @ rows
    value = float(found.t @ own) * of.unit
    tied = _varies(found.open_.T @ own, own)
    several = _several(found, change)
    if several:
        return by_differences(parameter, of, value)
    if not tied:
        return _told(parameter, of, (value, value))
    ends = [_end(of, found, sign * rows) for sign in (1.0, -1.0)]
    right, left = (None if end is None else -sign * end for sign, end in zip((1.0, -1.0), ends, strict=True))
    return _judged(parameter, value, (left, right), ALIKE, of, TIED)


def _varies(part: Array, whole: Array) -> bool:
    return bool(np.abs(part).max(initial=0.0) > VARIES * max(1.0, np.abs(whole).max(initial=0.0)))


def _several(found: Faces, change: _Change) -> bool:
    """Return whether optimal plans differ in how good they are once the number changes."""
    multipliers = sparse.hstack([sparse.csc_matrix(found.z[:, None]), found.W @ sparse.csc_matrix(found.open_)])
    pulls = np.asarray((change.A.T @ multipliers).todense())
    unseen = pulls - found.seen @ (found.seen.T @ pulls)
    return any(_varies(part, whole) for part, whole in zip(unseen.T, pulls.T, strict=True))


def _end(of: Optimum, found: Faces, rows: Array) -> float | None:
    """Return how the optimum grows with a change of the rows [N]; None where there is none, or none is verified."""
    decision = solved("steepest", steepest(of, found, rows))
    return float(decision.program.objective(decision.solution.x)) * of.unit if decision.optimal else None


def by_differences(parameter: Parameter, of: Optimum, value: float) -> Sensitivity:
    """Return one-sided differences of the second order, of largest margins that are found anew."""
    sides = list[float | None]()
    for sign in (-1.0, 1.0):
        near, far = (margin_with(parameter, sign * size, of) for size in (WIDE, 2 * WIDE))
        missing = near is None or far is None
        sides.append(None if missing else sign * (4 * near - far - 3 * of.margin) / (2 * WIDE))  # type: ignore[operator]
    return _judged(parameter, value, (sides[0], sides[1]), ALIKE_BY_DIFFERENCES, of, SEVERAL)


def _judged(
    parameter: Parameter, value: float, sides: tuple[float | None, float | None], alike: float, of: Optimum, why: str
) -> Sensitivity:  # fmt: skip
    """Return what is told of one-sided derivatives: where they are the same, `value`, which is known more closely."""
    left, right = sides
    if left is None or right is None:
        return _told(parameter, of, sides, LOST)
    close = alike * max(abs(left), abs(right), of.unit)
    if abs(left - right) <= close and abs(value - left) <= close:
        return _told(parameter, of, (value, value))
    return _told(parameter, of, sides, why)


def _told(
    parameter: Parameter, of: Optimum, sides: tuple[float | None, float | None], why: str = ""
) -> Sensitivity:  # fmt: skip
    return parameter.sensitivity(LARGEST, START, sides, NOTHING * of.unit, why)
