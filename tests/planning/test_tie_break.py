"""What the goals leave open: settled by goals that nobody asks for, or left as it comes."""

from __future__ import annotations

import pytest

import synergrip as sg

GOALS = {'goal={maximise="margin"}': "largest margin", 'goal={minimise="peak_force"}': "least peak normal force"}


@pytest.mark.parametrize("goal", GOALS)
def test_ties_are_broken_unless_a_task_says_no(goal: str) -> None:
    broken, open_ = (sg.load_problem("tripod", [goal, *more]) for more in ((), ("goal.tie_break=false",)))
    assert (broken.task.tie_break, open_.task.tie_break, open_.timed.tie_break) == (True, False, False)
    settled, any_best = (sg.plan(problem.grasp, problem.task) for problem in (broken, open_))
    assert isinstance(settled, sg.Plan)
    assert isinstance(any_best, sg.Plan)
    assert [each.goal for each in settled.decisions] == [GOALS[goal], "least contact effort"]
    assert [each.goal for each in any_best.decisions] == [GOALS[goal]]
    efforts = [float((plan.forces**2).sum()) for plan in (settled, any_best)]
    assert efforts[0] <= efforts[1] * (1 + 1e-6)
    assert all(check.passed for check in any_best.checks)
    values = [plan.margins.min() if "margin" in goal else plan.usages["normal force"].value.max()
              for plan in (settled, any_best)]  # fmt: skip
    assert values[0] == pytest.approx(values[1], rel=1e-6)


def test_whether_ties_are_broken_is_yes_or_no() -> None:
    with pytest.raises(sg.InputError, match=r"Task\.tie_break: expected True or False, got 'no'"):
        sg.Task(tie_break="no")  # type: ignore[arg-type]
    with pytest.raises(sg.InputError, match=r"goal\.tie_break"):
        sg.load_problem("tripod", ["goal.tie_break=maybe"])
