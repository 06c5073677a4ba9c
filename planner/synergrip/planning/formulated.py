"""A task on a grasp as a formulation: what its wanted motion fixes, and what is left to the program."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from synergrip.conic.allowed import Allowed
from synergrip.conic.formulate import formulate
from synergrip.conic.formulation import Formulation
from synergrip.errors import InputError
from synergrip.linalg import RANK_TOLERANCE, Array
from synergrip.planning.free import refuse_use_of_free
from synergrip.statics.analysis import Analysis
from synergrip.tasks.control import refuse_control
from synergrip.tasks.scaling import expected_and_stated
from synergrip.tasks.timed_task import TimedTask
from synergrip.tasks.tracking import followed


def formulated(analysis: Analysis, task: TimedTask, *, redundancy: bool) -> Formulation:
    """Return what the program's unknowns mean in a task, at its knots.

    Args:
        analysis: of the grasp.
        task: its loads and its wanted motion.
        redundancy: whether gamma is an unknown.

    Raises:
        Refusal: load or wanted motion need what the contacts leave free, or the motion, or what is to be controlled, is
            impossible by count or direction.
        InputError: modes are given that do not fit the grasp.
    """
    refuse_use_of_free(analysis, task)
    if task.control is not None:
        refuse_control(analysis, task.control)
    follow = followed(analysis, task)
    sizes, stated = expected_and_stated(analysis, task, follow.beta, follow.target)
    if task.allowed is not None:
        refuse_unheld(analysis, task.allowed, task.times)
    found = formulate(
        analysis.response, analysis.spaces, analysis.coordinates,
        times=task.times, wrench=task.wrench, beta=follow.beta, beta_basis=follow.basis, target=follow.target,
        units=sizes, redundancy=redundancy, stated=stated,
    )  # fmt: skip
    return found if task.allowed is None else replace(found, allowed=task.allowed.on(found))


def refuse_unheld(analysis: Analysis, allowed: Allowed, times: Array) -> None:
    """Refuse allowed loads that work on a motion of the object that no contact resists, and scenarios on a hand there.

    Raises:
        InputError: with the load.
    """
    response = analysis.response
    if allowed.scenarios is not None and analysis.grasp.held is not None and not response.restrained:
        message = "these contacts leave a motion of the object free, so that no scenario comes to rest on the hand"
        raise InputError.at("Task.allow.scenarios", message)
    for case in allowed.cases if not response.restrained else ():
        if case.extra is not None:
            load = response.scale.wrench(case.extra.at(times))
            along = float(np.linalg.norm(load @ response.free, axis=1).max())
            if along > RANK_TOLERANCE * float(np.linalg.norm(load, axis=1).max()):
                message = f"{case.title} works on a motion of the object that these contacts leave free"
                raise InputError.at("Task.allow", message)
