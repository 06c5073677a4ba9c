"""A task judged as that of a problem file, for tasks that are made in Python."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import fields, is_dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from synergrip.documents.documents import LARGEST_NUMBER
from synergrip.documents.validation import shown
from synergrip.errors import Issue, one_of
from synergrip.grasps.grasp_judging import Judge
from synergrip.linalg import Array, frozen

BOUNDS = ("limit", "lower", "upper", "margin", "ratios")
"""The fields of limits that are numbers and no names."""
ORDER = 'write for example ("effort",) or ("margin", "effort")'


def times_of(judge: Judge, times: Any) -> Array:
    """Return the knots (T,), after noting that they are none, or do not increase."""
    count = np.size(np.asarray(times, dtype=object)) if not isinstance(times, str) else 0
    found = judge.array("times", times, (count,), ": one or more instants in seconds")
    if not count:
        judge.refuse("times", "expected one or more instants in seconds, got none; write for example [0.0]")
    for earlier, later in pairwise(found if not judge.issues else ()):
        if later <= earlier:
            what = "is repeated" if later == earlier else f"comes after {earlier:g} s"
            judge.refuse("times", f"times must increase: {later:g} s {what}; sort them, with the lines of wrench")
            break
    return found


def wrench_of(judge: Judge, wrench: Any, count: int) -> Array:
    """Return the wrench (T, 6); one of 6 numbers is the same at all knots."""
    if np.shape(wrench) == (6,):
        return frozen(np.tile(judge.array("wrench", wrench, (6,)), (count, 1)))
    return judge.array(
        "wrench", wrench, (count, 6), f" (3 forces [N] and 3 moments [N m] about B at each of {count} knots), or (6,)"
    )


def order_issues(order: Any, weights: Mapping[Any, Any], names: Sequence[str], sums: Sequence[str]) -> Iterator[Issue]:
    """Yield what is wrong with goals and weights.

    Args:
        order: of the goals.
        weights: of those in "weighted".
        names: of all goals.
        sums: of those that can be weighted.
    """
    if isinstance(order, str) or not isinstance(order, Iterable) or not list(order):
        got = "none" if order == () else shown(order)
        yield Issue(f"expected one or more goals, got {got}; {ORDER}", "Task.order")
        return
    given = list(order)
    for index, name in enumerate(given):
        if name not in names:
            yield Issue(one_of(name, names), f"Task.order[{index}]")
        elif name in given[:index]:
            yield Issue(f"'{name}' is listed twice", f"Task.order[{index}]")
    for name, weight in weights.items():
        if name not in sums:
            yield Issue(f"{one_of(name, sums)}; only sums of squares have weights", f"Task.weights[{name!r}]")
        elif not _is_number(weight) or weight <= 0:
            yield Issue(f"expected a number greater than 0, got {_shown(weight)}", f"Task.weights[{name!r}]")
    if "weighted" in given and not weights:
        message = "'weighted' in the order needs weights, for example {'effort': 1.0, 'smooth': 0.1}"
        yield Issue(f"{message}; got none, with which nothing is minimised", "Task.weights")


def size_issues(margin: Any, tolerance: Any, drift: Any, compliant: bool) -> Iterator[Issue]:
    """Yield what is wrong with sizes: a margin [N], a tolerance [m], which compliant tracking needs, a drift [m]."""
    if not _is_number(margin) or margin < 0:
        wanted = "a slip margin in newtons of at least 0; 0 asks only that nothing slips"
        yield Issue(f"expected {wanted}, got {_shown(margin)}", "Task.margin")
    if not _is_number(tolerance) or tolerance < 0 or (compliant and tolerance == 0):
        bound = "greater than 0, as compliant tracking needs it" if compliant else "of at least 0"
        yield Issue(f"expected a length in metres {bound}, got {_shown(tolerance)}", "Task.tolerance")
    if drift is not None and (not _is_number(drift) or drift <= 0):
        yield Issue(f"expected a length in metres greater than 0, or None, got {_shown(drift)}", "Task.drift")


def limit_issues(limits: Any) -> Iterator[Issue]:
    """Yield what is wrong with limits: no limit at all, bounds that are no numbers, crossed or negative ones."""
    for index, limit in enumerate(limits):
        key = f"Task.limits[{index}]"
        if not is_dataclass(limit) or not hasattr(limit, "usage"):
            yield Issue(f"expected a limit such as NormalForce(0.0, 20.0), got {shown(limit)}", key)
            continue
        values = {each.name: getattr(limit, each.name) for each in fields(limit) if each.name in BOUNDS}
        numbers = {name: value for name, value in values.items() if isinstance(value, int | float | np.ndarray)}
        for name, value in numbers.items():
            if np.any(np.isnan(value)):
                yield Issue("expected numbers, got nan; infinity stands for no bound", f"{key}.{name}")
            elif name in ("limit", "margin", "ratios") and np.any(np.asarray(value) < 0):
                yield Issue(f"expected sizes of at least 0, got {float(np.min(value)):g}", f"{key}.{name}")
        low, high = numbers.get("lower", -np.inf), numbers.get("upper", np.inf)
        if np.shape(low) == np.shape(high) and np.any(np.asarray(low) > high):
            yield Issue(f"the lower bound {np.max(low):g} is above the upper bound {np.min(high):g}; swap them", key)


def word_issues(**words: tuple[object, Sequence[str]]) -> Iterator[Issue]:
    """Yield an issue for each argument that is none of its words."""
    for name, (word, valid) in words.items():
        if not isinstance(word, str) or word not in valid:
            yield Issue(one_of(word, valid), f"Task.{name}")


def _shown(value: Any) -> str:
    return f"{float(value):g}" if isinstance(value, np.number) else shown(value)


def _is_number(value: Any) -> bool:
    is_number = isinstance(value, int | float | np.number) and not isinstance(value, bool)
    return bool(is_number and -LARGEST_NUMBER <= value <= LARGEST_NUMBER)
