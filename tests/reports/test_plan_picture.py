"""A plan over time as a picture: the charts hold the plan's own numbers, and the lines are those of the charts."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from command_line import document, run

from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan
from synergrip.problems.problem import load_problem
from synergrip.reports.pictures.courses import Chart, charts
from synergrip.reports.pictures.plan_picture import draw_plan


def planned(name: str, *overrides: str) -> Plan:
    problem = load_problem(name, overrides)
    outcome = plan(problem.grasp, problem.task)
    assert isinstance(outcome, Plan)
    return outcome


def by_title(outcome: Plan) -> dict[str, Chart]:
    return {chart.title: chart for chart in charts(outcome)}


def test_charts_hold_the_motion_the_limits_and_the_references_of_the_plan() -> None:
    outcome = planned("gripper-peg")
    found = by_title(outcome)
    assert list(found) == ["object displacement", "object rotation", "slip margin", "normal force", "joint torque",
                           "joint value", "tracking error", "synergy reference"]  # fmt: skip
    np.testing.assert_allclose(found["object displacement"].values, 1e3 * outcome.motion.du[:, :3])
    np.testing.assert_allclose(found["object displacement"].target[-1], [0, 0, 3], atol=1e-9)
    np.testing.assert_allclose(found["object rotation"].values, np.degrees(outcome.motion.du[:, 3:]))
    assert found["slip margin"].bounds == (0.5,)
    assert found["normal force"].bounds == (0.0, 20.0)
    assert found["tracking error"].label == "tracking error [mm]"
    assert found["tracking error"].bounds == (0.1,)
    assert found["tracking error"].values.max() == pytest.approx(
        0.1, abs=0.01
    )  # mm, to which limits on motions are kept
    for title, values, names in (
        ("joint torque", outcome.motion.torques, outcome.analysis.grasp.joints),
        ("synergy reference", outcome.motion.dz_r, outcome.analysis.grasp.synergies),
    ):
        order = [names.index(name) for name in found[title].names]
        np.testing.assert_allclose(found[title].values, values[:, order])


def test_lines_nearest_to_their_bound_come_first() -> None:
    outcome = planned("human-glass-set-down")
    usage = next(usage for usage in outcome.usages if usage.title == "joint value")
    chart = by_title(outcome)["joint value"]
    k, i = usage.worst()
    assert chart.names[0] == usage.items[i]
    assert chart.values[k, 0] == pytest.approx(np.degrees(usage.value[k, i]))
    assert chart.bounds == ()  # every joint has its own


def test_every_line_of_every_chart_is_drawn_with_its_limits(tmp_path: Path) -> None:
    outcome = planned("gripper-peg")
    draw_plan(outcome, "A title with <signs> & letters", tmp_path / "one.svg")
    draw_plan(outcome, "A title with <signs> & letters", tmp_path / "two.svg")
    svg = (tmp_path / "one.svg").read_text(encoding="utf-8")
    assert svg == (tmp_path / "two.svg").read_text(encoding="utf-8")
    lines = sum(chart.values.shape[1] * (2 if chart.target is not None else 1) for chart in charts(outcome))
    limits = sum(len(chart.bounds) for chart in charts(outcome))
    curves = re.findall(r'<path d="([^"]*)" clip-path=', svg)
    assert len(curves) == lines + limits
    assert [curve.count("L") for curve in curves].count(len(outcome.motion.times) - 1) == lines
    for chart in charts(outcome):
        assert f">{chart.label}</text>" in svg
    assert ">A title with &lt;signs&gt; &amp; letters</text>" in svg


def test_a_plan_of_one_instant_is_drawn_as_points(tmp_path: Path) -> None:
    draw_plan(planned("pinch-soft"), "one instant", tmp_path / "one.svg")
    assert "<use xlink:href" in (tmp_path / "one.svg").read_text(encoding="utf-8")


def test_the_command_draws_a_plan_and_says_when_there_is_none(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    picture = tmp_path / "plan.svg"
    found = document("plan", "pinch-soft", "--picture", str(picture))
    assert found["picture"] == str(picture)
    assert picture.read_text(encoding="utf-8").startswith("<?xml")
    done = run("plan", "pinch-hard", "--picture", str(tmp_path / "none.svg"))
    assert "there is no plan" in done.stderr
    assert not (tmp_path / "none.svg").exists()
    wrong = run("plan", "pinch-soft", "--picture", str(tmp_path / "plan.gif"))
    assert wrong.exit_code == 2
    assert "--picture" in wrong.stderr
