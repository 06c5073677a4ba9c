"""Which tasks have a timing that is free: all that happens goes by the path of the palm, nothing by the clock."""

from __future__ import annotations

import numpy as np

from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.synergy_rate import SynergyRate
from synergrip.documents.judging import Arguments
from synergrip.errors import InputError, Issue, raise_issues
from synergrip.grasps.grasp import Grasp
from synergrip.tasks.palm_motion import Palm
from synergrip.tasks.palm_path import PalmPath
from synergrip.tasks.task import Task
from synergrip.tasks.timed_task import TimedTask

INSTEAD = "margins tells `shortest_duration_s` where one factor on all times is asked"


def timeless(grasp: object, task: object) -> tuple[Grasp, Task, TimedTask, Palm | PalmPath]:
    """Return the arguments, the task at its knots, and what moves the palm.

    Raises:
        InputError: other types; no path of the palm with inertia; a load, wanted motion or limit that goes by time.
    """
    judge = Arguments("")
    judge.one("grasp", grasp, Grasp, "make_grasp(...)")
    judge.one("task", task, Task, "Task(loads=[Gravity(...), PalmPath(..., inertia=True)])")
    judge.finish()
    assert isinstance(grasp, Grasp)
    assert isinstance(task, Task)
    palm = _palm(task)
    timed = task.timed(grasp)
    raise_issues([*_allowances(task), *_bound_loads(task), *_bound_target(task, timed), *_bound_limits(timed.limits)])
    return grasp, task, timed, palm


def _palm(task: Task) -> Palm | PalmPath:
    moving = [(i, load) for i, load in enumerate(task.loads) if isinstance(load, Palm | PalmPath)]
    if not moving:
        message = (
            "the fastest timing is along the path of a palm, and none is given; give PalmPath(..., inertia=True) or "
            "Palm(..., inertia=True), in a problem file task.palm"
        )
        raise InputError.at("Task.loads", message)
    ((index, palm),) = moving
    if not palm.inertia:
        message = "without inertia nothing depends on how fast the palm moves; give inertia=True (inertia = true)"
        raise InputError.at(f"Task.loads[{index}].inertia", message)
    return palm


def _bound_loads(task: Task) -> list[Issue]:
    issues = []
    for index, load in enumerate(task.loads):
        if isinstance(load, Palm | PalmPath) or not (load.lines is not None or load.timed or load.last is not None):
            continue
        message = (
            f"{type(load).__name__} is bound to time, and the fastest timing along a path has times of its own; leave "
            f"it out, or give its worst value as a load that stays (Wrench, a Push without start and end); {INSTEAD}"
        )
        issues.append(Issue(message, key=f"Task.loads[{index}]"))
    return issues


def _allowances(task: Task) -> list[Issue]:
    if task.allow is None:
        return []
    message = (
        "the fastest timing is that of what is stated, and knows nothing of other values; leave allow out, and plan "
        f"the path it gives with it; {INSTEAD}"
    )
    return [Issue(message, key="Task.allow")]


def _bound_target(task: Task, timed: TimedTask) -> list[Issue]:
    if not np.any(timed.target.values):
        return []
    message = (
        f"{type(task.target).__name__} moves the object in the hand at times of its own, and the fastest timing along "
        f"the path of the palm is of an object that is held; leave the wanted motion out (target=Hold()); {INSTEAD}"
    )
    return [Issue(message, key="Task.target")]


def _bound_limits(limits: tuple[Limit, ...]) -> list[Issue]:
    """Return issues of limits on changes over time other than rates, to which no timing is found."""
    message = (
        "speaks of several instants at once, in which the fastest timing is no convex program, and of such limits only "
        f"synergy_rate is taken in; leave it out and check the plan of the timing found; {INSTEAD}"
    )
    bound = [each for each in limits if each.couples_knots and not isinstance(each, SynergyRate)]
    return [Issue(message, key=each.key) for each in bound]
