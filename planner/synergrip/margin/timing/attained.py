"""A timing attained: by a plan of the hand that moves, which may need more time than the linear model says.

The timing found is slowed down by one factor until there is a plan. Where that takes much, the timing that was asked
for is looked at, too, with one factor on its times: the hand may follow that one faster.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from synergrip.grasps.grasp import Grasp
from synergrip.grasps.scale import scale_of
from synergrip.linalg import Array, frozen
from synergrip.margin.timing.as_poses import as_poses
from synergrip.margin.timing.by_length import Leg, passed_as_given
from synergrip.margin.timing.fastest_program import Timing
from synergrip.planning.outcome import Plan
from synergrip.planning.pace import Effort
from synergrip.planning.planning import plan_of_start_posture, planned_along
from synergrip.planning.solvers import SOLVERS
from synergrip.tasks.palm_motion import Palm, PalmMotion
from synergrip.tasks.palm_path import PalmPath, as_rows
from synergrip.tasks.task import Task
from synergrip.values import Value

SLOWER = (1.001, 1.01, 1.03, 1.1, 1.3, 2.0)
"""Factors of the time of the linear model that are tried until there is a plan of the hand that moves; the first one is
room for the poses, which are the timing but for the corners of its speed."""
DRAWN = 200
"""Parts of the time at which the timing that was asked for is told beside."""
LINES = (60, 120, 240)
"""How many poses the path is told by: more where the linear model has no plan between those."""
MUCH = 1.05
"""Factor from which on the fastest timing of the linear model says little about the hand that moves."""
HALVES, HALVES_AS_ASKED = 2, 4
"""How often what lies between a factor with a plan and one without is halved."""
TRIED = Effort(16, rounds=False)
"""Passes of a timing that is tried: where they do not do, a slower one is looked for, and no motion is grown."""
WORTH = 0.98
"""Share of the time found that the timing that was asked for must stay below to be worth a look."""


@dataclass(frozen=True, eq=False, repr=False)
class Attained(Value):
    """A timing that a plan attains."""

    path: PalmPath
    share: Array  # (K,) of the way that is passed at its instants
    plan: Plan
    as_asked: bool = False
    """Whether it is the timing that was asked for, with one factor on its times."""

    @property
    def seconds(self) -> float:
        """How long it takes [s]."""
        return float(np.asarray(self.path.times)[-1])


def attained(
    grasp: Grasp, task: Task, palm: Palm | PalmPath, path: tuple[Leg, ...], found: Timing, given: Array
) -> Attained | None:
    """Return what plans of the hand that moves attain of a timing of the linear model; None where there is none.

    Args:
        grasp: whose hand it is.
        task: whose load `palm` is.
        palm: with the timing that was asked for.
        path: of the palm, by its length.
        found: the fastest timing of the linear model of the start posture.
        given: (K,) the share of the way that is passed after equal parts of the time that was asked for.
    """
    posed, share = _posed(grasp, task, palm, path, found)

    def planned(factor: float) -> Attained | None:
        return _planned(grasp, task, palm, posed.stretched(factor), share)

    best, good, bad = None, SLOWER[-1], 0.0
    for factor in SLOWER:
        best, good = planned(factor), factor
        if best is not None:
            break
        bad = factor
    if best is not None and bad:
        best, good = _nearer(planned, best, good, bad, HALVES)
    if best is not None and good <= MUCH:
        return best
    return _as_asked(grasp, task, palm, found.seconds, None if best is None else best.seconds, given) or best


def given_share(grasp: Grasp, task: Task, palm: Palm | PalmPath) -> Array:
    """Return (DRAWN + 1,) the share of the way that is passed after equal parts of the time that the task takes."""
    start, end = task.timed(grasp).times[[0, -1]].tolist()
    return passed_as_given(palm, start, end, scale_of(grasp).length, DRAWN)


def _nearer(
    planned: Callable[[float], Attained | None], best: Attained, good: float, bad: float, times: int
) -> tuple[Attained, float]:
    """Return the plan of a factor nearer to one without a plan, halved a few times, and that factor."""
    for _ in range(times):
        middle = (good + bad) / 2
        nearer = planned(middle)
        best, good, bad = (best, good, middle) if nearer is None else (nearer, middle, bad)
    return best, good


def _as_asked(
    grasp: Grasp, task: Task, palm: Palm | PalmPath, least: float, most: float | None, given: Array
) -> Attained | None:
    """Return the fastest plan of the timing that was asked for, with one factor on its times; None where that is none.

    Args:
        grasp: whose hand it is.
        task: whose load `palm` is.
        palm: with that timing.
        least: what the linear model takes [s].
        most: what is to be bettered [s]; None where there is nothing yet.
        given: (K,) as of `attained`.
    """
    start, end = task.timed(grasp).times[[0, -1]].tolist()
    path = _sampled(palm, start, end)
    share = frozen(np.interp(np.asarray(path.times), np.linspace(0.0, end - start, len(given)), given))

    def planned(factor: float) -> Attained | None:
        return _planned(grasp, task, palm, path.stretched(factor), share)

    bad, good = least / (end - start), 1.0 if most is None else min(1.0, WORTH * most / (end - start))
    if good <= bad or (best := planned(good)) is None:
        return None
    return replace(_nearer(planned, best, good, bad, HALVES_AS_ASKED)[0], as_asked=True)


def _sampled(palm: Palm | PalmPath, start: float, end: float) -> PalmPath:
    """Return the way of a palm in a task from `start` to `end` [s], at the timing that was asked for, from 0 on."""
    motion = palm.motion(start, end)
    own = np.zeros(0) if isinstance(motion, PalmMotion) else np.asarray(motion.corners)
    evenly = np.linspace(start, end, LINES[0] + 1)
    times = own if len(own) >= LINES[0] else evenly
    if isinstance(motion, PalmMotion):
        passed = motion.profile.at(times)[:, None]
        poses = passed * np.concatenate([motion.shift, motion.turn * motion.axis])
    else:
        poses = as_rows(np.asarray(motion.poses(times)))
    return PalmPath(times - start, poses, inertia=True)


def _posed(
    grasp: Grasp, task: Task, palm: Palm | PalmPath, path: tuple[Leg, ...], found: Timing
) -> tuple[PalmPath, Array]:
    """Return the timing as poses, as few as will do for the linear model, and the share of the way at each of them."""
    for lines in LINES:
        posed, passed = as_poses(path, found.b, lines)
        if isinstance(plan_of_start_posture(grasp, _along(task, palm, posed.stretched(SLOWER[0]))), Plan):
            break
    return posed, frozen(passed / passed[-1])


def _planned(grasp: Grasp, task: Task, palm: Palm | PalmPath, path: PalmPath, share: Array) -> Attained | None:
    """Return the plan along the hand that moves, if there is one; not where the start posture has none already."""
    begun = plan_of_start_posture(grasp, _along(task, palm, path))
    if not isinstance(begun, Plan):
        return None
    outcome = planned_along(begun, SOLVERS["clarabel"], TRIED)
    if isinstance(outcome, Plan) and outcome.interrupted:
        raise KeyboardInterrupt
    return Attained(path, share, outcome) if isinstance(outcome, Plan) else None


def _along(task: Task, palm: Palm | PalmPath, path: PalmPath) -> Task:
    """Return the task with another path in place of the palm's own motion, at its lines."""
    loads = tuple(path if load is palm else load for load in task.loads)
    return task.replace(loads=loads, duration=None, knots=None)
