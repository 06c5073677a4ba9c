"""A plan over time as a picture: the charts hold the plan's own numbers, and the lines are those of the charts."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from command_line import document, run

from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan
from synergrip.planning.told import series_document
from synergrip.problems.problem import load_problem
from synergrip.reports.pictures.contact_colors import COLORS
from synergrip.reports.pictures.key import Key
from synergrip.reports.pictures.limits_drawn import apart
from synergrip.reports.pictures.line_chart import OTHERS
from synergrip.reports.pictures.lines import Lines, limit_lines, plan_lines
from synergrip.reports.pictures.plan_picture import draw_charts, draw_plan


@cache
def planned(name: str) -> Plan:
    problem = load_problem(name)
    outcome = plan(problem.grasp, problem.task)
    assert isinstance(outcome, Plan)
    return outcome


def by_title(outcome: Plan) -> dict[str, Lines]:
    return {lines.title: lines for lines in plan_lines(outcome)}


def test_charts_hold_the_motion_the_limits_and_the_references_of_the_plan() -> None:
    outcome = planned("gripper-peg")
    found = by_title(outcome)
    assert list(found) == ["slip margin", "contact force", "normal force", "joint torque", "joint value",
                           "tracking error", "synergy reference", "object displacement", "object rotation"]  # fmt: skip
    np.testing.assert_allclose(found["object displacement"].values, 1e3 * outcome.motion.du[:, :3])
    np.testing.assert_allclose(found["object displacement"].target[-1], [0, 0, 3], atol=1e-9)
    np.testing.assert_allclose(found["object rotation"].values, np.degrees(outcome.motion.du[:, 3:]))
    assert found["slip margin"].bounds == (0.5,)
    assert found["normal force"].bounds == (0.0, 20.0)
    assert found["tracking error"].label == "tracking error [mm]"
    assert found["tracking error"].bounds == (0.1,)
    # mm, to which limits on motions are kept
    assert found["tracking error"].values.max() == pytest.approx(0.1, abs=0.01)
    references, names = outcome.motion.dz_r, outcome.analysis.grasp.synergies
    order = [names.index(name) for name in found["synergy reference"].names]
    np.testing.assert_allclose(found["synergy reference"].values, references[:, order])


def test_every_contact_has_its_own_place_and_colour_in_every_chart() -> None:
    outcome = planned("gripper-peg")
    names = tuple(contact.name for contact in outcome.grasp.contacts)
    of_contacts = [lines for lines in plan_lines(outcome) if lines.of_contacts]
    assert [lines.title for lines in of_contacts] == ["slip margin", "contact force", "normal force"]
    assert {lines.names for lines in of_contacts} == {names}
    assert not set(COLORS) & set(OTHERS)


def test_torques_and_joints_are_in_percent_of_what_each_joint_may_do() -> None:
    outcome = planned("human-glass-set-down")
    found, usages = by_title(outcome), {usage.title: usage for usage in outcome.usages}
    torque, value = found["joint torque"], found["joint value"]
    assert (torque.label, value.label) == ("joint torque [% of limit]", "joint value [% of its range]")
    joints, limits = outcome.grasp.joints, usages["joint torque"]
    order = [joints.index(name) for name in torque.names]
    assert sorted(order) == list(range(len(joints)))
    np.testing.assert_allclose(torque.values, 100 * outcome.motion.torques[:, order] / limits.upper[order])
    ranges = usages["joint value"]
    k, i = ranges.worst()
    assert value.names[0] == ranges.items[i]  # nearest to its bound
    share = (ranges.value[k, i] - ranges.lower[i]) / (ranges.upper[i] - ranges.lower[i])
    assert value.values[k, 0] == pytest.approx(100 * share)
    assert value.bounds == (0.0, 100.0)


def test_bounds_of_single_lines_that_are_no_range_are_kept() -> None:
    usage = planned("gripper-peg").usages["joint torque"]
    upper = np.array([np.inf, *usage.upper[1:]])
    told = series_document(replace(usage, title="speed", upper=upper, lower=np.full(len(upper), -np.inf)))
    found = limit_lines(told, ())
    assert found.own is not None
    np.testing.assert_allclose(np.sort(found.own[1]), [*np.sort(upper[1:]), np.nan])  # NaN comes last
    assert np.isnan(found.own[0]).all()
    np.testing.assert_allclose(np.sort(found.values), np.sort(usage.value))


def test_a_limit_far_away_is_drawn_beyond_a_break_of_the_axis(tmp_path: Path) -> None:
    times, values = np.linspace(0, 1, 5), np.array([[1.0, 2.0]] * 5)
    force = Lines("force", "N", ("a", "b"), values, (0.0, 20.0))
    assert apart(force) == ((0.0,), None, 20.0)
    assert apart(replace(force, bounds=(0.0, 4.0))) == ((0.0, 4.0), None, None)
    share = replace(force, unit="% of limit", bounds=(-100.0, 100.0))
    assert apart(share) == ((), None, 100.0)  # on the side that is used
    assert apart(replace(share, values=-values)) == ((), -100.0, None)
    assert apart(replace(share, values=values * [1, -1])) == ((), -100.0, 100.0)
    draw_charts([force, replace(share, values=-values)], times, "", "", tmp_path / "far.svg")
    draw_charts([force], times[:1], "", "", tmp_path / "bars.svg")
    drawn = (tmp_path / "far.svg").read_text(encoding="utf-8")
    assert ">limit 20 N</text>" in drawn
    assert ">limit −100%</text>" in drawn
    assert ">20</text>" not in drawn  # no tick of the axis before the break
    assert ">limit 20 N</text>" in (tmp_path / "bars.svg").read_text(encoding="utf-8")


def test_ticks_say_what_they_stand_for(tmp_path: Path) -> None:
    times, level = np.linspace(0, 1, 5), np.linspace(0, 2e-5, 5)[:, None]
    for lines in (Lines("high", "", ("a",), 1234.5 + 200 * level), Lines("low", "", ("a",), level)):
        draw_charts([lines], times, "", "", tmp_path / "ticks.svg")
        drawn = re.findall(r">([^<>]+)</text>", (tmp_path / "ticks.svg").read_text(encoding="utf-8"))
        assert not [text for text in drawn if "1e" in text or text.startswith("+")], drawn


def test_names_of_a_key_never_run_out_of_the_sheet() -> None:
    names = tuple((f"a_long_name_of_a_joint_{k}", "#000000") for k in range(7))
    rows = Key(names, 4.0).rows
    assert [entry[1] for row in rows for entry in row] == [name for name, _ in names]
    assert len(rows) > 2
    assert all(row[-1][0] < 4.0 for row in rows)
    assert len(Key((("x" * 300, "#000000"),), 1.0).rows) == 1


def test_every_line_of_every_chart_is_drawn_with_its_limits(tmp_path: Path) -> None:
    outcome = planned("gripper-peg")
    draw_plan(outcome, "A title with <signs> & letters", tmp_path / "one.svg")
    draw_plan(outcome, "A title with <signs> & letters", tmp_path / "two.svg")
    svg = (tmp_path / "one.svg").read_text(encoding="utf-8")
    assert svg == (tmp_path / "two.svg").read_text(encoding="utf-8")
    charts = plan_lines(outcome)
    lines = sum(chart.values.shape[1] * (2 if chart.target is not None else 1) for chart in charts)
    limits = sum(len(near) + (low is not None) + (high is not None) for near, low, high in map(apart, charts))
    curves = re.findall(r'<path d="([^"]*)" clip-path=', svg)
    assert len(curves) == lines + limits
    assert [curve.count("L") for curve in curves].count(len(outcome.motion.times) - 1) == lines
    for chart in charts:
        assert f">{chart.label}</text>" in svg
    assert ">A title with &lt;signs&gt; &amp; letters</text>" in svg


def test_a_plan_of_one_instant_is_drawn_as_bars(tmp_path: Path) -> None:
    outcome = planned("pinch-soft")
    draw_plan(outcome, "one instant", tmp_path / "one.svg")
    svg = (tmp_path / "one.svg").read_text(encoding="utf-8")
    assert "time [s]" not in svg
    for color in COLORS[:2]:
        assert f"fill: {color}" in svg
    for contact in outcome.grasp.contacts:
        assert f">{contact.name}</text>" in svg


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


def test_a_limit_that_the_axis_reaches_is_not_beyond_a_break(tmp_path: Path) -> None:
    slip = Lines("slip", "mm", ("a",), np.full((5, 1), 1e-4), (0.05,))
    draw_charts([slip], np.linspace(0, 1, 5), "", "", tmp_path / "slip.svg")
    assert "limit" not in (tmp_path / "slip.svg").read_text(encoding="utf-8")
