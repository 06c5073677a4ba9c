"""The instants at which a plan is made: those asked for, or those at which something begins, ends or bends."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise

import numpy as np

from synergrip.documents.time_table import Table
from synergrip.errors import InputError, Issue
from synergrip.linalg import Array
from synergrip.problems.task_file import MOST_KNOTS, TaskTable
from synergrip.tasks.marks import SAME_TIME, distinct
from synergrip.tasks.profiles import SHORTEST
from synergrip.tasks.pushes import Push

MOVING_KNOTS = 41
"""Knots of a task that moves or turns and does not say how many."""


def span(task: TaskTable, tables: Mapping[str, Table]) -> tuple[float, float]:
    """Return the times at which the task begins and ends [s].

    It ends as `duration` says, else with the CSV files and the last waypoint. It begins at 0, or with the first
    line of its CSV files when they alone say what happens when.
    """
    ends = [float(table.times[-1]) for table in tables.values()] + [point.time for point in task.waypoint[-1:]]
    end = max(ends) if ends and "duration" not in task.model_fields_set else task.duration
    if not tables or task.knots is not None or task.timed:
        return 0.0, end
    return min(*(float(table.times[0]) for table in tables.values()), end), end


def knots(task: TaskTable, tables: Mapping[str, Table], pushes: Sequence[Push], start: float, end: float) -> Array:
    """Return the knots: evenly spaced when their number is given, else where something begins, ends or bends.

    Raises:
        InputError: no time for the given number of knots, or a waypoint or push that falls between them.
    """
    if task.knots is not None:
        if task.knots > 1 and end - start < SHORTEST:
            message = f"there is no time for {task.knots} knots: the task begins at {start:g} s and ends at {end:g} s"
            raise InputError.at("task.knots", message)
        times = np.linspace(start, end, task.knots) if task.knots > 1 else np.zeros(1)
        _between_knots(task, pushes, times)
        return times
    every = np.concatenate([np.zeros(0), *(table.times for table in tables.values())])
    if task.curved:
        every = np.concatenate([every, [point.time for point in task.waypoint], *(push.knots for push in pushes)])
    elif not tables and not (task.move or task.palm):
        return np.zeros(1)
    corners = distinct(np.append(every[(every > start) & (every < end)], [start, end]))
    if len(corners) > MOST_KNOTS:
        message = f"every line makes a knot, which makes {len(corners)} knots; at most {MOST_KNOTS}: give task.knots"
        raise InputError.at(f"task.{next(iter(tables), 'waypoint')}", message)
    return _filled(corners) if task.curved or not tables else corners


def _filled(corners: Array) -> Array:
    """Return the corners with evenly spaced knots between each two, as many as `MOVING_KNOTS` for a whole task."""
    step = (corners[-1] - corners[0]) / (MOVING_KNOTS - 1)
    if step == 0:
        return corners
    parts = [
        np.linspace(first, last, max(round(np.ceil((last - first) / step - SAME_TIME)), 1), endpoint=False)
        for first, last in pairwise(corners)
    ]
    return np.append(np.concatenate(parts), corners[-1])


def _between_knots(task: TaskTable, pushes: Sequence[Push], times: Array) -> None:
    """Refuse given knots that would pass over a waypoint, or over the start, end or peak of a push."""
    marks = [(f"task.waypoint[{i}].time", "the waypoint", point.time) for i, point in enumerate(task.waypoint)]
    for index, push in enumerate(pushes):
        if not task.push[index].lasting:
            names = {"start": "the start", "end": "the end", "ramp": "a ramp corner", "profile": "the peak"}
            marks += [(f"task.push[{index}].{name}", names[name], time) for name, time in push.corners]
    slack = SAME_TIME * max(float(times[-1]), 1.0)
    issues = dict[str, Issue]()
    for key, what, time in marks:
        if np.abs(times - time).min() > slack:
            message = (
                f"{what} at {time:g} s is not on a knot, and the plan would miss it: the knots are "
                f"{times[-1] / (len(times) - 1):.4g} s apart; leave out task.knots, and there will be one"
            )
            issues.setdefault(key, Issue(message, key=key))
    if issues:
        raise InputError(list(issues.values()))


def cover(table: Table, times: Array, key: str) -> None:
    """Refuse a table that leaves out a part of the task.

    Raises:
        InputError: it begins after the first knot or ends before the last.
    """
    slack = SAME_TIME * max(float(times[-1]), 1.0)
    if table.times[0] > times[0] + slack or table.times[-1] < times[-1] - slack:
        message = (
            f"the file covers {table.times[0]:g} s to {table.times[-1]:g} s, the task {times[0]:g} s to "
            f"{times[-1]:g} s; change the file, task.duration or task.knots"
        )
        raise InputError.at(key, message)
