"""Between the knots: what load and wish really do there, and what that makes of a plan."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from synergrip.conic.bend import Bend, instants
from synergrip.conic.limits.limit import Usage
from synergrip.conic.situation import Situation
from synergrip.linalg import Array, frozen, interpolated
from synergrip.plans.analysis import Analysis
from synergrip.plans.task import Task
from synergrip.plans.tracking import wished
from synergrip.statics.motion import Motion, forward

STRAIGHT = 1e-9
"""Departure from a straight line, relative to the load or the wish, that is rounding."""


@dataclass(frozen=True)
class Between:
    """A plan between its knots, its references linear there and its loads as they are."""

    samples: int
    """Instants looked at in each interval."""
    load_departure: float
    """[N] how far the load leaves the straight line between knots (moments over the length)."""
    path_departure: float
    """[m] how far the wanted motion leaves it (rotations times the length)."""
    path_size: float
    """[m] how far the object is wanted from where it starts, at most."""
    usages: tuple[Usage, ...]
    """What the plan uses there of every limit that speaks of an instant, friction cones first."""

    @property
    def straight(self) -> bool:
        """True when nothing bends: what holds at the knots then holds between them."""
        return self.load_departure == 0.0 and self.path_departure == 0.0

    @property
    def excess(self) -> float:
        """How far the worst value is beyond its limit, in units of the limit; negative inside."""
        return max(usage.violation for usage in self.usages)


def bend_of(task: Task, analysis: Analysis) -> Bend | None:
    """Return what load and wish do between the knots; None when there is nothing between them, or no more is known."""
    if task.course is None or len(task.times) < 2:
        return None
    samples, times = instants(task.times)
    load = task.course.load_at(times)
    wrench = frozen(interpolated(times, task.times, task.wrench)) if load is None else load
    return Bend(samples, frozen(times), wrench, wished(analysis, task, task.course.wanted_at(times)))


def between(task: Task, analysis: Analysis, situation: Situation, motion: Motion) -> Between | None:
    """Look at a plan between its knots; None when there is nothing between them, or no more is known."""
    bend = situation.bend or bend_of(task, analysis)
    if bend is None:
        return None
    dz_r = interpolated(bend.times, task.times, motion.dz_r)
    there = forward(analysis.response, bend.times, dz_r, bend.wrench)
    dense = replace(situation, times=bend.times, wrench=bend.wrench, wanted=bend.wanted)
    usages = tuple(limit.usage(dense, there) for limit in task.all_limits if not limit.couples_knots)
    scale, (load, path) = analysis.response.scale, bend.departures(task.times, task.wrench, situation.wanted)
    loads, paths = (scale.wrench(load), scale.wrench(bend.wrench)), (scale.twist(path), scale.twist(bend.wanted))
    size = float(np.linalg.norm(paths[1], axis=1).max(initial=0.0))
    return Between(bend.samples, _size(*loads), _size(*paths), size, usages)


def _size(departure: Array, whole: Array) -> float:
    """Return the largest departure; 0 when it is rounding."""
    size = float(np.linalg.norm(departure, axis=1).max(initial=0.0))
    return size if size > STRAIGHT * float(np.linalg.norm(whole, axis=1).max(initial=0.0)) else 0.0
