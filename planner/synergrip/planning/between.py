"""Between the knots: what load and wish really do there, and what that makes of a plan."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import compress

import numpy as np
from numpy.typing import NDArray

from synergrip.conic.formulation import Formulation
from synergrip.conic.limits.limit import Usage
from synergrip.conic.well_formed import usage_of
from synergrip.documents.in_order import InOrder
from synergrip.linalg import Array, interpolated
from synergrip.planning.instants import intersample_of
from synergrip.statics.analysis import Analysis
from synergrip.statics.motion import Motion, forward
from synergrip.tasks.marks import SAME_TIME
from synergrip.tasks.timed_task import TimedTask
from synergrip.values import Value

LIMIT = 1e-6
"""Relative tolerance of limits in the linear model, against the load or the limit itself."""
STRAIGHT = 1e-9
"""Departure from a straight line, relative to the load or the wish, that is rounding."""


@dataclass(frozen=True, eq=False, repr=False)
class Between(Value):
    """A plan between its knots, its references linear there and its loads as they are."""

    samples: int
    """Evenly spaced instants looked at in each piece, between knots and corners, in which load or wish is curved; where
    the hand really moves in every piece, and more of them where a load bends more elsewhere than in the middle."""
    load_departure: float
    """[N] how far the load leaves the straight line between knots (moments over the length)."""
    path_departure: float
    """[m] how far the wanted motion leaves it (rotations times the length)."""
    path_size: float
    """[m] how far the object is wanted from where it starts, at most."""
    usages: tuple[Usage, ...]
    """What the plan uses of every limit that speaks of an instant, friction cones first: at all that was looked at, the
    knots too."""
    corners: tuple[float, ...] = ()
    """[s] the corners between the knots that were looked at, each once: lines of tables, starts, ends, peaks, jumps."""
    rooms: tuple[Array, ...] | None = None
    """(m,) for each usage, how far beyond its limit each item counts as kept where the hand really moves; None in the
    linear model."""
    off_course: float = 0.0
    """[m] how far the object is off where it is wanted between the knots, beyond what it is at these and what it sags,
    where the hand really moves; rotations times the length."""

    def __post_init__(self) -> None:
        """Let limits be found by their names, too."""
        object.__setattr__(self, "usages", InOrder("usages", self.usages, "title"))

    @property
    def exact(self) -> bool:
        """True when nothing is curved: what holds at the knots and at the corners then holds at all times."""
        return self.samples == 0 and self.rooms is None

    @property
    def straight(self) -> bool:
        """True when nothing bends: what holds at the knots then holds between them."""
        return self.load_departure == 0.0 and self.path_departure == 0.0

    @property
    def excess(self) -> float:
        """How far the worst value is beyond its limit, in units of the limit; not above 0 where that is kept."""
        rooms = (np.zeros(1),) * len(self.usages) if self.rooms is None else self.rooms
        pairs = zip(self.usages, rooms, strict=True)
        return max(min(u.violation, 0.0) if np.all(u.excess <= room) else u.violation for u, room in pairs)

    @property
    def broken(self) -> tuple[Usage, ...]:
        """What is used of the limits that are not kept."""
        return tuple(usage for usage, _ in self._beyond())

    def broken_at(self, title: str, times: Array) -> bool:
        """Whether the limit of a title is not kept at one of some times (T,) [s], such as the knots."""
        same = SAME_TIME * max(float(times[-1]), 1.0)
        return any(
            bool(np.isclose(usage.times[beyond.any(axis=1), None], times, rtol=0, atol=same).any())
            for usage, beyond in self._beyond()
            if usage.title == title
        )

    def _beyond(self) -> Iterator[tuple[Usage, NDArray[np.bool_]]]:
        """Yield the limits that are not kept, each with where (T, m) it is not."""
        rooms = (None,) * len(self.usages) if self.rooms is None else self.rooms
        for usage, room in zip(self.usages, rooms, strict=True):
            beyond = usage.excess > (LIMIT * usage.size if room is None else room)
            if np.any(beyond):
                yield usage, beyond


def between(
    task: TimedTask,
    analysis: Analysis,
    formulation: Formulation,
    motion: Motion,
    at_knots: Sequence[Usage] | None = None,
) -> Between | None:
    """Look at a plan between its knots; None when there is nothing between them, or no more is known.

    Args:
        task: whose plan it is.
        analysis: of the grasp.
        formulation: of the task.
        motion: that the plan makes.
        at_knots: what it uses of every limit there, if that is known: all there is to see where nothing bends between.
    """
    intersample = formulation.intersample or intersample_of(task, analysis)
    if intersample is None:
        return None
    looks, of_instants = intersample.all, [not limit.couples_knots for limit in task.all_limits]
    if intersample.only_knots and at_knots is not None:
        usages = tuple(compress(at_knots, of_instants))
    else:
        dz_r = interpolated(looks.times, task.times, motion.dz_r)
        there = forward(analysis.response, looks.times, dz_r, looks.wrench)
        dense = replace(formulation, times=looks.times, wrench=looks.wrench, target=looks.target)
        usages = tuple(usage_of(limit, dense, there) for limit in compress(task.all_limits, of_instants))
    scale, (load, path) = analysis.response.scale, intersample.departures(task.times, task.wrench, formulation.target)
    loads, paths = (scale.wrench(load), scale.wrench(looks.wrench)), (scale.twist(path), scale.twist(looks.target))
    size = float(np.linalg.norm(paths[1], axis=1).max(initial=0.0))
    corners = tuple(dict.fromkeys(intersample.corners.times.tolist()))
    return Between(intersample.samples, _size(*loads), _size(*paths), size, usages, corners)


def _size(departure: Array, whole: Array) -> float:
    """Return the largest departure; 0 when it is rounding."""
    size = float(np.linalg.norm(departure, axis=1).max(initial=0.0))
    return size if size > STRAIGHT * float(np.linalg.norm(whole, axis=1).max(initial=0.0)) else 0.0
