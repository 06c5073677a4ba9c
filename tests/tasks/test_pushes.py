"""Pushes: their wrench, their profile in time, and the knots they bring."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from task_tables import Loads, loads

from synergrip.errors import InputError
from synergrip.linalg import Array
from synergrip.problems.task_file import TaskTable

PUSH = {"force": "3 N", "direction": [0, 3, -4], "at": ["10 mm", "-20 mm", "5 cm"]}
FORCE = np.array([0, 1.8, -2.4])
WRENCH = np.concatenate([FORCE, np.cross([0.01, -0.02, 0.05], FORCE)])


def _loads(*pushes: dict[str, Any], mass: float = 0.0, **keys: Any) -> Loads:
    return loads(TaskTable.model_validate({"push": pushes, **keys}), Path(), mass)


def _share(found: Loads, times: Any) -> Array:
    """The share of the full force at some times."""
    wrench = found.profiles.load_at(np.asarray(times, dtype=float))
    assert wrench is not None
    share = np.asarray(wrench @ WRENCH / (WRENCH @ WRENCH))
    assert wrench == pytest.approx(np.outer(share, WRENCH), abs=1e-12)
    return share


def test_the_moment_of_a_push_is_that_of_its_force_about_b() -> None:
    """r x F by its components, and no moment when it acts at B or along the line to B."""
    found = _loads(PUSH).wrench
    assert found is not None
    assert found[0, :3] == pytest.approx(FORCE)
    x, y, z, (_, fy, fz) = 0.01, -0.02, 0.05, FORCE
    assert found[0, 3:] == pytest.approx([y * fz - z * fy, -x * fz, x * fy])
    for at in (["0 m", "0 m", "0 m"], ["0 m", "-6 mm", "8 mm"]):
        through = _loads({**PUSH, "at": at}).wrench
        assert through is not None
        assert through[0, 3:] == pytest.approx(np.zeros(3), abs=1e-15)


def test_a_push_that_lasts_is_a_constant_wrench_at_one_knot() -> None:
    found = _loads(PUSH)
    assert found.times.tolist() == [0.0]
    assert _share(found, [0, 0.3, 1]) == pytest.approx(np.ones(3))


def test_a_step_is_on_from_its_start_to_its_end() -> None:
    found = _loads({**PUSH, "start": "0.2 s", "end": "0.7 s"})
    assert _share(found, [0, 0.199, 0.2, 0.45, 0.7, 0.701, 1]).tolist() == pytest.approx([0, 0, 1, 1, 1, 0, 0])
    assert {0.0, 0.2, 0.7, 1.0} <= set(found.times)


def test_a_trapezoid_rises_and_falls_in_straight_lines() -> None:
    found = _loads({**PUSH, "start": "0.107 s", "end": "0.893 s", "profile": "trapezoid", "ramp": "0.23 s"})
    times = np.linspace(0, 1, 101)
    expected = np.interp(times, [0.107, 0.337, 0.663, 0.893], [0, 1, 1, 0])
    assert _share(found, times) == pytest.approx(expected, abs=1e-12)
    for corner in (0.107, 0.337, 0.663, 0.893):
        assert np.abs(found.times - corner).min() < 1e-12
    assert found.wrench is not None
    linear = np.interp(times, found.times, found.wrench[:, 1])
    assert linear == pytest.approx(1.8 * expected, abs=1e-12)  # the knots tell all of it


def test_a_half_sine_is_told_by_its_knots_to_half_a_percent() -> None:
    """However short it is; its momentum is 2 / pi of force times time."""
    found = _loads({**PUSH, "start": "0.41 s", "end": "0.44 s", "profile": "half-sine"})
    times = np.linspace(0.4, 0.45, 5001)
    share = _share(found, times)
    assert share.max() == pytest.approx(1)
    assert share[(times < 0.41) | (times > 0.44)] == pytest.approx(0)
    assert np.trapezoid(share, times) == pytest.approx(0.03 * 2 / np.pi, rel=1e-5)
    assert found.wrench is not None
    missed = share - np.interp(times, found.times, found.wrench[:, 1] / 1.8)
    assert missed.min() > -1e-12
    assert 1e-4 < missed.max() < 0.005


def test_pushes_weight_and_wrench_add_up() -> None:
    other = {"force": "1 N", "direction": "x", "start": "0.5 s"}
    found = _loads(PUSH, other, mass=0.2, gravity=[0, 0, -10], wrench=[1, 2, 3, 4, 5, 6])
    constant = WRENCH + np.array([0, 0, -2, 0, 0, 0]) + np.arange(1, 7)
    wrench = found.profiles.load_at(np.array([0.0, 0.4, 0.5, 1.0]))
    assert wrench is not None
    assert wrench[:2] == pytest.approx(np.tile(constant, (2, 1)))
    assert wrench[2:] == pytest.approx(np.tile(constant + np.array([1, 0, 0, 0, 0, 0]), (2, 1)))


def test_between_the_knots_the_profiles_are_those_at_the_knots() -> None:
    found = _loads(
        {**PUSH, "start": "0.13 s", "profile": "half-sine"}, mass=0.3, gravity=[0, 0, -10],
        palm={"axis": "x", "turn": "1 rad"}, move=[{"axis": "z", "lift": "1 mm"}],
    )  # fmt: skip
    assert found.profiles.load_at(found.times) == pytest.approx(found.wrench, abs=0)
    assert found.profiles.target_at(found.times) == pytest.approx(found.target.values, abs=0)
    fine = np.linspace(0, 1, 1000)
    assert found.profiles.target_at(fine).shape == (1000, 6)
    assert found.wrench is not None
    linear = np.column_stack([np.interp(fine, found.times, column) for column in found.wrench.T])
    assert 1e-5 < np.abs(found.profiles.load_at(fine) - linear).max() < 0.02


def test_nothing_said_of_the_load_is_not_the_same_as_no_push() -> None:
    assert _loads().profiles.load_at(np.zeros(2)) is None
    none = _loads({**PUSH, "force": "0 N"}).profiles.load_at(np.zeros(2))
    assert none is not None
    assert none.shape == (2, 6)
    assert not none.any()


@pytest.mark.parametrize(
    ("push", "keys", "key", "fragment"),
    [
        ({"end": "2 s"}, {}, "end", "the push ends at 2 s, after the task, which ends at 1 s"),
        ({"start": "0.5 s", "end": "0.5 s"}, {}, "end", "begins at 0.5 s and must end later, not at 0.5 s"),
        ({"start": "1 s"}, {}, "start", "begins at 1 s and must end later"),
        ({"profile": "trapezoid", "ramp": "0.6 s"}, {}, "ramp", "two ramps of 0.6 s do not fit into a push of 1 s"),
        ({"start": "0.41 s"}, {"knots": 5}, "start", "the start at 0.41 s is not on a knot"),
        ({"end": "0.41 s"}, {"knots": 5}, "end", "the knots are 0.25 s apart; leave out task.knots"),
        ({"start": "0.4 s"}, {"knots": 5}, "start", "and there will be one, or take 6 knots"),
        ({"start": "0.4 s"}, {"knots": 9}, "start", "and there will be one, or take 6 or 11 knots"),
        ({"start": "0.4001 s"}, {"knots": 5}, "start", "and there will be one"),
        ({"profile": "trapezoid", "ramp": "0.1 s"}, {"knots": 5}, "ramp", "a ramp corner at 0.1 s is not on a knot"),
        ({"profile": "half-sine"}, {"knots": 4}, "profile", "the peak at 0.5 s is not on a knot"),
    ],
)
def test_a_push_that_does_not_fit_is_refused(
    push: dict[str, Any], keys: dict[str, Any], key: str, fragment: str
) -> None:
    with pytest.raises(InputError) as caught:
        _loads(PUSH, {**PUSH, **push}, **keys)
    (issue,) = caught.value.issues
    assert issue.key == f"task.push[1].{key}"
    assert fragment in issue.message


def test_two_pushes_that_do_not_fit_are_both_refused() -> None:
    with pytest.raises(InputError) as caught:
        _loads({**PUSH, "end": "2 s"}, {**PUSH, "end": "3 s"})
    assert [issue.key for issue in caught.value.issues] == ["task.push[0].end", "task.push[1].end"]


def test_knots_on_the_corners_are_accepted() -> None:
    found = _loads({**PUSH, "start": "0.1 s", "end": "0.7 s", "profile": "trapezoid", "ramp": "0.2 s"}, knots=11)
    assert found.wrench is not None
    assert found.wrench[:, 1] == pytest.approx(1.8 * np.array([0, 0, 0.5, 1, 1, 1, 0.5, 0, 0, 0, 0]), abs=1e-12)
