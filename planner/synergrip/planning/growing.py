"""Growing: the wanted motion is followed a little farther at a time, each time from the states that were reached.

Where the linear plan of the whole motion is no place to begin at, or where there is none, the first knot is planned
for, then as many knots as the hand comes by on a short piece of the way, and so on. A piece on which promise and truth
do not come near each other is halved; the next one is longer where they do so at once. What was reached last is a plan
of its own, whatever comes after it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from synergrip.equilibrium.states import States
from synergrip.linalg import Array, frozen, interpolated
from synergrip.log import LOG
from synergrip.planning.walk import Walker
from synergrip.planning.walk_so_far import Walk
from synergrip.values import Value

PIECE, LONGEST, SHORTEST = 5e-3, 2e-2, 2e-4
"""[m, rotations times the length of the grasp] of the way that is taken at first, at most and at least."""
KNOT = 1e-3
"""[m] of the way that a knot counts for beside the motion: the load changes there."""
QUICK = 2
"""Passes that a piece takes at most for the next one to be longer."""


@dataclass(frozen=True, eq=False, repr=False)
class Way(Value):
    """The wanted motion of a task by how far it is along it."""

    walker: Walker
    gone: Array
    """(T,) how far it is to each knot [m]."""

    @classmethod
    def of(cls, walker: Walker) -> Way:
        """Return the way of a walker."""
        scale = walker.start.response.scale
        pieces = np.linalg.norm(scale.twist(np.diff(walker.wanted, axis=0)), axis=1) + KNOT
        return cls(walker, frozen(np.concatenate([[0.0], np.cumsum(pieces)])))

    @property
    def end(self) -> float:
        """How far it is to the last knot [m]."""
        return float(self.gone[-1])

    def until(self, gone: float) -> Walker:
        """Return who walks it until there: to the knots up to the next one, which then is wanted nearer."""
        whole, walker = self.walker.wanted, self.walker
        count = int(np.searchsorted(self.gone, gone)) + 1
        aim = np.array(whole[:count])
        if count > 1:
            share = (gone - self.gone[count - 2]) / (self.gone[count - 1] - self.gone[count - 2])
            aim[-1] = (1 - share) * whole[count - 2] + share * whole[count - 1]
        return replace(walker, task=walker.task.first(count), aim=frozen(aim))


@dataclass(frozen=True, eq=False, repr=False)
class Grown(Value):
    """How far the way was followed."""

    walk: Walk
    gone: float
    """[m]"""
    before: float
    """[m] how far it was before the last piece."""


def grown(walker: Walker, hold: Array) -> Walk:
    """Return the walk that comes of it, of all knots, or of those that were reached.

    Args:
        walker: whose task it is.
        hold: (T, n_z) references that hold the object where it is, under the loads of the task.
    """
    way, met = Way.of(walker), None
    part = way.until(0.0)
    here = sure = Grown(part.on(part.executed(hold[:1], None, walker.executor.setting.start)), 0.0, 0.0)
    piece = PIECE if part.arrived(here.walk) else 0.0
    passes, tried, rough, stopped = here.walk.passes, here.walk.tried, True, here.walk.interrupted
    while here.gone < way.end and piece >= SHORTEST and not stopped:
        to = min(here.gone + piece, way.end)
        part = way.until(to)
        found = _on_to(to, part, here, way, hold, rough=rough)
        passes, tried = passes + found.passes, (*tried, *found.tried)
        if stopped := found.interrupted:
            break
        good = part.near(found) and (rough or part.arrived(found))
        LOG.info("%s to %.4g of %.4g m in %d passes", "grown" if good else "not grown", to, way.end, found.passes)
        if good:
            here, piece = Grown(found, to, here.gone), min((1 + (found.passes <= QUICK)) * piece, LONGEST)
            sure = here if part.arrived(found) else sure
            continue
        met, piece = found.hindered or met, piece / 2
        if here is not sure:  # what comes next may be out of reach only because promise and truth are not near enough
            part = way.until(here.gone)
            settled = part.on(here.walk)
            rough, stopped = part.arrived(settled), settled.interrupted
            here = sure = replace(here, walk=settled) if rough else sure
    if here.gone == way.end and not stopped:
        return walker.on(replace(here.walk, passes=passes, tried=tried))
    until = float(np.interp(sure.gone, way.gone, walker.task.times))
    hindered = met or sure.walk.hindered
    return replace(sure.walk, until=until, passes=passes, tried=tried, hindered=hindered, stopped=stopped)


def _on_to(to: float, part: Walker, here: Grown, way: Way, hold: Array, *, rough: bool) -> Walk:
    """Return the walk of a piece more; the one so far, in no pass more, when it is interrupted before the first."""
    try:
        found = part.on(_begun(part, here, to, way, hold), roughly=True)
        return found if rough or not part.near(found) else part.on(found)
    except KeyboardInterrupt:
        return replace(here.walk, passes=0, tried=(), stopped=True)


def _begun(part: Walker, here: Grown, to: float, way: Way, hold: Array) -> Walk:
    """Return a walk whose references go on as they did on the last piece, and with the load as those that hold."""
    walk, count = here.walk, len(part.task.times)
    known = len(walk.references)
    own = walk.references - hold[:known]
    places = np.append(way.gone[: known - 1], here.gone)
    before = interpolated(np.array([here.before]), places, own)[0]
    slope = (own[-1] - before) / max(here.gone - here.before, KNOT)
    beyond = np.minimum(way.gone[known - 1 : count], to) - here.gone
    references = hold[:count] + np.concatenate([own[:-1], own[-1] + np.outer(beyond, slope)])
    states, last = walk.executed.states, walk.executed.states.taken([-1])
    near = States.joined([states, *[last] * (count - known)])
    return part.executed(references, None, near)
