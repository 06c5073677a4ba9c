"""The wanted motion through waypoints: where it is, how fast, and how smooth."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from task_tables import Loads, loads

from synergrip.errors import InputError
from synergrip.linalg import Array
from synergrip.problems.task_file import TaskTable
from synergrip.tasks.knots import MOVING_KNOTS
from synergrip.tasks.profiles import Rise

WAY = [
    {"time": "0.3 s", "position": ["0 mm", "0 mm", "10 mm"]},
    {"time": "0.75 s", "position": ["5 mm", "0 mm", "10 mm"], "rotation": ["0 deg", "90 deg", "0 deg"]},
    {"time": "2 s"},
]
TIMES = np.array([0.0, 0.3, 0.75, 2.0])
POSES = np.array([[0.0] * 6, [0, 0, 0.01, 0, 0, 0], [0.005, 0, 0.01, 0, np.pi / 2, 0], [0.0] * 6])
PROFILES = ["min-jerk", "cubic", "linear", "spline"]


def _loads(folder: Path, **keys: Any) -> Loads:
    return loads(TaskTable.model_validate(keys), folder, 0.0)


def _rates(found: Loads, times: Array, order: int, step: float, side: int = 0) -> Array:
    """Derivatives of the wanted motion by differences: central, or from one side."""
    shifts = {0: (-1, 0, 1), 1: (0, 1, 2), -1: (-2, -1, 0)}[side]
    a, b, c = (found.profiles.target_at(times + k * step) for k in shifts)
    if order == 2:
        return np.asarray((a - 2 * b + c) / step**2)
    first = {0: c - a, 1: 4 * b - 3 * a - c, -1: 3 * c - 4 * b + a}[side]
    return np.asarray(first / (2 * step))


@pytest.mark.parametrize("profile", PROFILES)
def test_the_object_is_at_every_waypoint_when_it_is_wanted_there(profile: str, tmp_path: Path) -> None:
    found = _loads(tmp_path, waypoint=WAY, profile=profile)
    assert (found.target.kind, found.target.key) == ("motion", "task.waypoint")
    assert found.profiles.target_at(TIMES) == pytest.approx(POSES, abs=1e-14)
    assert set(TIMES) <= set(found.times)  # at knots too
    at_knots = found.target.values[np.isin(found.times, TIMES)]
    assert at_knots == pytest.approx(POSES, abs=1e-14)


@pytest.mark.parametrize("profile", ["min-jerk", "cubic"])
def test_between_two_waypoints_the_motion_is_the_course_of_a_move(profile: Any, tmp_path: Path) -> None:
    found = _loads(tmp_path, waypoint=WAY, profile=profile)
    times = np.linspace(0.3, 0.75, 30)
    gone = Rise(profile, 0.3, 0.75).at(times)[:, None]
    assert found.profiles.target_at(times) == pytest.approx(POSES[1] + gone * (POSES[2] - POSES[1]), abs=1e-15)


@pytest.mark.parametrize(("profile", "order"), [("min-jerk", 1), ("min-jerk", 2), ("cubic", 1)])
def test_the_object_rests_at_every_waypoint(profile: str, order: int, tmp_path: Path) -> None:
    found = _loads(tmp_path, waypoint=WAY, profile=profile)
    largest = np.abs(_rates(found, np.linspace(0.1, 1.9, 50), order, 1e-4)).max()
    for side in (-1, 1):
        assert np.abs(_rates(found, TIMES, order, 1e-5, side)).max() < 1e-3 * largest


def test_a_linear_way_is_the_straight_line_from_one_to_the_next(tmp_path: Path) -> None:
    found = _loads(tmp_path, waypoint=WAY, profile="linear")
    times = np.linspace(0, 2, 57)
    expected = np.column_stack([np.interp(times, TIMES, column) for column in POSES.T])
    assert found.profiles.target_at(times) == pytest.approx(expected, abs=1e-15)


def test_a_spline_is_twice_differentiable_and_at_rest_at_its_ends(tmp_path: Path) -> None:
    found = _loads(tmp_path, waypoint=WAY, profile="spline")
    inner, step = TIMES[1:-1], 1e-4
    for order, close in ((1, 1e-5), (2, 1e-2)):
        before, after = (_rates(found, inner, order, step, side) for side in (-1, 1))
        assert np.abs(before).max() > 0.01  # it does not rest there
        assert before == pytest.approx(after, abs=close * np.abs(before).max())
    assert np.abs(_rates(found, np.zeros(1), 1, step, 1)).max() < 1e-5
    assert np.abs(_rates(found, np.array([2.0]), 1, step, -1)).max() < 1e-5


def test_a_spline_to_a_single_waypoint_is_the_cubic_course(tmp_path: Path) -> None:
    """The one cubic from rest to rest."""
    way = [{"time": "0.8 s", "position": ["1 m", "0 m", "-2 m"]}]
    spline, cubic = (_loads(tmp_path, waypoint=way, profile=name).target.values for name in ("spline", "cubic"))
    assert spline == pytest.approx(cubic, abs=1e-14)
    assert spline[20] == pytest.approx([0.5, 0, -1, 0, 0, 0])


@pytest.mark.parametrize("profile", PROFILES)
def test_after_the_last_waypoint_the_object_stays(profile: str, tmp_path: Path) -> None:
    way = WAY[:2]
    found = _loads(tmp_path, waypoint=way, profile=profile, duration="1 s")
    assert found.times[-1] == 1.0
    assert found.target.values[found.times >= 0.75] == pytest.approx(np.tile(POSES[2], (11, 1)), abs=1e-14)


def test_the_last_waypoint_ends_the_task_unless_the_duration_is_given(tmp_path: Path) -> None:
    assert _loads(tmp_path, waypoint=WAY).times[-1] == 2.0
    assert _loads(tmp_path, waypoint=WAY, duration="3 s").times[-1] == 3.0
    assert _loads(tmp_path, waypoint=WAY, knots=41).times == pytest.approx(np.linspace(0, 2, 41))


def test_there_are_knots_between_the_waypoints(tmp_path: Path) -> None:
    times = _loads(tmp_path, waypoint=WAY).times
    assert len(times) >= MOVING_KNOTS
    assert np.diff(times).max() <= 2.0 / (MOVING_KNOTS - 1) + 1e-12
    assert np.diff(times).min() > 0.8 * np.diff(times).max()


def test_waypoints_along_modes(tmp_path: Path) -> None:
    way = [{"time": "1 s", "modes": ["5 mm", "-1 mm"]}, {"time": "2 s", "modes": ["0 mm", "2 mm"]}]
    found = _loads(tmp_path, waypoint=way)
    assert found.target.kind == "mode moves"
    asked = found.profiles.target_at(np.array([0.0, 1.0, 1.5, 2.0]))
    assert asked == pytest.approx(np.array([[0, 0], [0.005, -0.001], [0.0025, 0.0005], [0, 0.002]]))


def test_a_wrench_file_and_waypoints_share_their_knots(tmp_path: Path) -> None:
    header = "t_s,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm"
    lines = [f"{t},{t},0,0,0,0,0" for t in (-1, 0, 0.31, 5)]
    (tmp_path / "w.csv").write_text("\n".join([header, *lines]) + "\n", encoding="utf-8")
    found = _loads(tmp_path, waypoint=WAY, wrench="w.csv", duration="2 s")
    assert {0.0, 0.3, 0.31, 0.75, 2.0} <= set(found.times)
    assert found.times[0] == 0.0
    assert found.wrench is not None
    assert found.wrench[:, 0] == pytest.approx(found.times)


def test_given_knots_may_not_pass_over_a_waypoint(tmp_path: Path) -> None:
    with pytest.raises(InputError) as caught:
        _loads(tmp_path, waypoint=WAY, knots=5)
    assert [issue.key for issue in caught.value.issues] == ["task.waypoint[0].time", "task.waypoint[1].time"]
    assert "the waypoint at 0.3 s is not on a knot" in caught.value.issues[0].message
    assert "0.5 s apart; leave out task.knots" in caught.value.issues[0].message
