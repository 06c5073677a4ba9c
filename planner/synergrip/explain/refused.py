"""Why a task is refused before any program: the object is not held, or its motion is none of the hand's."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from synergrip.changes.asked import Asked
from synergrip.changes.at_a_value import first_plan, with_room
from synergrip.changes.turning import tolerance_dial
from synergrip.conic.limits.dial import Cause, Dial
from synergrip.conic.limits.object_error import AXES
from synergrip.errors import MotionDirectionError
from synergrip.explain.explanation import STAGES, Explanation
from synergrip.explain.repairs import Repair
from synergrip.explain.synergies.missing_synergies import (
    MissingSynergies,
    another_set,
    missing_briefly,
    missing_synergies,
)
from synergrip.explain.when import NOT_KNOWN, When
from synergrip.planning.outcome import Infeasible, Unknown
from synergrip.planning.pace import SHORT, WHOLE, Effort
from synergrip.statics.analysis import Analysis
from synergrip.tasks.control import ControlError, most_controlled, written
from synergrip.tasks.tracking import RIGID_TOLERANCE, out_of_reach, target_displacement, wish_size

FEW = 2
"""Candidates for missing synergies of the short form."""
BRIEFLY = replace(SHORT, passes=2)
"""How much its tolerance is tried for: a refusal itself takes no program, so that each pass is many times as long."""


def refused(no: Infeasible | Unknown, asked: Asked, *, short: bool) -> Explanation:
    """Return why a task is refused, with the tolerance that would do where there is one.

    Args:
        no: the refusal.
        asked: what was asked.
        short: whether a short form is enough.
    """
    cause = STAGES.get(no.stage, "limit")
    known = Explanation(cause, no.why, (), (), (), NOT_KNOWN, not short)
    try:
        if no.analysis is not None and no.stage in ("direction", "count") and not _of_control(no):
            known = _out_of_reach(known, no, no.analysis, asked, BRIEFLY if short else WHOLE)
        if no.analysis is not None and _of_control(no):
            known = replace(known, repairs=tuple(_less_control(no.analysis, asked, cause)))
        return replace(known, missing_synergies=_missing(no, short=short))
    except KeyboardInterrupt:  # what plan said is known all the same
        return replace(known, interrupted=True)


def _missing(no: Infeasible | Unknown, *, short: bool) -> MissingSynergies | None:
    """Return which synergies are missing for a motion."""
    if not isinstance(no, Infeasible) or no.stage == "restraint":
        return None
    if _of_control(no):
        return None if short else another_set(no)
    return missing_briefly(no, FEW) if short else missing_synergies(no)


def _of_control(no: Infeasible | Unknown) -> bool:
    """Return whether it is `task.control` that is refused, which no tolerance helps."""
    return isinstance(no, Infeasible) and isinstance(no.refusal, ControlError)


def _less_control(analysis: Analysis, asked: Asked, cause: Cause) -> Iterator[Repair]:
    """Yield the most of what is asked for that the synergies do control, where there is a plan with it."""
    control = asked.task.control
    assert control is not None
    less = most_controlled(analysis, control)
    dial: Dial[Asked] = Dial(
        cause, "task.control", control.asked, "", lambda v: asked.with_task(control=less), "down", 0.0,
        written=lambda v: written(less),
    )  # fmt: skip
    found = first_plan(dial, [float(less.asked)])
    if found is not None:
        yield Repair.of(dial, *found)


def _out_of_reach(
    known: Explanation, no: Infeasible | Unknown, analysis: Analysis, asked: Asked, effort: Effort
) -> Explanation:
    """Return also when the wish is outside the rigid motions of the hand, and the tolerance within which it is not."""
    task, size = no.task, wish_size(analysis, no.task)
    refusal = no.refusal if isinstance(no, Infeasible) else None
    least, whole = refusal.size if isinstance(refusal, MotionDirectionError) else 0.0, len(task.axes) == len(AXES)
    if whole:  # on some of the axes what they see may be had by a motion that is wanted nowhere
        outside = out_of_reach(analysis, target_displacement(analysis, task, task.target.values))
        late = outside > max(task.tolerance, RIGID_TOLERANCE * size)
        known, least = replace(known, when=When.of(task.times, late)), max(least, float(outside.max()))
    dial = tolerance_dial(asked, task, analysis)
    found = first_plan(dial, [dial.rounded(with_room(dial, least))], effort)
    return replace(known, repairs=() if found is None else (Repair.of(dial, *found, proven=whole),))
