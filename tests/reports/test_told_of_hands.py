"""What is told of the hand that moves: against what it is soft, what relies on rolling, how far off course it is."""

from __future__ import annotations

import re
from copy import copy
from functools import cache

import numpy as np
import pytest

import synergrip as sg
from synergrip.reports.text.text_plan import verdict_lines
from synergrip.statics.twists import describe_kind

FEW = 5


@cache
def planned(name: str, *overrides: str) -> tuple[sg.Problem, sg.Plan, str]:
    """Return a problem, its plan and what is told of it, in one line."""
    problem = sg.load_problem(name, overrides)
    plan = sg.plan(problem.grasp, problem.task)
    assert isinstance(plan, sg.Plan)
    return problem, plan, " ".join(" ".join(verdict_lines(problem, plan)).split())


def far(knots: int = FEW) -> tuple[sg.Problem, sg.Plan, str]:
    return planned("human-ball-far", f"task.knots={knots}")


@pytest.mark.parametrize(
    ("twist", "said"),
    [
        ((0, 0, -2.0, 0, 0, 0), "a shift along z of the palm"),
        ((0, 0.1, 0.01, 1, 0, 0), "a shift along y with a turn about x of the palm"),
        ((1e-3, 0, 0, 1, -1, 0), "a turn about (0.71, -0.71, 0) in axes of the palm"),
        ((1, 1, 0, 0, 0, 1), "a shift along (0.71, 0.71, 0) of the palm"),
    ],
)
def test_motions_are_told_by_their_kind(twist: tuple[float, ...], said: str) -> None:
    told = describe_kind(np.array(twist, dtype=float), 0.1)
    assert told == said.replace("(0.71, 0.71, 0) of the palm", "(0.71, 0.71, 0) in axes of the palm")


def test_the_softest_motion_is_what_a_wrench_along_it_makes() -> None:
    """Executed again with a little more load along it, the object gives by load over stiffness, and just that way."""
    _, plan, text = planned("gripper-box", f"task.knots={FEW}")
    executed, length, little = plan.executed, plan.executed.setting.length, 1e-4
    (twist,), k = executed.softest, int(np.argmin(executed.stiffness))
    scaled = twist * ([1.0] * 3 + [length] * 3)
    assert np.linalg.norm(scaled) == pytest.approx(1.0)
    load = np.array(plan.task.wrench)
    load[k] += little * scaled * ([1.0] * 3 + [length] * 3)
    again = sg.execute(plan.grasp, plan.time, plan.dz_r, sg.Loads.of(load), guess=executed)
    moved = again.du[k] - executed.du[k]
    assert moved == pytest.approx(little / executed.stiffness[k] * twist, abs=2e-2 * little / executed.stiffness[k])
    assert f"N/mm at least, against {describe_kind(twist, length)}" in text
    assert "against a shift along x of the palm" in text
    gives_way = copy(executed)
    vars(gives_way)["_given"] = -vars(executed)["_given"]
    assert gives_way.softest is None


def test_motions_that_are_resisted_alike_are_counted() -> None:
    """Which of them is softest is a matter of rounding."""
    _, plan, text = planned("table2-soft-joints")
    many = plan.executed.softest
    assert len(many) > 1
    assert f"N/mm at least, against {len(many)} motions alike" in text


def test_a_plan_that_relies_on_rolling_says_what_to_check() -> None:
    _, plan, text = far()
    assert plan.fixed.margins.min() < 0
    assert "if pads did not roll, a contact would slip" in text
    assert "their radius (7.5 mm)" in text
    assert "allow.contact_gap" in text
    _, sure, other = planned("gripper-box", f"task.knots={FEW}")
    assert sure.fixed.margins.min() >= 0
    assert "did not roll" not in other


def test_how_far_a_motion_is_off_is_told_where_no_limit_is_on_it() -> None:
    _, plan, text = far()
    left = plan.executed.left(plan.task.target.values)
    shift, turn = (np.linalg.norm(part, axis=1).max() for part in (left[:, :3], left[:, 3:]))
    assert float(re.search(r"position error (\S+) mm", text)[1]) == pytest.approx(1e3 * shift, rel=1e-3)
    assert float(re.search(r"rotation error (\S+) deg", text)[1]) == pytest.approx(np.degrees(turn), rel=1e-2)
    assert "error" not in planned("barrett-ball-hold", "task.knots=3")[2]
    peg = planned("gripper-peg")[2]
    assert "tracking error" in peg
    assert "position error" not in peg, "a limit on it has a row"
    free = planned("dlr-ball-lift-free")[2]
    assert "position error" in free
    assert "rotation error" not in free, "no rotation is asked for"


def test_what_is_of_synergies_has_the_unit_of_the_joints_that_they_move() -> None:
    free = planned("dlr-ball-lift-free")[2]
    assert re.search(r"actuator effort \S+ N m thumb_medial, t = \S+ s ± 3.6 N m", free)
    assert re.search(r"synergy reference \S+ rad thumb_medial, t = \S+ s ± 0.08 rad", free)
    assert re.search(r"synergy reference \S+ rad distal", planned("gripper-peg")[2])
    assert re.search(r"synergy reference \S+ z1", planned("tripod")[2]), "of matrices nobody knows it"


def test_few_knots_are_told_with_how_many_would_do() -> None:
    _, plan, text = far()
    told = re.search(r"between its 5 knots the object leaves the wanted course by up to (\S+) mm.*knots = (\d+)", text)
    times = np.linspace(plan.time[0], plan.time[-1], 201)
    references = np.stack([np.interp(times, plan.time, column) for column in plan.dz_r.T], axis=1)
    loads = sg.Loads.of(np.repeat(plan.task.wrench[:1], len(times), axis=0))
    executed = sg.execute(plan.grasp, times, references, loads, guess=plan.executed.interpolated(times))
    left = executed.left(plan.task.course.target_at(times))
    knots = np.stack(
        [np.interp(times, plan.time, column) for column in plan.executed.left(plan.task.target.values).T], 1
    )
    off = np.linalg.norm((left - knots) * ([1.0] * 3 + [executed.setting.length] * 3), axis=1).max()
    assert 1e-3 * float(told[1]) == pytest.approx(off, rel=0.1)  # the instants looked at are few
    _, finer, calm = far(int(told[2]))
    assert "leaves the wanted course" not in calm
    assert 0.3e-4 < finer.between.off_course < 1e-4
