"""What the contacts leave free is planned around where the task neither loads it nor asks for it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from synergrip.conic.intersample import Looks
from synergrip.conic.limits.object_error import AXES
from synergrip.linalg import RANK_TOLERANCE, Array
from synergrip.planning.instants import intersample_of
from synergrip.statics.analysis import Analysis
from synergrip.statics.restraint import not_restrained, refuse_load, told_as_free
from synergrip.statics.twists import describe_displacement
from synergrip.tasks.timed_task import TimedTask
from synergrip.tasks.tracking import RIGID_TOLERANCE, target_displacement


def refuse_use_of_free(analysis: Analysis, task: TimedTask) -> None:
    """Refuse a task that works on a motion that no contact resists, or asks for it, at any instant of it.

    Raises:
        NotRestrainedError: says which load, or which part of the wanted motion, at which time.
    """
    response = analysis.response
    if response.restrained:
        return
    looks = _instants(analysis, task)
    when = ("at the start, where it is w_0, ", *(f"at t = {time:.3g} s " for time in looks.times))
    load = np.concatenate([analysis.grasp.w_0[None], looks.wrench])
    refuse_load(analysis.grasp, response.scale, response.free, load, when)
    if len(task.axes) == len(AXES):  # on some of the axes the direction decides: what they see may be had otherwise
        _refuse_motion(analysis, looks)


def needs_free(analysis: Analysis, task: TimedTask, twists: Array) -> bool:
    """Return whether a task works on one of some twists (6, k) about B, or wants it; for the proof of a refusal."""
    looks, scale = _instants(analysis, task), analysis.response.scale
    load = np.concatenate([analysis.grasp.w_0[None], looks.wrench])
    work, along = load @ twists, looks.target @ (scale.motion.T @ scale.motion) @ twists
    pairs = ((work, scale.wrench(load), RANK_TOLERANCE), (along, scale.twist(looks.target), RIGID_TOLERANCE))
    return any(bool(_largest(part) > share * _largest(whole)) for part, whole, share in pairs)


def _largest(rows: Array) -> float:
    return float(np.linalg.norm(rows, axis=1).max())


def free_notes(analysis: Analysis) -> Iterator[str]:
    """Yield what the object may do that no contact resists, and what that leaves open in a plan."""
    if not (said := _said(analysis)):
        return
    yield (
        f"{said}; no load works against it and no motion asks for it. Where it goes on that way nothing "
        "determines: it is taken to stay, and any disturbance moves it"
    )
    if analysis.grasp.held is not None:
        yield (
            "the plan was not executed on the hand that moves: the true equilibrium of an object that is free to move "
            "is none, its stiffness there is 0; the figures are those of the linear model at the start posture"
        )


def free_dimensions(analysis: Analysis) -> Iterator[str]:
    """Yield what the dimensions of an analysis are those of, where the object is free to move."""
    if said := _said(analysis):
        yield (
            f"{said}; no contact resists it. Forces are those on the range of G, and motions and dimensions those at "
            "right angles to it: a task that neither loads it nor asks for it is planned with these"
        )


def _said(analysis: Analysis) -> str:
    return told_as_free(analysis.grasp, analysis.response.scale, analysis.response.free_twists)


def _instants(analysis: Analysis, task: TimedTask) -> Looks:
    """Return load and wish at the knots and, where they bend or jump in between, there."""
    intersample = intersample_of(task, analysis)
    knots = Looks(task.times, task.wrench, target_displacement(analysis, task, task.target.values))
    return knots if intersample is None else knots.and_then(intersample.all)


def _refuse_motion(analysis: Analysis, looks: Looks) -> None:
    """Refuse a wish with a part along what is free, beyond the rounding of its data."""
    response, scale = analysis.response, analysis.response.scale
    wish = scale.twist(looks.target)
    parts = wish @ response.free
    k = int(np.argmax(np.linalg.norm(parts, axis=1)))
    if np.linalg.norm(parts[k]) <= RIGID_TOLERANCE * _largest(wish):
        return
    along = np.linalg.solve(scale.motion, response.free @ parts[k])
    part, whole = (describe_displacement(twist, scale.length) for twist in (along, looks.target[k]))
    what = f"at t = {looks.times[k]:.3g} s the wanted motion, {whole} about B, has {part} along what is free"
    raise not_restrained(analysis.grasp, scale, response.free, what, np.zeros(6))
