"""A path of the palm as a file of a problem: its part in start, end and knots, and what is wrong with it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from palm_paths import AXIS, GRAVITY, SHIFT, load_at, path_loads, wobble, write_path
from scipy.spatial.transform import Rotation

from synergrip.documents.time_table import MOTION
from synergrip.errors import InputError
from synergrip.tasks.knots import MOVING_KNOTS


def test_what_counts_is_the_motion_from_the_start_of_the_task(tmp_path: Path) -> None:
    """A task that begins within the file: gravity is given in the palm frame of that instant."""
    times, positions, rotations = wobble(31)
    write_path(tmp_path, times - times[10], positions, rotations.as_rotvec())
    found = path_loads(tmp_path, inertia=False, gravity=GRAVITY, knots=5)
    assert found.times[0] == 0
    assert found.wrench is not None
    assert found.wrench[0, :3] == pytest.approx(0.4 * np.array(GRAVITY), abs=1e-12)
    expected = (rotations[-1].inv() * rotations[10]).apply(0.4 * np.array(GRAVITY))
    assert found.wrench[-1, :3] == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("inertia", [True, False])
def test_lines_are_knots_and_there_are_others_between_them(inertia: bool, tmp_path: Path) -> None:
    """A path bends between its lines. Alone it says when the task begins and ends."""
    lines = np.array([5.0, 5.1, 5.35, 5.6, 6.0])
    write_path(tmp_path, lines, np.outer(lines**2, SHIFT), np.outer(lines, AXIS))
    times = path_loads(tmp_path, inertia=inertia, gravity=GRAVITY).times
    assert times[[0, -1]].tolist() == [5, 6]
    assert np.all(np.abs(times[:, None] - lines).min(axis=0) < 1e-12)
    assert np.diff(times).max() <= 1 / (MOVING_KNOTS - 1) + 1e-12
    assert (
        path_loads(tmp_path, inertia=inertia, gravity=GRAVITY, push=[{"force": "1 N", "direction": "x"}]).times[0] == 5
    )


def test_a_quarter_turn_from_line_to_line_is_no_more_than_that(tmp_path: Path) -> None:
    for axis in np.vstack([np.eye(3), AXIS]):
        write_path(tmp_path, np.arange(9.0), np.zeros((9, 3)), np.outer(np.pi / 2 * np.arange(9), axis))
        assert path_loads(tmp_path).times[-1] == 8


def test_two_lines_are_enough_for_gravity(tmp_path: Path) -> None:
    write_path(tmp_path, np.array([0.0, 1.0]), np.zeros((2, 3)), np.outer([0.0, 1.0], AXIS))
    found = load_at(path_loads(tmp_path, inertia=False, gravity=GRAVITY), np.array([0.5]))
    assert found[0, :3] == pytest.approx(Rotation.from_rotvec(-0.5 * AXIS).apply(0.4 * np.array(GRAVITY)), abs=1e-12)


LINES = np.linspace(0, 1, 6)


@pytest.mark.parametrize(
    ("times", "turns", "keys", "fragment"),
    [
        ([0.0], [0], {"inertia": False}, "a path takes at least 2 lines of a pose each, got 1"),
        ([0, 0.5, 1], [0, 0, 0], {}, "accelerations, which take at least 4 lines of a pose each, got 3"),
        ([0, 0.4, 0.4 + 1e-7, 1], [0] * 4, {}, "at least 1 us apart; after 0.4 s it is 0.1 us"),
        (LINES, [0, 0.1, 0.2, 2.0, 2.1, 2.2], {}, "turns by 103 deg from 0.4 s to 0.6 s, and which way is not clear"),
        (LINES, LINES, {"duration": "2 s"}, "the table covers 0 s to 1 s, the task 0 s to 2 s"),
        (LINES + 0.5, LINES, {"knots": 7}, "the table covers 0.5 s to 1.5 s, the task 0 s to 1.5 s"),
    ],
)
def test_a_path_that_does_not_tell_the_motion_is_refused(
    times: Any, turns: Any, keys: dict[str, Any], fragment: str, tmp_path: Path
) -> None:
    write_path(tmp_path, np.array(times), np.zeros((len(times), 3)), np.outer(turns, AXIS))
    with pytest.raises(InputError) as caught:
        path_loads(tmp_path, **{"gravity": GRAVITY, **keys})
    (issue,) = caught.value.issues
    assert issue.key == "task.palm.path"
    assert fragment in issue.message


def test_files_that_are_missing_or_broken_are_told_together(tmp_path: Path) -> None:
    (tmp_path / "palm.csv").write_text(f"t_s,{','.join(MOTION[:5])}\n0,0,0,0,0,0\n", encoding="utf-8")
    for path, fragment in (("gone.csv", "gone.csv"), ("palm.csv", "missing column 'rz_rad'")):
        with pytest.raises(InputError) as caught:
            path_loads(tmp_path, path, wrench="neither.csv")
        assert [issue.key for issue in caught.value.issues] == ["task.wrench", "task.palm.path"]
        assert fragment in caught.value.issues[1].message


def test_a_jump_beyond_all_numbers_is_refused_wherever_it_is(tmp_path: Path) -> None:
    """One line of 2001 is far away; the load is that large for a few lines only, between all evenly spaced looks."""
    times, positions = np.linspace(0, 1, 2001), np.zeros((2001, 3))
    positions[1015, 1] = 1e98
    write_path(tmp_path, times, positions, np.zeros((2001, 3)))
    with pytest.raises(InputError) as caught:
        path_loads(tmp_path)
    assert [issue.key for issue in caught.value.issues] == ["task.palm.inertia"]
    assert "is too large; check task.duration" in caught.value.issues[0].message
