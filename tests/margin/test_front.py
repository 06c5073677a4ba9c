"""The front of margin and peak force: nothing is better in both, and its ends are the two goals by themselves."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from named_goals import goals
from typer.testing import CliRunner

from synergrip.cli.app import app
from synergrip.conic.along import AlongPath
from synergrip.conic.program import Program
from synergrip.conic.question import Question
from synergrip.conic.solution import Settings, Solution
from synergrip.margin.friction_front import friction_front, least_peak
from synergrip.margin.front import ROOM, front, largest
from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan, plan_of_start_posture
from synergrip.planning.solvers import SOLVERS
from synergrip.problems.problem import load_problem


@pytest.mark.parametrize("name", ["barrett-ball-hold", "utah-mit-ball"])
def test_the_front_runs_from_the_least_peak_to_the_largest_margin(name: str) -> None:
    problem = load_problem(name)
    best = largest(problem.grasp, problem.timed)
    assert isinstance(best, Plan)
    points = list(front(best, 5))
    assert len(points) == 5
    margins, peaks = (np.array([getattr(point, key) for point in points]) for key in ("margin", "peak"))
    assert np.all(np.diff(margins) > 0)
    assert np.all(np.diff(peaks) > -1e-3 * peaks.max())  # the forces of the hand that moves are promised to 1e-3
    assert np.all(np.diff(peaks, 2) > -4e-3 * peaks.max())  # the trade is convex
    begun = plan_of_start_posture(problem.grasp, best.task)
    assert isinstance(begun, Plan)
    assert best.between is not None
    most = min(best.largest_margin, begun.largest_margin, best.between.usages[0].value.min())
    assert margins[-1] == pytest.approx(most, abs=1.1 * ROOM * best.formulation.force_unit)
    least = plan(problem.grasp, replace(problem.timed, goals=goals("peak_force", "effort")))
    assert isinstance(least, Plan)
    assert peaks[0] == pytest.approx(least.motion.forces[:, problem.grasp.normal_rows].max(), rel=1e-6)
    middle = points[2]
    assert middle.plan.margins.min() >= middle.margin - 1e-3
    capped = f"limits.normal_force={0.99 * middle.peak} N"
    short = load_problem(name, [capped, f"limits.margin={middle.margin} N"])
    assert plan(short.grasp, short.task).verdict != "feasible"  # no less force gives that margin


def test_a_pinch_pays_one_newton_of_margin_with_a_known_force() -> None:
    """Two opposed fingers: margin mu n - load / 2, so the peak is (margin + load / 2) / mu."""
    problem = load_problem("pinch-soft")
    best = largest(problem.grasp, problem.timed)
    assert isinstance(best, Plan)
    points = list(front(best, 4))
    slopes = np.diff([point.peak for point in points]) / np.diff([point.margin for point in points])
    assert slopes == pytest.approx(1 / problem.grasp.contacts[0].friction, rel=1e-5)


def test_the_verb_prints_a_line_for_each_point(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "200")
    found = CliRunner().invoke(app, ["front", "utah-mit-ball", "-n", "3"])
    assert found.exit_code == 0
    assert len(found.stdout.splitlines()) == 4 + 1 + 3  # read, task, front, blank; header; points
    document = json.loads(CliRunner().invoke(app, ["front", "utah-mit-ball", "-n", "3", "--format", "json"]).stdout)
    assert [sorted(point) for point in document["front"]] == [["dz_r", "margin_N", "peak_normal_N"]] * 3


def test_a_task_that_cannot_be_done_has_no_front() -> None:
    found = CliRunner().invoke(app, ["front", "barrett-ball-lift"])
    assert found.exit_code == 1
    assert "infeasible" in found.stdout


@pytest.mark.parametrize("goal", ["least peak normal force", "least contact effort"])
def test_an_interrupt_ends_the_front_and_keeps_whole_points_only(goal: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Whether it comes in the first goal of the third point or in its second goal, after which there is a plan."""
    arguments = ["front", "utah-mit-ball", "-n", "5", "--format", "json"]
    whole = json.loads(CliRunner().invoke(app, arguments).stdout)["front"]
    asked, begun = list[str](), list[str]()

    def interrupted(question: Question, program: Program, settings: Settings) -> Solution:
        asked.append(question.goal.name)
        starts = not isinstance(question.formulation, AlongPath)
        begun.extend([question.goal.name] * (starts and question.goal.name == "least peak normal force"))
        if len(begun) == 3 and starts and question.goal.name == goal:
            raise KeyboardInterrupt
        return clarabel(question, program, settings)

    clarabel = SOLVERS["clarabel"]
    monkeypatch.setitem(SOLVERS, "clarabel", interrupted)
    found = CliRunner().invoke(app, arguments)
    assert found.exit_code == 130
    document = json.loads(found.stdout)
    assert document["interrupted"] is True
    assert document["front"] == whole[:2]
    assert asked[-1] == goal


def test_a_pinch_pays_for_slippery_fingers_by_one_over_their_friction() -> None:
    """Its peak is (margin + load / 2) / mu, up to the cap of 20 N, spin friction as much less."""
    problem = load_problem("pinch-soft", ["limits.margin=0 N"])
    best = least_peak(problem.grasp, problem.task)
    assert isinstance(best, Plan)
    points = list(friction_front(best, problem.task, 4))
    scales, peaks = (np.array([getattr(point, name) for point in points]) for name in ("scale", "peak"))
    assert scales[-1] == 1.0
    np.testing.assert_allclose(np.diff(np.log(scales)), -np.log(scales[0]) / 3, rtol=1e-3)
    np.testing.assert_allclose(peaks * scales, peaks[-1], rtol=1e-5)
    assert peaks[-1] == pytest.approx(np.hypot(1.0, 0.2) / 0.5, rel=1e-5)  # half the weight, and its spin as a force
    assert peaks[0] == pytest.approx(20.0, rel=2e-3)


def test_what_is_slippery_is_printed_with_its_setting_and_is_the_least_peak_there(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv("COLUMNS", "200")
    arguments = ["front", "gripper-box", "-n", "3", "--against", "friction", "--set", "task.knots=5"]
    document = json.loads(CliRunner().invoke(app, [*arguments, "--format", "json"]).stdout)
    assert [sorted(point) for point in document["front"]] == [["dz_r", "friction_scale", "peak_normal_N", "set"]] * 3
    peaks = [point["peak_normal_N"] for point in document["front"]]
    assert peaks == sorted(peaks, reverse=True)
    middle = document["front"][1]
    for share, verdict in ((1.002, "feasible"), (0.99, "infeasible")):
        capped = f"limits.normal_force={share * middle['peak_normal_N']} N"
        again = load_problem("gripper-box", ["task.knots=5", middle["set"], capped])
        assert (plan(again.grasp, again.task).verdict == "feasible") is (verdict == "feasible")
    told = CliRunner().invoke(app, arguments).stdout.splitlines()
    assert [line.split("--set ")[1].strip("'") for line in told[-3:]] == [point["set"] for point in document["front"]]
