"""What a margin costs: the least peak normal force for each slip margin, up to the largest there is."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.goals.least_peak import LeastPeak
from synergrip.grasps.grasp import Grasp
from synergrip.planning.outcome import Outcome, Plan
from synergrip.planning.planning import plan, plan_of_start_posture
from synergrip.planning.solvers import SOLVERS, Answerer
from synergrip.tasks.timed_task import TimedTask

GOALS = LeastPeak(), LeastEffort()
"""Of every point of a front; the goals of its task play no part."""


@dataclass(frozen=True)
class FrontPoint:
    """One trade between the two: no plan has more of the margin with less of the peak.

    Where limits are held between the knots under curved loads: no plan that keeps the reserve for these.
    """

    margin: float  # [N]
    peak: float  # [N] largest normal force
    plan: Plan


def largest(grasp: Grasp, task: TimedTask, solver: Answerer = SOLVERS["clarabel"]) -> Outcome:
    """Return the plan with the largest margin that the limits of a task allow, or why there is none.

    Raises:
        InputError: nothing bounds the largest margin.
    """
    return plan(grasp, replace(task, goals=(LargestMargin(), LeastEffort())), solver)


def front(best: Plan, count: int, solver: Answerer = SOLVERS["clarabel"]) -> Iterator[FrontPoint]:
    """Yield `count` points of the Pareto front of slip margin and peak normal force, by growing margin.

    The margins are evenly spaced from the one the task asks for to just below the largest, where a plan is left to
    find. A point that cannot be verified is left out. The goals of the task play no part.

    Args:
        best: the plan with the largest margin, from `largest`.
        count: at least 2.
        solver: who answers.

    Raises:
        KeyboardInterrupt: somebody interrupted; the points before are whole.
    """
    grasp, task, most = best.analysis.grasp, best.task, best.largest_margin or 0.0
    if best.executed is not None:  # every point begins with a plan of the start posture
        begun = plan_of_start_posture(best.analysis, task, solver)
        most = min(most, begun.largest_margin or 0.0) if isinstance(begun, Plan) else most
        if best.between is not None and task.between != "report":  # where it is to be kept, too
            most = min(most, float(best.between.usages[0].value.min()))
    top = most - ROOM * max(most, best.formulation.force_unit)
    for margin in np.linspace(min(task.margin, top), top, count):
        point = plan(grasp, replace(task, margin=float(margin), goals=GOALS), solver)
        if isinstance(point, Plan) and point.interrupted:  # half of its goals make no point
            raise KeyboardInterrupt
        if isinstance(point, Plan):
            yield FrontPoint(float(margin), float(point.motion.forces[:, grasp.normal_rows].max()), point)


ROOM = 1e-6
"""How far below the largest margin the last point stays, relative to it or to the force unit."""
