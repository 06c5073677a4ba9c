"""Why a task is refused before any program: the object is not held, or its motion is none of the hand's."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from synergrip.conic.limits.dial import Dial
from synergrip.errors import MotionDirectionError
from synergrip.explain.asked import Asked
from synergrip.explain.explanation import STAGES, Explanation
from synergrip.explain.repairs import ROOM, Repair, outcome_of, rounded
from synergrip.explain.synergies.missing_synergies import MissingSynergies, missing_synergies
from synergrip.explain.when import When
from synergrip.linalg import Array
from synergrip.planning.outcome import Infeasible, Plan, Unknown
from synergrip.planning.planning import plan_of_start_posture
from synergrip.tasks.control import ControlError
from synergrip.tasks.tracking import target_displacement

FEW = 3
"""Candidates for missing synergies of the short form."""


def refused(no: Infeasible | Unknown, asked: Asked, *, short: bool) -> Explanation:
    """Return why a task is refused, with the tolerance that would do where there is one.

    Args:
        no: the refusal.
        asked: what was asked.
        short: whether a short form is enough.
    """
    cause = STAGES.get(no.stage, "limit")
    outside = _outside(no)
    late = outside > no.task.tolerance if outside is not None else np.zeros(len(no.task.times), dtype=bool)
    times = no.task.times
    edges = np.flatnonzero(np.diff(np.concatenate([[False], late, [False]]).astype(int)))
    stretches = tuple((float(times[a]), float(times[b - 1])) for a, b in zip(edges[::2], edges[1::2], strict=True))
    first = stretches[0][0] if stretches else (float(times[0]) if cause == "restraint" else None)
    known = Explanation(cause, no.why, (), (), (), When(first, stretches, alone=True), not short)
    try:
        if outside is not None:
            known = replace(known, repairs=tuple(_by_tolerance(no, asked, float(outside.max()))))
        return replace(known, missing_synergies=_missing(no, short=short))
    except KeyboardInterrupt:  # what plan said is known all the same
        return replace(known, interrupted=True)


def _missing(no: Infeasible | Unknown, *, short: bool) -> MissingSynergies | None:
    """Return which synergies are missing for a motion."""
    if not isinstance(no, Infeasible) or no.stage == "restraint" or _of_control(no):
        return None
    return missing_synergies(no, most=FEW, judge=plan_of_start_posture) if short else missing_synergies(no)


def _of_control(no: Infeasible | Unknown) -> bool:
    """Return whether it is `task.control` that is refused, which no tolerance helps."""
    return isinstance(no, Infeasible) and isinstance(no.refusal, ControlError)


def _outside(no: Infeasible | Unknown) -> Array | None:
    """Return how far (T,) the wish is outside the rigid motions of the hand [m]; None when it cannot be told."""
    if no.analysis is None or no.stage not in ("direction", "count") or _of_control(no):
        return None
    scale = no.analysis.response.scale
    wish = scale.twist(target_displacement(no.analysis, no.task, no.task.target.values))
    reach, _ = np.linalg.qr(scale.motion @ no.analysis.spaces.Gamma_ucs)
    return np.asarray(np.linalg.norm(wish - wish @ reach @ reach.T, axis=1))


def _by_tolerance(no: Infeasible | Unknown, asked: Asked, outside: float) -> list[Repair]:
    """Return the tolerance within which the nearest motion of the hand lies, where there is a plan with it."""
    refusal = no.refusal if isinstance(no, Infeasible) else None
    least = max(outside, refusal.size if isinstance(refusal, MotionDirectionError) else 0.0)
    size = float(np.abs(no.task.target.values).max(initial=0.0)) or 1.0
    dial: Dial[Asked] = Dial(
        "tolerance", "task.tolerance", no.task.tolerance, "m", lambda v: asked.with_task(tolerance=v), scale=size
    )
    value = rounded(least * (1 + ROOM), up=True)
    outcome = outcome_of(dial.turned(value))
    if not isinstance(outcome, Plan):
        return []
    return [
        Repair("tolerance", dial.key, dial.value, value, "m", dial.set(value), True, dial.size(value), True, outcome)
    ]
