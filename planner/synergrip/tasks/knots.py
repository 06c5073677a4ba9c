"""The instants at which a plan is made: those asked for, or those at which something begins, ends or bends."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import pairwise

import numpy as np

from synergrip.errors import InputError, Issue, raise_issues
from synergrip.linalg import Array
from synergrip.tasks.marks import SAME_TIME, distinct
from synergrip.tasks.profiles import SHORTEST
from synergrip.tasks.stated import Setting, Stated

MOVING_KNOTS = 41
"""Knots of a task that moves or turns and does not say how many."""
MOST_KNOTS = 100_000
USUAL = 1.0
"""Duration [s] of a task that does not say how long it takes, and whose loads and target do not either."""


def span(parts: Mapping[str, Stated], duration: float | None, count: int | None) -> tuple[float, float]:
    """Return the times at which the task begins and ends [s].

    It ends as `duration` says, else with its tables and the last waypoint. It begins at 0, or with the first line of
    its tables when they alone say what happens when.

    Args:
        parts: loads and target by the argument that states them.
        duration: of the task [s]; None when it is not said.
        count: number of knots; None when it is not said.

    Raises:
        InputError: no time for the number of knots, or a table that leaves out a part of the task.
    """
    ends = [part.last for part in parts.values() if part.last is not None]
    end = duration if duration is not None else max(ends, default=USUAL)
    firsts = [float(part.lines[0]) for part in parts.values() if part.lines is not None]
    alone = firsts and count is None and not any(part.timed for part in parts.values())
    start = min(*firsts, end) if alone else 0.0
    if count is not None and count > 1 and end - start < SHORTEST:
        message = f"there is no time for {count} knots: the task begins at {start:g} s and ends at {end:g} s"
        raise InputError.at("Task.knots", message)
    raise_issues(list(_uncovered(parts, start, 0.0 if count == 1 else end)))
    return start, end


def _uncovered(parts: Mapping[str, Stated], first: float, last: float) -> Iterator[Issue]:
    """Yield an issue for each table that begins after the first knot or ends before the last."""
    slack = SAME_TIME * max(last, 1.0)
    for key, part in parts.items():
        lines = part.lines
        if lines is not None and (lines[0] > first + slack or lines[-1] < last - slack):
            message = (
                f"the table covers {lines[0]:g} s to {lines[-1]:g} s, the task {first:g} s to {last:g} s; "
                "change the table, task.duration or task.knots"
            )
            yield Issue(message, key=f"Task.{key}")


def knots(parts: Mapping[str, Stated], count: int | None, setting: Setting) -> Array:
    """Return the knots: evenly spaced when their number is given, else where something begins, ends or bends.

    Args:
        parts: loads and target by the argument that states them.
        count: number of knots; None when it is not said.
        setting: when the task begins and ends.

    Raises:
        InputError: a waypoint or a push that falls between the given knots, or tables of too many lines.
    """
    start, end = setting.start, setting.end
    if count is not None:
        times = np.linspace(start, end, count) if count > 1 else np.zeros(1)
        raise_issues(list(_between_knots(parts, setting, times)))
        return times
    tables = {key: part.lines for key, part in parts.items() if part.lines is not None}
    curved = any(part.curved for part in parts.values())
    every = np.concatenate([np.zeros(0), *tables.values()])
    if curved:
        every = np.concatenate([every, *(part.knots(setting) for part in parts.values())])
    elif not tables and not any(part.moving for part in parts.values()):
        return np.zeros(1)
    corners = distinct(np.append(every[(every > start) & (every < end)], [start, end]))
    if len(corners) > MOST_KNOTS:
        message = f"every line makes a knot, which makes {len(corners)} knots; at most {MOST_KNOTS}: give task.knots"
        raise InputError.at(f"Task.{next(iter(tables), 'target')}", message)
    return _filled(corners) if curved or not tables else corners


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


def _between_knots(parts: Mapping[str, Stated], setting: Setting, times: Array) -> Iterator[Issue]:
    """Yield given knots that would pass over a waypoint, or over the start, end or peak of a push, once for each."""
    slack = SAME_TIME * max(float(times[-1]), 1.0)
    every = [
        (f"Task.{key}.{name}", what, time) for key, part in parts.items() for name, what, time in part.corners(setting)
    ]
    missed = {}
    for place, what, time in every:
        if place not in missed and np.abs(times - time).min() > slack:
            missed[place] = (what, time)
    others = _fitting(np.array([time for *_, time in every]), times) if missed else []
    take = f", or take {' or '.join(map(str, others))} knots" if others else ""
    for place, (what, time) in missed.items():
        message = (
            f"{what} at {time:g} s is not on a knot, and the plan would miss it: the knots are "
            f"{times[-1] / (len(times) - 1):.4g} s apart; leave out task.knots, and there will be one{take}"
        )
        yield Issue(message, key=place)


def _fitting(corners: Array, times: Array) -> list[int]:
    """Return the numbers of evenly spaced knots next below and next above that have one at every corner, as near by."""
    count, span = len(times), float(times[-1] - times[0])
    if not span > 0:
        return []
    near = np.arange(max(count // 2, 2), min(2 * count, MOST_KNOTS) + 1)
    at = (corners - times[0])[:, None] / span * (near - 1)
    fits = near[np.abs(at - np.round(at)).max(axis=0) <= SAME_TIME * (near - 1)]
    return [*fits[fits < count][-1:].tolist(), *fits[fits > count][:1].tolist()]
