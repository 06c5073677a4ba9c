from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from synergrip.conic.limits.limit import Usage
from synergrip.planning.between import Between
from synergrip.planning.planning import plan
from synergrip.problems.problem import load_problem
from synergrip.reports.data.json_plan import between_document, outcome_document
from synergrip.reports.text.text_between import between_lines


@pytest.mark.parametrize(
    ("unit", "said"),
    [
        ("rad", "reaches 120.3 deg at t = 0.5 s, past its limit of 114.6 deg"),
        ("m", "reaches 2.1 m at t = 0.5 s, past its limit of 2 m"),
        ("N m", "reaches 2.1 N m at t = 0.5 s, past its limit of 2 N m"),
        ("", "reaches 2.1 at t = 0.5 s, past its limit of 2;"),
    ],
)
def test_a_limit_that_is_passed_is_told_in_the_units_of_the_table(unit, said):
    problem = load_problem("pinch-soft")
    one = np.ones(1)
    passed = Usage("limit", unit, ("item",), np.array([[2.1]]), -2 * one, 2 * one, one, np.array([0.5]))
    answer = replace(plan(problem.grasp, problem.task), between=Between(16, 0.1, 0.0, 1.0, (passed,)))
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
    answer = replace(plan(problem.grasp, problem.task), between=Between(16, load, path, 1.0, (kept,)))
    assert said in " ".join(" ".join(between_lines(answer)).split())


def test_the_document_tells_the_bounds_of_the_limits_as_at_the_knots():
    problem = load_problem("barrett-ball-hold", ["task.knots=5"])
    answer = plan(problem.grasp, problem.task)
    found, knots = between_document(answer.between), outcome_document("", problem.grasp, answer)["limits"]
    told = ("name", "unit", "lower", "upper")
    assert [[each[key] for key in told] for each in found["limits"]] == [[each[key] for key in told] for each in knots]
    assert all(each["lower"] is not None or each["upper"] is not None for each in found["limits"])


@pytest.mark.parametrize("knots", [2, 9, 41])
def test_the_document_tells_at_how_many_instants_a_hand_was_looked_at(knots: int) -> None:
    problem = load_problem("gripper-bar", [f"task.knots={knots}"])
    answer = plan(problem.grasp, problem.task)
    found, times = between_document(answer.between), answer.between.usages[0].times
    assert found["instants"] == len(times)
    inside = [np.sum((times > first) & (times < last)) for first, last in pairwise(answer.time)]
    assert set(inside) == {found["samples"]}
    assert not found["corners_s"]
    assert len(times) == knots + (knots - 1) * found["samples"]


def test_a_motion_that_falls_between_the_knots_is_noted(tmp_path: Path) -> None:
    """Up and down again between two knots: the plan stays where it is, and says so."""
    file = tmp_path / "up.csv"
    file.write_text("t_s,x_m,y_m,z_m,rx_rad,ry_rad,rz_rad\n0,0,0,0,0,0,0\n1,0,0,0.002,0,0,0\n2,0,0,0,0,0,0\n")
    for knots, noted in ((2, True), (8, True), (40, False), (9, False)):  # an odd number of knots has one at the top
        overrides = ["task.move=[]", f"task.motion='{file}'", "task.between='report'", f"task.knots={knots}"]
        problem = load_problem("gripper-box", [*overrides, "goal={minimise='effort'}"])
        notes = plan(problem.grasp, problem.task).notes
        assert any("between its knots the plan goes straight" in note for note in notes) is noted
