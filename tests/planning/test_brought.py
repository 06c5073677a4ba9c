"""A hold that is brought along the whole motion at once: a place to begin at, and cheaper than growing."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from synergrip.planning.brought import brought
from synergrip.planning.executing import Executor
from synergrip.planning.going_on import _without_motion
from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan, plan_of_start_posture
from synergrip.planning.solvers import SOLVERS
from synergrip.planning.walk import Walker
from synergrip.problems.problem import load_problem


@cache
def held(name: str, *overrides: str) -> tuple[Walker, Plan]:
    """Return who walks a problem, and the linear plan of its loads without the motion."""
    problem = load_problem(name, overrides)
    task = problem.timed
    hold = plan_of_start_posture(problem.grasp, _without_motion(task))
    assert isinstance(hold, Plan)
    return Walker(task, hold.analysis, Executor.of(hold.analysis, task), SOLVERS["clarabel"]), hold


@pytest.mark.parametrize("name", ["dlr-ball-turn", "gripper-box-draw"])
def test_a_hold_is_brought_near_where_passes_go_on_from(name: str) -> None:
    walker, hold = held(name, "task.knots=9")
    whole = walker.executed(hold.dz_r, None, hold.motion)
    walk = brought(walker, hold.dz_r)
    assert walk is not None
    assert whole.behind > 0.01
    assert walk.behind < 0.05 * whole.behind
    assert walk.passes <= 3
    apart = np.abs(walk.executed.states.forces - whole.executed.states.forces).max()
    assert apart < 2 * whole.largest  # the linear plan of the whole turn squeezes with twenty times as much
    promised = walker.on(walk)
    assert walker.arrived(promised)
    assert promised.passes - walk.passes <= 3


def test_fingers_that_are_nearly_straight_are_not_brought_along() -> None:
    walker, hold = held("gripper-box", "task.knots=11", "task.move[0].lift=40 mm")
    assert brought(walker, hold.dz_r) is None


@pytest.mark.parametrize(("name", "passes"), [("dlr-ball-turn", 5), ("gripper-box-draw", 4)])
def test_what_has_no_plan_at_the_start_posture_takes_few_passes(name: str, passes: int) -> None:
    problem = load_problem(name)
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Plan)
    assert answer.passes <= passes
