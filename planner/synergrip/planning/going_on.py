"""A no of the start posture about a later knot is none about the hand that moves: it may get there."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from synergrip.errors import Refusal
from synergrip.linalg import Array, Places, frozen
from synergrip.planning.beginning import walk_from_hold
from synergrip.planning.between import between
from synergrip.planning.executing import Executor
from synergrip.planning.formulated import formulated
from synergrip.planning.outcome import Infeasible, Outcome, Plan
from synergrip.planning.pace import WHOLE, Effort
from synergrip.planning.runaway import answered
from synergrip.planning.solvers import Answerer
from synergrip.planning.walk import Walker
from synergrip.planning.walked import answer_of
from synergrip.statics.analysis import Analysis
from synergrip.statics.motion import forward
from synergrip.tasks.profiles import Constant, Profiles
from synergrip.tasks.timed_task import TimedTask, still
from synergrip.tasks.tracking import target_displacement

ONCE = 'this is proven of the linear model of the start posture; task.linearise = "along" plans for the hand that moves'
"""What may help a motion that has no plan at the start posture."""

STAYS = "this is proven of the linear model of the start posture; along the motion no plan was found either: "
"""What is told with a no that stays, although passes along the motion have tried."""

Planned = Callable[[Analysis, TimedTask], Outcome]


def gone_on(no: Infeasible, planned: Planned, answers: Answerer, effort: Effort = WHOLE) -> Outcome:
    """Return what becomes of a task along the motion, of which the start posture says no.

    The no stands where no motion can help: what the first knot asks is infeasible, too, the very first step is refused,
    or there are more independent motions than synergies. Where the loads alone, without the motion, are infeasible at
    a later knot, it stands unless there is a plan along the motion.

    Args:
        no: on a hand.
        planned: what the start posture says of a task.
        answers: the solver.
        effort: how much is tried.
    """
    task, start = no.task, no.analysis
    if start is None or no.stage not in ("direction", "magnitude"):
        return no
    if task.linearise == "once":
        return replace(no, hints=(*no.hints, ONCE)) if len(task.times) > 1 else no
    if no.stage == "direction" and (not len(_moving(start, task)) or refused_at_once(start, task)):
        return no
    held = _held(start, task, no, planned)
    if held is None:
        return no
    hold, references = held
    walker = Walker(task, start, Executor.of(start, task), answers, effort=effort)
    whole = formulated(start, _without_motion(task), redundancy=task.watches_references)
    promised = forward(start.response, task.times, references, task.wrench)
    begun = replace(whole, target=walker.wanted, intersample=None)
    begin = replace(hold, task=task, formulation=whole, between=between(task, start, begun, promised))
    answer = answered(walker, lambda walker: walk_from_hold(walker, references), partial(answer_of, linear=begin))
    told = f"the linear model of the start posture alone says no: {no.why}"
    if isinstance(answer, Plan):
        return replace(answer, notes=(*answer.notes, told))
    if len(hold.time) < len(task.times):
        return replace(no, hints=(*no.hints, f"{STAYS}{answer.why}"))
    return replace(answer, why=f"{answer.why}; {told}")


def _held(start: Analysis, task: TimedTask, no: Infeasible, planned: Planned) -> tuple[Plan, Array] | None:
    """Return a plan of the start posture without the motion, and its references (T, n_z) at all knots.

    It is one of the first knot, which goes on as it is, where there is none of all knots; None where there is neither.
    """
    hold = planned(start, _without_motion(task)) if len(_moving(start, task)) else no
    if isinstance(hold, Plan):
        return hold, hold.dz_r
    if len(task.times) == 1:
        return None
    first = planned(start, replace(_without_motion(task).first(1), course=None))
    return (first, frozen(np.repeat(first.dz_r, len(task.times), axis=0))) if isinstance(first, Plan) else None


def refused_at_once(start: Analysis, task: TimedTask) -> bool:
    """Return whether the very first step of a motion leaves what the rigid motions of the start posture can follow."""
    begun = task.first(int(_moving(start, task)[0]) + 1)
    try:
        formulated(start, replace(begun, course=None, tolerance=0.0), redundancy=True)
    except Refusal:
        return True
    return False


def _moving(start: Analysis, task: TimedTask) -> Places:
    """Return the knots at which the object is wanted elsewhere than at the start."""
    return np.flatnonzero(np.any(target_displacement(start, task, task.target.values) != 0, axis=1))


def _without_motion(task: TimedTask) -> TimedTask:
    """Return the task with its loads, the object where it is."""
    course = task.course
    loads = replace(course, target=Constant(np.zeros(0))) if isinstance(course, Profiles) else None
    return replace(task, target=still(task.times), course=loads)
