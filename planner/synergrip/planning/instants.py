"""Which instants between its knots a task is looked at: corners of load and wish, and some where they are curved."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from synergrip.conic.intersample import Intersample, Looks, samples_for, shares
from synergrip.linalg import Array, frozen, interpolated
from synergrip.statics.analysis import Analysis
from synergrip.tasks.marks import SAME_TIME, Jump, Marks
from synergrip.tasks.timed_task import Course, TimedTask
from synergrip.tasks.tracking import target_displacement

SAME = 1e-12
"""Relative size of what is no difference between two loads or wishes."""


def intersample_of(task: TimedTask, analysis: Analysis) -> Intersample | None:
    """Return what load and wish do between the knots; None when there is nothing between them, or no more is known."""
    if task.course is None or len(task.times) < 2:
        return None
    marks = task.course.marks
    knots = Looks(task.times, task.wrench, target_displacement(analysis, task, task.target.values))
    inside = (marks.corners > task.times[0]) & (marks.corners < task.times[-1])
    if not marks.jumps and not marks.curved and not inside.any():
        return Intersample.of_knots(knots)
    corners, sides = _corners(task, task.course, marks, analysis)
    new = _off_the_knots(corners, sides, knots)
    grid, corner = _grid(knots, corners.of(new), sides[new])
    pieces = _curved(grid.times, marks)
    if not marks.curved:
        keep = ~corner | _changes(grid)
        grid, corner = grid.of(keep), corner[keep]
    samples = samples_for(len(pieces))
    first, last = grid.times[pieces], grid.times[pieces + 1]
    inner = (first[:, None] + (last - first)[:, None] * shares(samples)).ravel()
    curved = looked_at(task, task.course, inner, analysis) if len(pieces) else grid.of(pieces)
    return Intersample(grid, corner, pieces, samples, curved)


def looked_at(task: TimedTask, course: Course, times: Array, analysis: Analysis) -> Looks:
    """Return load and wish at any instants."""
    load = course.load_at(times)
    wrench = interpolated(times, task.times, task.wrench) if load is None else load
    return Looks(frozen(times), frozen(wrench), target_displacement(analysis, task, course.target_at(times)))


def _corners(task: TimedTask, course: Course, marks: Marks, analysis: Analysis) -> tuple[Looks, NDArray[np.intp]]:
    """Return the corners within the task, and whether each is just before an instant (-1), at it (0), or after (1)."""
    first, last = float(task.times[0]), float(task.times[-1])
    inside = np.unique(marks.corners[(marks.corners > first) & (marks.corners < last)])
    beside = sorted({(_on_a_knot(jump, task.times), jump.side) for jump in marks.jumps})
    beside = [(time, side) for time, side in beside if (time > first if side < 0 else time < last)]
    beside = [(time, side) for time, side in beside if first <= time <= last]
    times = np.concatenate([inside, [time for time, _ in beside]])
    sides = np.concatenate([np.zeros(len(inside)), [side for _, side in beside]]).astype(np.intp)
    looks = looked_at(task, course, times, analysis)
    wrench = np.array(looks.wrench)
    for i, (time, side) in enumerate(beside, start=len(inside)):
        for jump in marks.jumps:
            if (_on_a_knot(jump, task.times), jump.side) == (time, side):
                wrench[i] += jump.change
    return Looks(looks.times, frozen(wrench), looks.target), sides


def _on_a_knot(jump: Jump, knots: Array) -> float:
    """Return the time of a jump: that of the knot where there is one."""
    nearest = float(knots[np.abs(knots - jump.time).argmin()])
    return nearest if abs(nearest - jump.time) <= SAME_TIME * max(float(knots[-1]), 1.0) else jump.time


def _off_the_knots(corners: Looks, sides: NDArray[np.intp], knots: Looks) -> NDArray[np.bool_]:
    """Return which corners (C,) are no knots: at another time, or with another load or wish."""
    after = np.clip(np.searchsorted(knots.times, corners.times), 1, len(knots.times) - 1)
    nearer = corners.times - knots.times[after - 1] < knots.times[after] - corners.times
    nearest = np.where(nearer, after - 1, after)
    new = np.abs(corners.times - knots.times[nearest]) > SAME_TIME * max(float(knots.times[-1]), 1.0)
    for one, other in ((corners.wrench, knots.wrench), (corners.target, knots.target)):
        size = float(np.abs(other).max(initial=0.0))
        new |= np.abs(one - other[nearest]).max(axis=1, initial=0.0) > SAME * size
    return np.asarray(new | (sides != 0))


def _grid(knots: Looks, corners: Looks, sides: NDArray[np.intp]) -> tuple[Looks, NDArray[np.bool_]]:
    """Return knots and corners in order, and which of them are corners."""
    whole = knots.and_then(corners)
    order = np.lexsort((np.concatenate([np.zeros(len(knots.times)), sides]), whole.times))
    return whole.of(order), order >= len(knots.times)


def _changes(grid: Looks) -> NDArray[np.bool_]:
    """Return at which instants (G,) load or wish are not what they are at both neighbours."""
    same = np.all(np.diff(np.hstack([grid.wrench, grid.target]), axis=0) == 0, axis=1)
    ends = np.zeros(1, dtype=bool)
    return np.asarray(~(np.concatenate([ends, same]) & np.concatenate([same, ends])))


def _curved(times: Array, marks: Marks) -> NDArray[np.intp]:
    """Return the pieces between the instants (G,) that lie in a curved span of time."""
    slack = SAME_TIME * max(float(times[-1]), 1.0)
    first, last = times[:-1], times[1:]
    found = np.zeros(len(times) - 1, dtype=bool)
    for start, end in marks.curved:
        found |= (first < end - slack) & (last > start + slack)
    return np.flatnonzero(found & (last > first))
