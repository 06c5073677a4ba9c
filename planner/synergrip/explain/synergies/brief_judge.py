"""Whether a task has a plan in the linear model of the start posture: one program, and no more than its verdict."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from synergrip.changes.asked import Asked
from synergrip.changes.at_a_value import solved
from synergrip.grasps.grasp import Grasp
from synergrip.planning.outcome import Outcome
from synergrip.planning.planning import plan_of_start_posture
from synergrip.tasks.timed_task import TimedTask

FEW = 5
"""Knots that are asked first: what has no plan at these has none at all."""


@dataclass(frozen=True)
class Verdict:
    """What is said of a task without its plan."""

    verdict: str
    stage: str = ""
    why: str = ""


def briefly(grasp: Grasp, task: TimedTask) -> Verdict | Outcome:
    """Return the verdict of one program; of planning where it is refused before there is one, or proves nothing."""
    for asked in (_thinned(task), task):
        posed = Asked(grasp, asked).posed()
        decision = None if posed is None else solved("any plan", posed.program())
        if decision is not None and decision.infeasible and posed is not None and posed.strict:
            return Verdict("infeasible", "magnitude", "nothing that the synergies control keeps all limits at once")
    if decision is not None and decision.acceptable:
        return Verdict("feasible")
    return plan_of_start_posture(grasp, task)


def _thinned(task: TimedTask) -> TimedTask:
    """Return the task at a few of its knots, each by itself: it asks for less."""
    few = np.unique(np.linspace(0, len(task.times) - 1, FEW).astype(int))
    limits = tuple(limit for limit in task.limits if not limit.couples_knots)
    return replace(task.at(few), course=None, between="report", limits=limits)
