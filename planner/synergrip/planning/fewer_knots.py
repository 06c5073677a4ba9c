"""The first passes at some of the knots: they lead most of the way at a part of the cost.

What is found there is taken to all knots by a cubic between each two, and passes over all of them go on from it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from synergrip.linalg import Array, Places, frozen
from synergrip.planning.pace import FirstPasses
from synergrip.planning.walk import Walker
from synergrip.planning.walk_so_far import Walk
from synergrip.vectors import off_chord

FEWEST, PER_KNOT = 10, 1 / 40
"""Into how many pieces the knots are split at least, and into how many more for each of them."""
WORTH = 1 / 2
"""Share of the knots that the first passes may take at most: with more of them they are not worth it."""
FEW_ANYWAY = 60
"""Knots up to which a brief walk, which takes a pass or two, takes them over all of them."""


@dataclass(frozen=True, eq=False)
class FewerKnots:
    """A task at some of its knots."""

    whole: Walker
    knots: Places
    """Those of the first passes: evenly spread, and those beside corners of load and wish."""
    corners: Places
    """Places among them of the latter, ends included."""

    @classmethod
    def of(cls, walker: Walker) -> FewerKnots | None:
        """Return who walks first; None where too few knots could be left out."""
        count = len(walker.task.times)
        if walker.effort.brief and count <= FEW_ANYWAY:
            return None
        pieces = FEWEST + int(PER_KNOT * count)
        corners = _corners(walker)
        evenly = np.round(np.linspace(0, count - 1, pieces + 1)).astype(np.intp)
        knots = np.unique(np.concatenate([evenly, corners]))
        if len(knots) > WORTH * count or walker.more is not None or walker.scenarios is not None:
            return None
        return cls(walker, knots, np.flatnonzero(np.isin(knots, corners)))

    @cached_property
    def walker(self) -> Walker:
        """Who walks at these knots, without a look between them, and in one step from each to the next."""
        task = replace(self.whole.task.at(self.knots), between="report")
        executor = replace(self.whole.executor, finely=False)
        return replace(self.whole, task=task, executor=executor, aim=frozen(self.whole.wanted[self.knots]), leads=True)

    def at_all_knots(self, found: Walk, smooth: Array) -> Walk | None:
        """Return a walk at all knots, of which none has been asked for yet; None where some are not reached.

        Args:
            found: the walk at some of the knots.
            smooth: (T, n_z) references at all knots that it differs from by what is a cubic between two of them.
        """
        times, known = self.whole.task.times, self.whole.task.times[self.knots]
        change, result = found.references - smooth[self.knots], np.array(smooth)
        for first, last in zip(self.corners[:-1], self.corners[1:], strict=True):
            here, there = slice(first, last + 1), slice(self.knots[first], self.knots[last] + 1)
            result[there] = smooth[there] + _cubics(known[here], change[here], times[there])
        near = found.executed.interpolated(times, self.whole.task.wrench)
        walk = self.whole.executed(result, None, near, fewer=True)
        if walk.way is None:
            return None
        return replace(walk, gap=found.gap, pace=found.pace, stopped=found.stopped, left_out=True)

    def told(self, walk: Walk, found: Walk) -> Walk:
        """Return a walk at all knots, which tells of the passes at some of them before it."""
        return replace(walk, first=FirstPasses(found.passes, len(self.knots)), tried=(*found.tried, *walk.tried))


def _corners(walker: Walker) -> Places:
    """Return the ends and the knots at or beside corners of load and wish."""
    times, course = walker.task.times, walker.task.course
    marks = np.zeros(0) if course is None else course.marks.corners
    after = np.clip(np.searchsorted(times, marks), 0, len(times) - 1)
    before = np.where(times[after] > marks, np.maximum(after - 1, 0), after)
    return np.unique(np.concatenate([[0, len(times) - 1], after, before])).astype(np.intp)


def _cubics(known: Array, values: Array, times: Array) -> Array:
    """Return Hermite's cubics (T, m) through values (K, m), with the slopes of parabolas through three of them."""
    slopes = np.gradient(values, known, axis=0, edge_order=2 if len(known) > 2 else 1)
    k = np.clip(np.searchsorted(known, times, side="right") - 1, 0, len(known) - 2)
    step = (known[k + 1] - known[k])[:, None]
    share, chord = (times - known[k])[:, None] / step, values[k + 1] - values[k]
    return values[k] + share * chord + off_chord(share, chord, step * slopes[k], step * slopes[k + 1])
