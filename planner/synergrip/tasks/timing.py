"""A task made into its values at knots, for one grasp."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from synergrip.errors import InputError, Issue, kind_of, raise_issues
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.objects import Object
from synergrip.linalg import Array, frozen
from synergrip.tasks.corners import allowed_on
from synergrip.tasks.gravity import Weight
from synergrip.tasks.inertia import Inertia
from synergrip.tasks.knots import USUAL, knots, span
from synergrip.tasks.palm_in_world import PalmInWorld
from synergrip.tasks.palm_motion import Palm
from synergrip.tasks.palm_path import PalmPath
from synergrip.tasks.profiles import Constant, Profile, Profiles
from synergrip.tasks.stated import Setting, Stated
from synergrip.tasks.timed_task import Target, TimedTask, on_grasp

if TYPE_CHECKING:
    from synergrip.tasks.task import Task


def timed(task: Task, grasp: Grasp) -> TimedTask:
    """Return a task at its knots, on a grasp.

    Where nothing is said of the load it is w_0 of the grasp, throughout.

    Args:
        task: what is asked.
        grasp: of whom.

    Raises:
        InputError: no grasp; loads or target that do not fit into the time of the task, or that need to know more of
            the object; each with its argument, such as ``Task.loads[1].end``.
    """
    if not isinstance(grasp, Grasp):
        raise InputError.at("grasp", f"expected a Grasp, got {kind_of(grasp)}")
    times, profiles = happening(task, None if grasp.held is None else grasp.held.body)
    wrench = profiles.load_at(times)
    if wrench is None:
        wrench = frozen(np.tile(task.load_factor * grasp.w_0, (len(times), 1)))
    limits, goals = on_grasp(task.limits, task.goals, grasp)
    return TimedTask.of_task(
        times, wrench, Target(task.target.kind, profiles.target_at(times), "Task.target"), limits, goals,
        tolerance=task.tolerance,
        tracking=task.tracking, axes=task.axes, drift=task.drift, course=profiles, between=task.between,
        linearise=task.linearise, control=task.control, allowed=allowed_on(task, grasp, _weight(profiles)),
        tie_break=task.tie_break,
    )  # fmt: skip


def _weight(profiles: Profiles) -> tuple[Profile, ...]:
    """Return what goes by the mass of the object: its weight, and its inertia in a palm that moves."""
    return tuple(part for part in profiles.load if isinstance(part, Weight | Inertia))


def happening(task: Task, body: Object | None) -> tuple[Array, Profiles]:
    """Return the knots (T,) [s] of a task, and what happens at any time of it.

    Args:
        task: what is asked.
        body: the object where it is; None when it is not known.

    Raises:
        InputError: see `timed`.
    """
    task = stretched(task)
    parts = task.parts
    start, end = span(parts, task.duration, task.knots)
    setting = Setting(start, end, body, _palm(task, start, end))
    over = _over(parts, setting)
    times = knots(parts, task.knots, setting)
    target = over.pop("target", None) or Constant(np.zeros(0))
    return frozen(times), Profiles(tuple(over.values()), target, task.load_factor, task.motion_factor)


def stretched(task: Task) -> Task:
    """Return a task whose `time_factor` is in its times.

    Raises:
        InputError: a load has times of its own, or what comes of the factor is no task; with its argument.
    """
    factor = task.time_factor
    if factor == 1:
        return task
    found, issues = dict[str, Stated](), list[Issue]()
    for key, part in task.parts.items():
        try:
            found[key] = part.stretched(factor)
        except InputError as error:
            own = error if not any(issue.key for issue in error.issues) else error.under(type(part).__name__)
            issues += own.located(lambda issue, key=key: replace(issue, key=f"Task.{key}")).issues  # type: ignore[misc]
    raise_issues(issues)
    tells = task.duration is None and any(part.last is not None for part in found.values())
    duration = None if tells else factor * (USUAL if task.duration is None else task.duration)
    target = found.pop("target")
    return task.replace(duration=duration, loads=list(found.values()), target=target, time_factor=1.0)


def at_start(grasp: Grasp, wrench: Array) -> Grasp:
    """Return the grasp as it is when a task begins: a hand holds the load (6,) of its first instant.

    A grasp given as matrices says itself what it holds at the start.
    """
    if grasp.held is None or np.array_equal(grasp.w_0, wrench):
        return grasp
    return replace(grasp, w_0=frozen(wrench))


def _palm(task: Task, start: float, end: float) -> PalmInWorld | None:
    """Return how the palm moves; None when it stands still."""
    moving = [load for load in task.loads if isinstance(load, Palm | PalmPath)]
    return moving[0].motion(start, end) if moving else None


def _over(parts: Mapping[str, Stated], setting: Setting) -> dict[str, Profile]:
    """Return loads and target over the time of the task, without those that add nothing, or all that is wrong."""
    found, issues = dict[str, Profile](), list[Issue]()
    for key, part in parts.items():
        try:
            profile = part.over(setting)
        except InputError as error:
            issues += error.under(f"Task.{key}").issues
        else:
            if profile is not None:
                found[key] = profile
    raise_issues(issues)
    return found
