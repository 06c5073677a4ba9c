"""Whether limits and goals say what a program can hold: those of one's own may get shapes wrong."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from synergrip.conic.arguments import is_own
from synergrip.conic.formulation import Affine, Formulation
from synergrip.conic.goals.goal import Goal, Objective, Squares
from synergrip.conic.limits.limit import WATCHES, Limit, Usage
from synergrip.conic.rows import Rows
from synergrip.documents.judging import Arguments, as_numbers, described, is_word
from synergrip.documents.validation import shown
from synergrip.errors import InputError, one_of
from synergrip.statics.motion import Motion


def refuse_malformed(limits: Sequence[Limit], goals: Sequence[Goal], formulation: Formulation) -> None:
    """Refuse rows and objectives whose shapes do not fit the task, of limits and goals that are not the library's.

    Args:
        limits: of the task.
        goals: of the task.
        formulation: which has the unknowns and the knots.

    Raises:
        InputError: the first one, with the method that returned it.
    """
    for limit in filter(_of_ones_own, limits):
        name = type(limit).__name__
        _judge_words(limit, "key", limit.key)
        rows = _judged_rows(f"{name}.rows", limit.rows(formulation), formulation)
        _judge_bounded(f"{name}.bounded", limit.bounded(formulation, cones_hold=True))
        if not limit.couples_knots and any(part.earlier for part in rows):
            wanted = "rows that speak of one knot, since the limit says that it couples none"
            raise InputError.at(f"{name}.rows", f"expected {wanted}; write couples_knots = True in the class")
    for goal in filter(_of_ones_own, goals):
        name = type(goal).__name__
        _judge_words(goal, "name", goal.name)
        cost = goal.objective(formulation)
        if not isinstance(cost, Objective):
            raise InputError.at(f"{name}.objective", f"expected an Objective, got {type(cost).__name__}")
        for squares in cost.squares:
            _judge_squares(f"{name}.objective", squares, formulation)
        if goal.has_scalar != (cost.epigraph is not None) or (goal.has_scalar and cost.squares):
            is_so = "has a scalar" if goal.has_scalar else "has no scalar"
            wanted = "an epigraph and no squares" if goal.has_scalar else "squares and no epigraph"
            raise InputError.at(f"{name}.objective", f"expected {wanted}, since the goal {is_so} (has_scalar)")
        _judged_rows(f"{name}.rows", goal.rows(formulation), formulation)


def _of_ones_own(part: Limit | Goal) -> bool:
    """Return whether somebody else wrote it: what the library has is tested."""
    return is_own(type(part))


def _judge_words(part: Limit | Goal, name: str, value: object) -> None:
    """Refuse a key or name that is none, and a word for what it depends on that is none."""
    judge = Arguments(type(part).__name__)
    judge.text(name, value, empty=False)
    if not is_word(part.watches, WATCHES):
        judge.refuse("watches", one_of(part.watches, WATCHES))
    judge.finish()


def _judge_bounded(key: str, given: Any) -> None:
    """Refuse what are no quantities with a size for each."""
    if given is None:
        return
    value, sizes = given if isinstance(given, tuple) and len(given) == 2 else (given, None)
    found = as_numbers(sizes)
    if not isinstance(value, Affine) or found is None or found.shape != value.constant.shape[1:]:
        wanted = "a pair of quantities, such as formulation.force, and their largest sizes (m,), or None"
        raise InputError.at(key, f"expected {wanted}; got {described(given)}")


def _judged_rows(key: str, given: Any, formulation: Formulation) -> list[Rows]:
    """Return rows as a list, after refusing what are none or do not fit the task."""
    parts = list(given) if isinstance(given, Iterable) else [given]
    if not isinstance(given, Iterable) or not all(isinstance(part, Rows) for part in parts):
        raise InputError.at(key, f"expected a list of Rows, got {type(given).__name__}")
    for part in parts:
        _judge_shapes(key, part, len(part.items) * part.dim, formulation)
        if np.shape(part.epigraph) != (len(part.items) * part.dim,):
            wanted = f"one number for each of the {len(part.items) * part.dim} rows"
            raise InputError.at(key, f"expected {wanted} as epigraph, got shape {np.shape(part.epigraph)}")
    return parts


def _judge_squares(key: str, given: Any, formulation: Formulation) -> None:
    if not isinstance(given, Squares):
        raise InputError.at(key, f"expected Squares in the objective, got {type(given).__name__}")
    _judge_shapes(key, given, np.shape(given.matrix)[-2], formulation)


def _judge_shapes(key: str, given: Rows | Squares, count: int, formulation: Formulation) -> None:
    """Refuse a matrix that is not (count, n_v) for each knot, or constants that are not (K, count) for K <= T knots."""
    matrix, constant = np.shape(given.matrix), np.shape(given.constant)
    if matrix[-2:] != (count, formulation.n_v):
        wanted = f"a matrix with a row for each item and a column for each unknown, {(count, formulation.n_v)}"
        raise InputError.at(key, f"expected {wanted}, got shape {matrix}")
    inside = getattr(given, "inside", None)
    most = formulation.knots if inside is None else inside.shape[0]
    if len(constant) != 2 or constant[1] != count or constant[0] > most:
        wanted = f"constants at {most} knots for {count} rows, {(most, count)}"
        raise InputError.at(key, f"expected {wanted}, got shape {constant}")
    if not (np.all(np.isfinite(given.matrix)) and np.all(np.isfinite(given.constant))):
        raise InputError.at(key, "expected finite numbers in matrix and constant, got nan or infinity")


def usage_of(limit: Limit, formulation: Formulation, motion: Motion) -> Usage:
    """Return what a limit says of a motion, after refusing of one that is not the library's what no check can go by.

    Raises:
        InputError: no `Usage`, none of its items, sizes that are none, values or bounds that are no numbers.
    """
    key, usage = f"{type(limit).__name__}.usage", limit.usage(formulation, motion)
    if not _of_ones_own(limit):
        return usage
    if not isinstance(usage, Usage):
        raise InputError.at(key, f"expected a Usage, got {type(usage).__name__}")
    value = np.asarray(usage.value, dtype=np.float64)
    if usage.times is not motion.times and not np.array_equal(usage.times, motion.times):
        raise InputError.at(key, "expected the motion's times; write motion.times")
    if not usage.items or value.shape != (len(motion.times), len(usage.items)):
        wanted = f"a value at each of {len(motion.times)} knots for each of its {len(usage.items)} items"
        raise InputError.at(key, f"expected {wanted} (one or more), got shape {value.shape}")
    if len(set(usage.items)) < len(usage.items):
        raise InputError.at(key, f"expected a name for each item, got {shown(usage.items)}")
    for name, sizes in (("scale", usage.scale), ("allowance", usage.allowance)):
        if sizes is None:
            continue
        bad = ~((sizes > 0) & (sizes < np.inf))
        if bad.any():
            wanted = f"finite sizes greater than 0 as {name}"
            raise InputError.at(key, f"expected {wanted}, got {float(sizes[bad][0]):g}")
    if any(np.isnan(each).any() for each in (value, usage.lower, usage.upper)):
        raise InputError.at(key, "expected numbers as value, lower and upper, got nan")
    return usage
