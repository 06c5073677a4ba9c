from dataclasses import replace

import numpy as np
import pytest

from synergrip.conic.limits.limit import Usage
from synergrip.plans.between import Between
from synergrip.plans.planning import plan
from synergrip.plans.problem import load_problem
from synergrip.reports.json_plan import between_document, outcome_document
from synergrip.reports.text_between import between_lines


@pytest.mark.parametrize(
    ("unit", "said"),
    [
        ("rad", "reaches 120.3 deg at t = 0.5 s, past its limit of 114.6 deg"),
        ("m", "reaches 2100 mm at t = 0.5 s, past its limit of 2000 mm"),
        ("N m", "reaches 2.1 N m at t = 0.5 s, past its limit of 2 N m"),
        ("", "reaches 2.1 at t = 0.5 s, past its limit of 2;"),
    ],
)
def test_a_limit_that_is_passed_is_told_in_the_units_of_the_table(unit, said):
    problem = load_problem("pinch-soft")
    one = np.ones(1)
    passed = Usage("limit", unit, ("item",), np.array([[2.1]]), -2 * one, 2 * one, one, np.array([0.5]))
    answer = replace(plan(problem.grasp, problem.task), between=Between(16, 0.1, 0.0, (passed,)))
    assert said in " ".join(" ".join(between_lines(answer)).split())


@pytest.mark.parametrize(
    ("load", "path", "said"),
    [
        (0.1, 0.0, "; the load leaves its straight line by 0.1 N; all"),
        (0.0, 2e-4, "; the wanted motion leaves its straight line by 0.2 mm; all"),
        (0.1, 2e-4, "; the load leaves its straight line by 0.1 N; the wanted motion its own by 0.2 mm; all"),
        (0.0, 0.0, "loads and wishes are straight lines from knot to knot; all"),
    ],
)
def test_what_leaves_its_straight_line_is_told(load: float, path: float, said: str) -> None:
    problem = load_problem("pinch-soft")
    one = np.ones(1)
    kept = Usage("limit", "m", ("item",), np.array([[1.0]]), -2 * one, 2 * one, one, np.array([0.5]))
    answer = replace(plan(problem.grasp, problem.task), between=Between(16, load, path, (kept,)))
    assert said in " ".join(" ".join(between_lines(answer)).split())


def test_the_document_tells_the_bounds_of_the_limits_as_at_the_knots():
    problem = load_problem("barrett-ball-hold", ["task.knots=5"])
    answer = plan(problem.grasp, problem.task)
    found, knots = between_document(answer.between), outcome_document("", problem.grasp, answer)["limits"]
    told = ("name", "unit", "lower", "upper")
    assert [[each[key] for key in told] for each in found["limits"]] == [[each[key] for key in told] for each in knots]
    assert all(each["lower"] is not None or each["upper"] is not None for each in found["limits"])
