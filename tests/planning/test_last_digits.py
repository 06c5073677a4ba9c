"""What promise and truth may still differ by makes no plan unknown, nor does a way that is too long for a pass."""

from __future__ import annotations

from dataclasses import replace

import pytest

from synergrip import Plan, load_problem, plan
from synergrip.planning.beginning import walk_from_plan
from synergrip.planning.executing import Executor
from synergrip.planning.planning import plan_of_start_posture
from synergrip.planning.solvers import SOLVERS
from synergrip.planning.walk import Walker
from synergrip.planning.walked import answer_of

GOAL = 'goal={minimise="effort"}'


@pytest.mark.parametrize("knots", [1, 9])
def test_a_margin_that_is_just_missed_at_a_knot_is_asked_for_with_a_little_more(knots: int) -> None:
    """A walk that is true keeps less than is asked for, where limits count at the knots only."""
    problem = load_problem(
        "table2-hard-joints", ["limits.margin=0.5 N", f"task.knots={knots}", "task.between=report", GOAL]
    )
    linear = plan_of_start_posture(problem.grasp, problem.task)
    assert isinstance(linear, Plan)
    walker = Walker(linear.task, linear.analysis, Executor.of(linear.analysis, linear.task), SOLVERS["clarabel"])
    walk = walk_from_plan(walker, linear.motion)
    least = float(walk.executed.margins.min())
    asked = least + 2 * walk.kept_to
    more = replace(linear.task, margin=asked)
    answer = answer_of(walk, replace(walker, task=more), replace(linear, task=more))
    assert isinstance(answer, Plan), answer
    assert answer.margins.min() >= asked - walk.kept_to


def test_a_way_that_no_shorter_step_makes_true_is_made_shorter_itself() -> None:
    """The last of the way takes large joint motions near a straight posture, and the tolerance leaves room for it."""
    problem = load_problem("dlr-ball-move", [
        'task.move=[{axis="x", roll="17.3 deg"}]', "task.tolerance=3 mm", "task.knots=11", "task.between=report",
        "limits.margin=0.04 N", "limits.joint_range=none",
    ])  # fmt: skip
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Plan), answer
    (note,) = (note for note in answer.notes if "near a straight posture the object stays up to" in note)
    assert "'thumb_distal'" in note
    assert "which thumb/tip is moved by" in note
