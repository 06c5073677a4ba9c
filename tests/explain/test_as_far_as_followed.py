"""A motion that is followed for a part of the way: that part is among what would help, in the short form, too."""

from __future__ import annotations

import pytest

from synergrip.planning.outcome import Plan, Unknown
from synergrip.planning.planning import plan
from synergrip.problems.problem import load_problem

ASKED = ["task.move[0].lift=10 mm", "task.knots=11"]


def test_as_much_of_the_motion_as_was_followed_is_planned_with() -> None:
    problem = load_problem("gripper-box", ASKED)
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Unknown)
    assert answer.reached is not None
    (repair,) = (
        each for each in (*answer.explanation.repairs, *answer.explanation.others) if each.cause == "amplitude"
    )
    assert repair.verified
    assert repair.to == pytest.approx(answer.reached.pose[2] / 10e-3, rel=0.12)
    again = load_problem("gripper-box", [*ASKED, repair.set])
    assert isinstance(plan(again.grasp, again.task), Plan)
