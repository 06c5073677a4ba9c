"""A push that ends on a turned object takes its moment with it: margins just after it, by the second execution."""

import json
from pathlib import Path

import numpy as np
import pytest
from second_execution import between_knots, executed

from synergrip import load_problem, plan
from synergrip.reports.data.json_plan import outcome_document
from synergrip.tasks.pushes import Push, shares_in_order
from synergrip.tasks.stated import Setting

REPOSITORY = Path(__file__).parents[2]
PUSH = '{force="2 N", direction=[0,0,1], at=["0 mm","60 mm","0 mm"], end="1.5 s"}'


def pushing(start, end):
    return Push(force=1.0, direction="x", start=start, end=end).over(Setting(0.0, 2.0))


def test_margins_beside_the_end_of_a_push_are_those_of_the_load_there():
    problem = load_problem("dlr-ball-turn", ["task.knots=5", 'limits.normal_force="40 N"', f"task.push=[{PUSH}]"])
    answer = plan(problem.grasp, problem.task)
    told = answer.between.usages[0]
    rows = np.flatnonzero(np.abs(told.times - 1.5) < 1e-9)
    assert len(rows) == 2
    document = json.loads(json.dumps(outcome_document("", problem.grasp, answer)))
    done = executed(between_knots(document, 2), REPOSITORY)
    assert done.ended is None
    beside = done.margins[np.abs(done.times - 1.5) < 1e-9]
    assert np.abs(beside[1] - beside[0]).max() > 1
    assert np.abs(told.value[rows] - beside).max() < 2e-3
    assert beside.min() > 0.499


def test_steps_are_on_at_their_ends_and_off_beside_them():
    first, second = pushing(0.5, 1.0), pushing(1.0, 2.0)
    times = np.array([0.0, 0.5, 0.5, 0.75, 1.0, 1.0, 1.0, 2.0])
    on = shares_in_order([first, second], times)
    assert on.tolist() == [[0, 0, 1, 1, 1, 1, 0, 0], [0, 0, 0, 0, 0, 1, 1, 1]]


@pytest.mark.parametrize("times", [[0.0, 0.5, 1.0, 2.0], [0.5, 1.0], [0.5]])
def test_instants_that_stand_once_are_those_of_the_push_itself(times):
    first, second = pushing(0.5, 1.0), pushing(1.0, 2.0)
    on = shares_in_order([first, second], np.array(times))
    assert on.tolist() == [first.share(np.array(times)).tolist(), second.share(np.array(times)).tolist()]
