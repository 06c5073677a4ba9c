"""Courses in time, moves of the object and turns of gravity, against what they are by definition."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from synergrip.errors import InputError
from synergrip.linalg import Array
from synergrip.problems.loads import move_of, palm_of, task_of
from synergrip.problems.motion_tables import MoveTable, PalmTable
from synergrip.problems.task_file import TaskTable
from synergrip.tasks.moves import Moves
from synergrip.tasks.profiles import PROFILES, Rise
from synergrip.tasks.stated import Setting

TIMES = np.linspace(0.0, 2.0, 401)


def rise(name: Any, times: Array) -> Array:
    """The profile over all of these times."""
    return Rise(name, float(times[0]), float(times[-1])).at(times)


def turned(gravity: Array, palm: PalmTable, times: Array) -> Array:
    return palm_of(palm).motion(float(times[0]), float(times[-1])).seen(gravity, times)


def _palm(**keys: Any) -> PalmTable:
    return PalmTable.model_validate(keys)


def _at(wanted: Moves, times: Array) -> Array:
    return wanted.over(Setting(float(times[0]), float(times[-1]))).at(times)


def _moves(*tables: dict[str, Any]) -> tuple[MoveTable, ...]:
    return tuple(MoveTable.model_validate(table) for table in tables)


def _moved(*tables: dict[str, Any]) -> Moves:
    return Moves(tuple(map(move_of, _moves(*tables))))


@pytest.mark.parametrize("name", list(PROFILES))
def test_every_profile_runs_from_0_to_1_and_never_back(name: str) -> None:
    profile = rise(name, TIMES)
    assert profile[0] == 0
    assert profile[-1] == pytest.approx(1, abs=1e-14)
    assert profile[200] == pytest.approx(0.5, abs=1e-14)  # halfway in half the time
    assert np.all(np.diff(profile) > 0)


@pytest.mark.parametrize(("name", "order"), [("cubic", 1), ("min-jerk", 2)])
def test_smooth_profiles_begin_and_end_at_rest(name: str, order: int) -> None:
    """The profile near an end grows with a higher power of time than its derivatives that vanish there."""
    for step in (1e-2, 1e-3):
        profile = rise(name, np.array([0.0, step, 2 * step, 1 - 2 * step, 1 - step, 1.0]))
        start, end = profile[:3], 1 - profile[:2:-1]
        for values in (start, end):
            for k in range(1, order + 1):
                derivative = np.diff(values[: k + 1], n=k)[0] / step**k
                assert abs(derivative) < 60 * step  # goes to zero with the step
    linear = rise("linear", np.array([0.0, 1e-3, 1.0]))
    assert linear[1] / 1e-3 == pytest.approx(1)


@pytest.mark.parametrize("name", list(PROFILES))
@pytest.mark.parametrize("derivative", [1, 2])
def test_derivatives_of_a_course_are_those_of_central_differences(name: Any, derivative: int) -> None:
    profile, step = Rise(name, -1.0, 3.0), 1e-4
    times = np.linspace(-0.9, 2.9, 20)
    below, here, above = (profile.at(times + shift) for shift in (-step, 0.0, step))
    expected = (above - below) / (2 * step) if derivative == 1 else (above - 2 * here + below) / step**2
    assert profile.at(times, derivative) == pytest.approx(expected, abs=1e-6)


@pytest.mark.parametrize("name", list(PROFILES))
def test_a_course_is_at_rest_before_and_after(name: Any) -> None:
    profile, outside = Rise(name, 1.0, 2.0), np.array([0.0, 0.9, 2.1, 7.0])
    assert profile.at(outside).tolist() == [0, 0, 1, 1]
    assert not profile.at(outside, 1).any()
    assert not profile.at(outside, 2).any()


def test_at_its_ends_a_course_has_the_acceleration_from_inside() -> None:
    """The cubic profile starts and stops with 6 / T^2."""
    assert Rise("cubic", 1.0, 3.0).at(np.array([1.0, 3.0]), 2) == pytest.approx([1.5, -1.5])


@pytest.mark.parametrize("name", list(PROFILES))
def test_a_profile_depends_on_the_share_of_the_time_that_has_passed(name: str) -> None:
    assert rise(name, 3.0 + 0.5 * TIMES) == pytest.approx(rise(name, TIMES), abs=1e-12)
    assert rise(name, np.array([0.7])) == pytest.approx([1.0])


def test_min_jerk_is_the_default() -> None:
    default = _moved({"axis": "x", "lift": "1 m"})
    assert _at(default, TIMES)[:, 0] == pytest.approx(rise("min-jerk", TIMES))


@pytest.mark.parametrize("name", list(PROFILES))
def test_gravity_turns_the_other_way_than_the_palm(name: str) -> None:
    axis, gravity = np.array([1.0, -2.0, 0.5]), np.array([1.0, 2.0, -9.0])
    found = turned(gravity, _palm(axis=axis.tolist(), turn="130 deg", profile=name), TIMES)
    unit = axis / np.linalg.norm(axis)
    for share, value in zip(rise(name, TIMES), found, strict=True):
        palm_in_world = Rotation.from_rotvec(np.radians(130) * share * unit)
        assert value == pytest.approx(palm_in_world.inv().apply(gravity), abs=1e-12)


def test_a_palm_that_turns_over_hangs_the_object_from_the_fingers() -> None:
    found = turned(np.array([0, 0, -9.81]), _palm(axis="x", turn="180 deg"), np.array([0.0, 1.0, 2.0]))
    assert found == pytest.approx(np.array([[0, 0, -9.81], [0, -9.81, 0], [0, 0, 9.81]]), abs=1e-12)


def test_moves_along_axes_add_up() -> None:
    wanted = _moved(
        {"axis": "z", "lift": "10 mm", "profile": "linear"},
        {"axis": [0, 3, 4], "lift": "5 mm", "roll": "90 deg", "profile": "cubic"},
    )
    assert wanted.kind == "motion"
    linear, cubic = rise("linear", TIMES), rise("cubic", TIMES)
    expected = np.outer(linear, [0, 0, 0.01, 0, 0, 0])
    expected += np.outer(cubic, [0, 0.003, 0.004, 0, 0.6 * np.pi / 2, 0.8 * np.pi / 2])
    assert _at(wanted, TIMES) == pytest.approx(expected, abs=1e-15)


def test_moves_along_modes_fill_their_columns_and_add_up() -> None:
    wanted = _moved(
        {"mode": 3, "amplitude": "2 mm", "profile": "linear"},
        {"mode": 1, "amplitude": "-1 mm", "profile": "cubic"},
        {"mode": 3, "amplitude": "1 mm", "profile": "linear"},
    )
    assert wanted.kind == "mode moves"
    expected = np.column_stack([-0.001 * rise("cubic", TIMES), np.zeros(len(TIMES)), 0.003 * rise("linear", TIMES)])
    assert _at(wanted, TIMES) == pytest.approx(expected, abs=1e-15)


@pytest.mark.parametrize("turned_round", [False, True])
def test_moves_along_axes_and_modes_do_not_mix(turned_round: bool) -> None:
    moves = _moves({"axis": "z", "lift": "1 mm"}, {"mode": 1, "amplitude": "1 mm"})
    table = TaskTable(move=moves[::-1] if turned_round else moves)
    with pytest.raises(InputError) as caught:
        task_of(table, Path())
    assert caught.value.issues[0].key == "task.move"
    assert "cannot be mixed" in caught.value.issues[0].message
