"""The palm on a path from a file: against motions known in closed form, in any frame, and against differences."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from palm_paths import (
    AXIS,
    BOX,
    CENTRE,
    FRAME,
    GRAVITY,
    SHIFT,
    TIMES,
    TURN,
    load_at,
    path_loads,
    thing_of,
    wobble,
    write_path,
)
from scipy.spatial.transform import Rotation
from task_tables import loads

from synergrip.documents.time_table import MOTION, read_table
from synergrip.files import bundled
from synergrip.grasps.objects import Sphere
from synergrip.linalg import Array
from synergrip.problems.task_file import TaskTable
from synergrip.tasks.palm_path import PalmSpline, spline
from synergrip.tasks.profiles import Rise


def _course(folder: Path, name: Any, count: int) -> None:
    """Write down the motion of axis, turn and shift in another frame."""
    times = np.linspace(0.0, 0.8, count)
    share = Rise(name, 0.0, 0.8).at(times)
    rotations = FRAME[0] * Rotation.from_rotvec(TURN * np.outer(share, AXIS))
    write_path(folder, times, FRAME[0].apply(np.outer(share, SHIFT)) + FRAME[1], rotations.as_rotvec())


def _course_load(name: Any, **keys: Any) -> Array:
    """The load of the same motion, from axis, turn and shift."""
    palm = {"axis": AXIS.tolist(), "turn": f"{TURN} rad", "shift": [f"{x} m" for x in SHIFT], "profile": name}
    task = TaskTable.model_validate({"duration": "0.8 s", "palm": {**palm, "inertia": True}, **keys})
    return load_at(loads(task, Path(), thing_of().mass, thing_of()))


def _path(times: Array, positions: Array, rotations: Rotation) -> PalmSpline:
    return spline(times, np.hstack([positions, rotations.as_rotvec()]), float(times[0]), float(times[-1]))


@pytest.mark.parametrize("name", ["min-jerk", "cubic"])
def test_a_dense_path_loads_the_object_as_the_motion_it_was_taken_from(name: Any, tmp_path: Path) -> None:
    """At both ends, too, where a cubic profile starts with a jump; the error falls with the square of the spacing."""
    expected, errors = _course_load(name), []
    for count in (21, 41, 81, 161):
        _course(tmp_path, name, count)
        errors.append(np.abs(load_at(path_loads(tmp_path)) - expected).max(axis=0) / np.abs(expected).max(axis=0))
    falls = np.array(errors[:-1]) / np.array(errors[1:])
    assert np.all(falls > 3.3), falls
    assert np.all(np.array(errors[-1]) < 4e-3), errors[-1]


def test_gravity_turns_with_a_path_as_with_the_motion_it_was_taken_from(tmp_path: Path) -> None:
    """Of fourth order in the spacing."""
    expected = _course_load("min-jerk", gravity=GRAVITY) - _course_load("min-jerk")
    errors = []
    for count in (21, 41, 81):
        _course(tmp_path, "min-jerk", count)
        found = load_at(path_loads(tmp_path, inertia=False, gravity=GRAVITY))
        errors.append(np.abs(found - expected)[:, :3].max() / np.linalg.norm(expected[0]))
    assert errors[1] < errors[0] / 10
    assert errors[2] < errors[1] / 10
    assert errors[2] < 1e-6


def test_a_palm_on_a_circle_presses_the_object_outward(tmp_path: Path) -> None:
    """At a constant rate about z: m omega^2 r in the palm frame, and the moment -omega x I omega."""
    times, rate, radius = np.linspace(0.0, 0.8, 401), 3.0, np.array([0.5, 0.0, 0.0])
    spin = Rotation.from_rotvec(np.outer(rate * times, [0, 0, 1]))
    write_path(tmp_path, times, spin.apply(radius), spin.as_rotvec())
    omega, tensor = np.array([0, 0, rate]), 0.4 * BOX.inertia
    expected = [*(0.4 * rate**2 * (radius + CENTRE)[:2]), 0, *-np.cross(omega, tensor @ omega)]
    assert load_at(path_loads(tmp_path)) == pytest.approx(np.tile(expected, (len(TIMES), 1)), abs=6e-5)


@pytest.mark.parametrize("spinning", [False, True])
def test_an_object_in_free_fall_has_no_load(spinning: bool, tmp_path: Path) -> None:
    """Its centre falls with g, thrown, in a frame where the palm is not upright, and the palm may turn about it."""
    times, down = np.linspace(0.0, 0.8, 81), FRAME[0].apply(GRAVITY)
    rotations = FRAME[0] * Rotation.from_rotvec(np.outer(2.0 * times * spinning, AXIS))
    centre = np.outer(times, [1.0, 0.5, 3.0]) + 0.5 * np.outer(times**2, down)
    write_path(tmp_path, times, centre - rotations.apply(CENTRE), rotations.as_rotvec())
    found = load_at(path_loads(tmp_path, body=thing_of(Sphere(0.05)), gravity=GRAVITY))
    assert found == pytest.approx(np.zeros((len(TIMES), 6)), abs=1e-4 if spinning else 1e-10)
    assert np.abs(load_at(path_loads(tmp_path, inertia=False, gravity=GRAVITY))).max() > 1


def test_the_frame_of_the_file_does_not_matter(tmp_path: Path) -> None:
    times, positions, rotations = wobble(31)
    write_path(tmp_path, times, positions, rotations.as_rotvec())
    here = load_at(path_loads(tmp_path, gravity=GRAVITY))
    write_path(tmp_path, times, FRAME[0].apply(positions) + FRAME[1], (FRAME[0] * rotations).as_rotvec())
    assert load_at(path_loads(tmp_path, gravity=GRAVITY)) == pytest.approx(here, abs=1e-11)
    assert np.ptp(here, axis=0).min() > 1e-3


def test_a_rotation_vector_may_jump_by_whole_turns(tmp_path: Path) -> None:
    times, positions, rotations = wobble(31)
    vectors = rotations.as_rotvec()
    write_path(tmp_path, times, positions, vectors)
    straight = load_at(path_loads(tmp_path))
    units = vectors / np.linalg.norm(vectors, axis=1, keepdims=True)
    turns = 2 * np.pi * np.random.default_rng(2).integers(-1, 3, (31, 1))
    write_path(tmp_path, times, positions, vectors + turns * units)
    assert load_at(path_loads(tmp_path)) == pytest.approx(straight, abs=1e-10)


def test_rates_and_accelerations_are_those_of_central_differences() -> None:
    """Of the rotation that `seen` stands for: R' R_0; the angular ones in the palm frame."""
    times, positions, rotations = wobble(12)
    palm, step = _path(times, positions, rotations), 1e-4
    inner = np.linspace(0.05, 0.75, 40)

    def placed(at: Array) -> Rotation:
        columns = np.stack([palm.seen(column, at) for column in np.eye(3)], axis=2)
        return rotations[0] * Rotation.from_matrix(columns).inv()

    omega, alpha = palm.rotation_rates(inner)
    behind, ahead = inner - step, inner + step
    assert omega == pytest.approx((placed(behind).inv() * placed(ahead)).as_rotvec() / (2 * step), abs=1e-5)
    differences = (palm.rotation_rates(ahead)[0] - palm.rotation_rates(behind)[0]) / (2 * step)
    assert alpha == pytest.approx(differences, abs=2e-2)  # it has corners at the lines
    point = [palm.poses(at)[:, :3] + placed(at).apply(CENTRE) for at in (behind, inner, ahead)]
    second = placed(inner).inv().apply((point[0] - 2 * point[1] + point[2]) / step**2)
    assert palm.acceleration(CENTRE, inner) == pytest.approx(second, abs=2e-2)
    assert min(np.abs(alpha).max(), np.abs(second).max()) > 5


def test_a_path_goes_through_its_lines() -> None:
    times, positions, rotations = wobble(12)
    expected = (rotations.inv() * rotations[0]).apply(GRAVITY)
    assert _path(times, positions, rotations).seen(np.array(GRAVITY), times) == pytest.approx(expected, abs=1e-12)


def test_the_bundled_path_is_the_formula_that_it_states() -> None:
    """The comment of the file, by the letter; and the load at any time is that of the formula."""
    table = read_table(bundled("problems") / "barrett-ball-arm.csv", MOTION)

    def poses(times: Array) -> tuple[Array, Rotation]:
        p, q = (Rise("min-jerk", start, start + 1).at(times) for start in (0.0, 0.5))
        r, a = 0.4 + 0.3 * p, 1.2 * q
        swing, tilt = (Rotation.from_rotvec(np.outer(x, e)) for x, e in ((a, [0, 0, 1]), (0.9 * q, [0, 1, 0])))
        return np.column_stack([r * np.cos(a), r * np.sin(a), np.full(len(a), 0.5)]), swing * tilt

    positions, rotations = poses(table.times)
    assert table.values == pytest.approx(np.hstack([positions, rotations.as_rotvec()]), abs=1e-10)
    times, step = np.linspace(0.01, 1.49, 200), 1e-4
    behind, here, ahead = (poses(times + shift) for shift in (-step, 0.0, step))
    second = here[1].inv().apply((behind[0] - 2 * here[0] + ahead[0]) / step**2)
    found = spline(table.times, table.values, 0.0, 1.5).acceleration(np.zeros(3), times)
    assert found == pytest.approx(second, abs=0.02 * np.abs(second).max())
