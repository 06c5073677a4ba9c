"""At which instants between the knots it is looked at what references really do there."""

from __future__ import annotations

import numpy as np

from synergrip.conic.intersample import Intersample, Looks, shares
from synergrip.linalg import Array, interpolated
from synergrip.planning.instants import looked_at
from synergrip.statics.analysis import Analysis
from synergrip.tasks.timed_task import TimedTask

LOOKS, PARTS = 32, (2, 32)
"""How many instants between the knots are looked at, at least, and into how many parts a piece is divided for that: a
middle where there are many pieces; where these are few, or a load is curved, the middle alone says too little."""


def looks_between(task: TimedTask, start: Analysis, wanted: Array, sampled: Intersample | None, room: float) -> Looks:
    """Return the instants that are looked at: knots, corners, and some inside every piece between them.

    Args:
        task: with two knots at least.
        start: the grasp at the start.
        wanted: (T, 6) where the object is wanted at the knots [m, rad].
        sampled: what load and wish do between the knots; None when no more is known.
        room: by how much more than in the middle of a piece a load may leave its straight line elsewhere in it [N].
    """
    known = Looks(task.times, task.wrench, wanted) if sampled is None else sampled.grid
    first, wide = known.times[:-1], np.diff(known.times)
    inner = (first[:, None] + wide[:, None] * shares(samples_of(known.times)))[wide > 0].ravel()
    if sampled is not None and not sampled.exact:
        inner = np.unique(np.concatenate([inner, _bent(sampled, start, room)]))
    inside = Looks(inner, *(interpolated(inner, known.times, values) for values in (known.wrench, known.target)))
    if task.course is not None:
        inside = looked_at(task, task.course, inner, start)
    whole = known.and_then(inside)
    return whole.of(np.argsort(whole.times, kind="stable"))


def samples_of(times: Array) -> int:
    """Return how many evenly spaced instants inside each piece between knots and corners (G,) [s] are looked at."""
    return int(np.clip(-(-LOOKS // np.count_nonzero(np.diff(times))), *PARTS)) - 1


def _bent(sampled: Intersample, start: Analysis, room: float) -> Array:
    """Return the instants in those curved pieces where the load leaves its line by more than in the middle [N]."""
    departure = start.response.scale.wrench(sampled.curved.wrench - sampled.chords.wrench)
    sizes = np.linalg.norm(departure, axis=1).reshape(-1, sampled.samples)
    far = sizes.max(axis=1, initial=0.0) > sizes[:, sampled.samples // 2] + room
    return np.asarray(sampled.curved.times[np.repeat(far, sampled.samples)])
