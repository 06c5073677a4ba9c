"""A task judged as that of a problem file, for tasks that are made in Python."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import numpy as np

from synergrip.conic.goals.goal import Goal
from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.slip_margin import MARGIN
from synergrip.documents.documents import LARGEST_NUMBER
from synergrip.documents.judging import as_numbers, described, is_list, is_number, unfinished
from synergrip.documents.validation import shown
from synergrip.errors import Issue, one_of
from synergrip.grasps.grasp_judging import Judge
from synergrip.linalg import Array, frozen

GOALS = "write for example goals=(LeastEffort(),) or (LargestMargin(), LeastEffort())"
LIMITS = "write for example limits=(SlipMargin(0.5), NormalForce(upper=20.0))"


def times_of(judge: Judge, times: Any) -> Array:
    """Return the knots (T,), after noting that they are none, or do not increase."""
    given = times if isinstance(times, np.ndarray) else np.asarray(times, dtype=object)
    count = given.size if not isinstance(times, str) else 0
    found = judge.array("times", times, (count,), ": one or more instants in seconds")
    if not count:
        judge.refuse("times", "expected one or more instants in seconds, got none; write for example [0.0]")
    if judge.issues or (found[1:] > found[:-1]).all():
        return found
    for earlier, later in pairwise(found):
        if later <= earlier:
            what = "is repeated" if later == earlier else f"comes after {earlier:g} s"
            judge.refuse("times", f"times must increase: {later:g} s {what}; sort them, with the lines of wrench")
            break
    return found


def wrench_of(judge: Judge, wrench: Any, count: int) -> Array:
    """Return the wrench (T, 6); one of 6 numbers is the same at all knots."""
    found = as_numbers(wrench)
    if found is not None and found.shape == (6,):
        return frozen(np.tile(judge.array("wrench", wrench, (6,)), (count, 1)))
    return judge.array(
        "wrench", wrench, (count, 6), f" (3 forces [N] and 3 moments [N m] about B at each of {count} knots), or (6,)"
    )


def goal_issues(goals: Any) -> Iterator[Issue]:
    """Yield what is wrong with goals: none, no goals, one of them twice."""
    if not is_list(goals) or not goals:
        got = "none" if isinstance(goals, tuple) else shown(goals)
        yield Issue(f"expected one or more goals, got {got}; {GOALS}", "Task.goals")
        return
    given = list(goals)
    for index, goal in enumerate(given):
        if not isinstance(goal, Goal):
            yield Issue(f"expected a goal, got {shown(goal)}; {GOALS}", f"Task.goals[{index}]")
        elif lacking := unfinished(goal):
            yield Issue(lacking, f"Task.goals[{index}]")
        elif goal in given[:index]:
            yield Issue(f"'{goal.name}' is listed twice", f"Task.goals[{index}]")


def size_issues(margin: Any, tolerance: Any, drift: Any, compliant: bool) -> Iterator[Issue]:
    """Yield what is wrong with sizes: a margin [N], a tolerance [m], which compliant tracking needs, a drift [m]."""
    if not _is_size(margin) or margin < 0:
        yield Issue(f"expected {MARGIN}, got {described(margin)}", "Task.margin")
    if not _is_size(tolerance) or tolerance < 0 or (compliant and tolerance == 0):
        bound = "greater than 0, as compliant tracking needs it" if compliant else "of at least 0"
        yield Issue(f"expected a length in metres {bound}, got {described(tolerance)}", "Task.tolerance")
    if drift is not None and (not _is_size(drift) or drift <= 0):
        yield Issue(f"expected a length in metres greater than 0, or None, got {described(drift)}", "Task.drift")


def limit_issues(limits: Any) -> Iterator[Issue]:
    """Yield what is no limit at all."""
    if not is_list(limits):
        yield Issue(f"expected limits, got {shown(limits)}; {LIMITS}", "Task.limits")
        return
    for index, limit in enumerate(limits):
        if not isinstance(limit, Limit):
            yield Issue(f"expected a limit, got {shown(limit)}; {LIMITS}", f"Task.limits[{index}]")
        elif lacking := unfinished(limit):
            yield Issue(lacking, f"Task.limits[{index}]")


def word_issues(tracking: object, linearise: object, between: object, tie_break: object) -> Iterator[Issue]:
    """Yield an issue for each argument that is none of its words; `between` may be None."""
    if not isinstance(tie_break, bool):
        yield Issue(f"expected True or False, got {described(tie_break)}", "Task.tie_break")
    words = {"tracking": (tracking, ("rigid", "compliant")), "linearise": (linearise, ("once", "along"))}
    if between is not None:
        words["between"] = between, ("report", "hold")
    for name, (word, valid) in words.items():
        if not isinstance(word, str) or word not in valid:
            yield Issue(one_of(word, valid), f"Task.{name}")


def _is_size(value: Any) -> bool:
    return is_number(value) and bool(-LARGEST_NUMBER <= value <= LARGEST_NUMBER)
