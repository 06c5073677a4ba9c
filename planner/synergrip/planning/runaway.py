"""Where a task leaves axes free a goal may run away with the motion along them: what else is tried then.

A free rigid motion changes forces by little, and next to nothing of a goal is worth as far a step as there is to a
program: pass after pass the object turns farther, until no limit is kept any more, or no equilibrium is near. So the
passes are taken again with the free motion as it is where they begin; and, where that does not do, those of the least
motion of the references, which keeps it small. A goal then says which plan there is, and not whether there is one.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from synergrip.conic.goals.least_motion import LeastMotion
from synergrip.planning.outcome import Plan, Unknown
from synergrip.planning.walk import Walker
from synergrip.planning.walk_so_far import Walk
from synergrip.tasks.tracking import followed_axes

TAME = LeastMotion()
"""The goal that keeps free motions small."""
STILL = (
    "passes whose goals choose the motion that task.axes leaves free came to no plan; in this one they do not choose "
    "it, and by them another plan may be better"
)

Begin = Callable[[Walker], Walk]
"""Returns the walk that the passes of a walker end with."""
Judge = Callable[[Walk, Walker], Plan | Unknown]
"""Returns the answer that a walk comes to."""


def answered(walker: Walker, begin: Begin, judge: Judge) -> Plan | Unknown:
    """Return the answer that passes come to; where none is a plan, that of those by the goals that got farthest.

    Args:
        walker: who walks.
        begin: how a walk comes about.
        judge: what becomes of it.
    """
    answers = [judge(begin(walker), walker)]
    if isinstance(answers[0], Plan) or not walker.effort.rounds or not runs_free(walker):
        return answers[0]
    for answer in _others(walker, begin, judge):
        if isinstance(answer, Plan):
            return answer
        answers.append(answer)
    return max(answers, key=_got)


def runs_free(walker: Walker) -> bool:
    """Return whether the axes that a task follows leave rigid motions of the hand to its goals."""
    task = walker.task
    return task.tracking != "compliant" and bool(followed_axes(walker.start, task)[1].shape[1])


def _others(walker: Walker, begin: Begin, judge: Judge) -> Iterator[Plan | Unknown]:
    """Yield the answers of the passes that are taken instead, each once it is asked for."""
    still = replace(walker, effort=replace(walker.effort, still=True))
    yield _noted(judge(begin(still), still), STILL)
    if walker.task.goals[0] == TAME:
        return
    tame = replace(walker, task=replace(walker.task, goals=(TAME,)))
    walk = begin(tame)
    answer = judge(walk, tame)
    if not isinstance(answer, Plan):
        return
    if not answer.interrupted:
        yield _noted(judge(still.on(replace(walk, gap=np.inf, stage=None)), still), STILL)
    asked = walker.task.goals[0].name
    told = f"'{asked}' came to no plan along the motion, nor any goal after it; this is the plan of {TAME.name}"
    yield _noted(replace(answer, largest_margin=None), told)


def _noted(answer: Plan | Unknown, note: str) -> Plan | Unknown:
    return replace(answer, notes=(note, *answer.notes)) if isinstance(answer, Plan) else answer


def _got(answer: Plan | Unknown) -> float:
    """Return until when an answer got [s]; infinitely where all knots were reached and something else is missed."""
    reached = answer.reached if isinstance(answer, Unknown) else None
    return np.inf if reached is None else reached.until_s
