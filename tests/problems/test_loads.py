"""Knots, wrench and wanted motion of a task, from the table and from CSV files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from task_tables import Loads, loads

from synergrip.errors import InputError
from synergrip.problems.task_file import TaskTable
from synergrip.tasks.knots import MOVING_KNOTS

WRENCH = "t_s,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm"
MOTION = "t_s,x_m,y_m,z_m,rx_rad,ry_rad,rz_rad"
LIFT = {"axis": "z", "lift": "10 mm"}


def _loads(folder: Path, mass: float = 0.0, **keys: Any) -> Loads:
    return loads(TaskTable.model_validate(keys), folder, mass)


def _csv(folder: Path, name: str, header: str, times: list[float], slope: float = 1.0) -> str:
    """A table whose column i is ``slope (i + 1) t`` between the lines."""
    count = header.count(",")
    lines = [",".join(str(x) for x in [t, *(slope * (i + 1) * t for i in range(count))]) for t in times]
    (folder / name).write_text("\n".join([header, *lines]) + "\n", encoding="utf-8")
    return name


@pytest.mark.parametrize(
    ("keys", "knots", "end"),
    [
        ({}, 1, 0.0),
        ({"duration": "3 s"}, 1, 0.0),
        ({"duration": "3 s", "knots": 7}, 7, 3.0),
        ({"knots": 5}, 5, 1.0),
        ({"move": [LIFT]}, MOVING_KNOTS, 1.0),
        ({"move": [LIFT], "duration": "4 s"}, MOVING_KNOTS, 4.0),
        ({"move": [LIFT], "knots": 2}, 2, 1.0),
        ({"gravity": [0, 0, -9.81], "palm": {"axis": "x", "turn": "1 rad"}}, MOVING_KNOTS, 1.0),
    ],
)
def test_knots_are_evenly_spaced_over_the_duration(
    keys: dict[str, Any], knots: int, end: float, tmp_path: Path
) -> None:
    times = _loads(tmp_path, mass=0.2, **keys).times
    assert times == pytest.approx(np.linspace(0, end, knots), abs=1e-15)
    assert not times.flags.writeable


def test_a_csv_file_brings_its_own_knots(tmp_path: Path) -> None:
    name = _csv(tmp_path, "w.csv", WRENCH, [0, 0.1, 0.5, 2.0])
    found = _loads(tmp_path, wrench=name)
    assert found.times.tolist() == [0, 0.1, 0.5, 2.0]
    assert found.wrench == pytest.approx(np.outer([0, 0.1, 0.5, 2.0], np.arange(1, 7)))


def test_two_csv_files_bring_the_knots_of_both(tmp_path: Path) -> None:
    wrench = _csv(tmp_path, "w.csv", WRENCH, [0, 0.1 + 0.2, 1.0])
    motion = _csv(tmp_path, "m.csv", MOTION, [0, 0.3, 0.6, 1.0 + 1e-13])
    found = _loads(tmp_path, wrench=wrench, motion=motion)
    assert found.times == pytest.approx([0, 0.3, 0.6, 1.0], abs=1e-12)  # 0.1 + 0.2 and 0.3 are one knot
    assert found.target.values[:, 5] == pytest.approx(6 * found.times)


def test_a_shorter_duration_cuts_a_csv_file_and_ends_on_a_knot(tmp_path: Path) -> None:
    name = _csv(tmp_path, "w.csv", WRENCH, [0, 0.3, 0.6, 0.9])
    found = _loads(tmp_path, wrench=name, duration="0.5 s")
    assert found.times.tolist() == [0, 0.3, 0.5]
    assert found.wrench is not None
    assert found.wrench[-1] == pytest.approx(0.5 * np.arange(1, 7))


def test_a_csv_file_is_resampled_at_given_knots(tmp_path: Path) -> None:
    (tmp_path / "w.csv").write_text(f"{WRENCH}\n0,0,0,0,0,0,0\n1,0,0,-4,0,0,0\n2,8,0,-4,0,0,0\n", encoding="utf-8")
    found = _loads(tmp_path, wrench="w.csv", duration="2 s", knots=5)
    assert found.times == pytest.approx([0, 0.5, 1, 1.5, 2])
    assert found.wrench is not None
    assert found.wrench[:, 2] == pytest.approx([0, -2, -4, -4, -4])
    assert found.wrench[:, 0] == pytest.approx([0, 0, 0, 4, 8])


@pytest.mark.parametrize(
    ("times", "keys"),
    [
        ([0, 1], {"duration": "2 s"}),
        ([0, 1], {"duration": "2 s", "knots": 3}),
        ([0.5, 2], {"duration": "2 s", "knots": 3}),
        ([0], {"duration": "1 s", "knots": 2}),
        ([5, 6], {"duration": "1 s"}),
        ([0, 1 - 1e-6], {"duration": "1 s"}),
    ],
)
@pytest.mark.parametrize(("key", "header"), [("wrench", WRENCH), ("motion", MOTION), ("modes", "t_s,beta_1")])
def test_a_csv_file_must_cover_the_task(
    key: str, header: str, times: list[float], keys: dict[str, Any], tmp_path: Path
) -> None:
    name = _csv(tmp_path, "table.csv", header, times, slope=0.1)
    with pytest.raises(InputError) as caught:
        _loads(tmp_path, **{key: name}, **keys)
    (issue,) = caught.value.issues
    assert issue.key == f"task.{key}"
    assert f"the table covers {times[0]:g} s to {times[-1]:g} s" in issue.message


def test_two_csv_files_must_both_cover_the_task(tmp_path: Path) -> None:
    wrench = _csv(tmp_path, "w.csv", WRENCH, [0, 0.5])
    motion = _csv(tmp_path, "m.csv", MOTION, [0, 1.0])
    with pytest.raises(InputError) as caught:
        _loads(tmp_path, wrench=wrench, motion=motion)
    assert caught.value.issues[0].key == "task.wrench"


def test_rounding_at_the_end_is_no_gap(tmp_path: Path) -> None:
    name = _csv(tmp_path, "w.csv", WRENCH, [0, 1 - 1e-12])
    assert len(_loads(tmp_path, wrench=name, duration="1 s", knots=4).times) == 4


def test_weight_and_wrench_add_up(tmp_path: Path) -> None:
    keys = {"gravity": [0, 0, -10], "knots": 3}
    weight, push = np.array([0, 0, -2.0, 0, 0, 0]), np.arange(1.0, 7)
    assert _loads(tmp_path, mass=0.2, **keys).wrench == pytest.approx(np.tile(weight, (3, 1)))
    constant = _loads(tmp_path, mass=0.2, wrench=push.tolist(), **keys).wrench
    assert constant == pytest.approx(np.tile(weight + push, (3, 1)))
    name = _csv(tmp_path, "w.csv", WRENCH, [0, 0.5, 1.0])
    profile = _loads(tmp_path, mass=0.2, wrench=name, **keys).wrench
    assert profile == pytest.approx(weight + np.outer([0, 0.5, 1], push))


def test_the_weight_turns_with_the_palm(tmp_path: Path) -> None:
    palm = {"axis": "y", "turn": "90 deg"}
    found = _loads(tmp_path, mass=0.5, gravity=[0, 0, -10], palm=palm, knots=2).wrench
    assert found == pytest.approx(np.array([[0, 0, -5, 0, 0, 0], [5, 0, 0, 0, 0, 0]]), abs=1e-12)


def test_nothing_said_of_the_load_is_not_the_same_as_no_load(tmp_path: Path) -> None:
    assert _loads(tmp_path).wrench is None
    zero = _loads(tmp_path, wrench=[0] * 6).wrench
    assert zero is not None
    assert not zero.any()


def test_the_wanted_motion_is_that_of_the_file_of_the_moves_or_to_hold_still(tmp_path: Path) -> None:
    motion = _loads(tmp_path, motion=_csv(tmp_path, "m.csv", MOTION, [0, 1])).target
    assert (motion.kind, motion.key, motion.values.shape) == ("motion", "task.motion", (2, 6))
    modes = _loads(tmp_path, modes=_csv(tmp_path, "b.csv", "t_s,beta_1,beta_2", [0, 1, 2])).target
    assert (modes.kind, modes.key, modes.values.tolist()) == ("modes", "task.modes", [[0, 0], [1, 2], [2, 4]])
    moves = _loads(tmp_path, move=[LIFT], knots=2).target
    assert moves.values == pytest.approx(np.array([[0] * 6, [0, 0, 0.01, 0, 0, 0]]))
    still = _loads(tmp_path, knots=4).target
    assert (still.kind, still.values.shape) == ("hold", (4, 0))


def test_a_missing_file_is_refused_at_its_key(tmp_path: Path) -> None:
    with pytest.raises(InputError) as caught:
        _loads(tmp_path, motion="nowhere.csv")
    assert caught.value.issues[0].key == "task.motion"
    assert "nowhere.csv" in caught.value.issues[0].message


def test_two_broken_files_are_both_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError) as caught:
        _loads(tmp_path, motion="nowhere.csv", wrench="neither.csv")
    assert [issue.key for issue in caught.value.issues] == ["task.wrench", "task.motion"]


def test_several_knots_need_time(tmp_path: Path) -> None:
    name = _csv(tmp_path, "w.csv", WRENCH, [0])
    with pytest.raises(InputError) as caught:
        _loads(tmp_path, wrench=name, knots=5)
    assert caught.value.issues[0].key == "task.knots"
    assert "no time for 5 knots: the task begins at 0 s and ends at 0 s" in caught.value.issues[0].message
