"""The motion of the palm and the load by inertia, against differences of where things are in the world."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from task_tables import Loads, loads

from synergrip.errors import InputError
from synergrip.grasps.objects import Box, Cylinder, Object, Shape, Sphere, Turned, turn
from synergrip.linalg import Array, frozen
from synergrip.problems.loads import palm_of
from synergrip.problems.motion_tables import PalmTable
from synergrip.problems.task_file import TaskTable
from synergrip.tasks.profiles import Rise

AXIS = np.array([1.0, -2.0, 0.5]) / np.linalg.norm([1.0, -2.0, 0.5])
SHIFT = np.array([0.3, -0.1, 0.2])
CENTRE = np.array([0.02, -0.05, 0.11])
PALM = {"axis": AXIS.tolist(), "turn": "130 deg", "shift": [f"{x} m" for x in SHIFT], "inertia": True}
TIMES = np.linspace(0.05, 0.75, 8)
BOX = Turned(Box((0.02, 0.06, 0.15)), turn(tuple(AXIS[::-1]), 0.7))


def _thing(mass: float = 0.4, shape: Shape | None = None) -> Object:
    return Object(title="thing", mass=mass, position=frozen(CENTRE), shape=shape)


def _loads(body: Object | None, mass: float = 0.4, **keys: Any) -> Loads:
    task = TaskTable.model_validate({"duration": "0.8 s", **keys})
    return loads(task, Path(), mass if body is None else body.mass, body)


def _load(found: Loads, times: Array) -> Array:
    wrench = found.profiles.load_at(times)
    assert wrench is not None
    return wrench


def _placed(name: Any, time: float) -> tuple[Rotation, Array]:
    """Orientation and origin of the palm in the world: from the profile alone, by other means than the program's."""
    share = Rise(name, 0.0, 0.8).at(np.array([time]))[0]
    return Rotation.from_rotvec(np.radians(130) * share * AXIS), share * SHIFT


def _second_difference(position: Any, time: float, step: float = 1e-3) -> Array:
    """Fourth order."""
    weights = {-2: -1, -1: 16, 0: -30, 1: 16, 2: -1}
    return np.asarray(sum(w * position(time + k * step) for k, w in weights.items()) / (12 * step**2))


@pytest.mark.parametrize("name", ["min-jerk", "cubic"])
def test_the_acceleration_of_a_point_of_the_palm_is_that_of_its_way_through_the_world(name: Any) -> None:
    motion = palm_of(PalmTable.model_validate({**PALM, "profile": name})).motion(0.0, 0.8)
    found = motion.acceleration(CENTRE, TIMES)

    def position(time: float) -> Array:
        rotation, origin = _placed(name, time)
        return origin + rotation.apply(CENTRE)

    for time, value in zip(TIMES, found, strict=True):
        expected = _placed(name, time)[0].inv().apply(_second_difference(position, time))
        assert value == pytest.approx(expected, rel=1e-6, abs=1e-6)


@pytest.mark.parametrize("name", ["min-jerk", "cubic"])
def test_force_and_moment_are_the_rates_of_momentum(name: Any) -> None:
    """Newton and Euler in the world: f = -m p'', m = -dL/dt, L = R I R' omega; seen from the palm."""
    body = _thing(shape=BOX)
    tensor = body.mass * BOX.inertia
    wrench = _load(_loads(body, palm={**PALM, "profile": name}), TIMES)

    def angular_momentum(time: float) -> Array:
        step = 1e-5
        ahead, here, behind = (_placed(name, time + k * step)[0] for k in (1, 0, -1))
        omega = (ahead * behind.inv()).as_rotvec() / (2 * step)
        return np.asarray(here.as_matrix() @ tensor @ here.as_matrix().T @ omega)

    for time, found in zip(TIMES, wrench, strict=True):
        step, seen = 1e-4, _placed(name, time)[0].inv()
        rate = (angular_momentum(time + step) - angular_momentum(time - step)) / (2 * step)
        force = -body.mass * _second_difference(lambda t: _placed(name, t)[1] + _placed(name, t)[0].apply(CENTRE), time)
        assert found[:3] == pytest.approx(seen.apply(force), rel=1e-5, abs=1e-5)
        assert found[3:] == pytest.approx(seen.apply(-rate), abs=1e-4 * np.abs(wrench[:, 3:]).max())
    assert np.abs(wrench[:, 3:]).max() > 1e-3


def test_a_shift_alone_gives_minus_mass_times_acceleration_in_closed_form() -> None:
    """min-jerk: s'' = (60 x - 180 x^2 + 120 x^3) / T^2; nothing depends on where the object is."""
    palm = {"shift": ["0.3 m", "0 m", "0 m"], "inertia": True}
    times = np.linspace(0, 0.8, 9)
    x = times / 0.8
    expected = np.zeros((9, 6))
    expected[:, 0] = -0.4 * 0.3 * (60 * x - 180 * x**2 + 120 * x**3) / 0.64
    assert _load(_loads(_thing(), palm=palm), times) == pytest.approx(expected, abs=1e-12)
    assert _load(_loads(None, palm=palm), times) == pytest.approx(expected, abs=1e-12)


def test_a_palm_that_swings_presses_the_object_outward() -> None:
    """At the middle of a min-jerk turn by 2 rad in 1 s: omega = 1.875 * 2, no tangential force."""
    body = Object(title="thing", mass=0.5, position=frozen([0.0, 0.2, 0.0]), shape=None)
    palm = {"axis": "z", "turn": "2 rad", "inertia": True}
    wrench = _load(_loads(body, palm=palm, duration="1 s"), np.array([0.5]))
    assert wrench == pytest.approx(np.array([[0, 0.5 * 3.75**2 * 0.2, 0, 0, 0, 0]]), abs=1e-12)


def test_weight_and_inertia_add_up_and_inertia_is_off_unless_asked_for() -> None:
    turning = {"axis": "y", "turn": "90 deg"}
    weight = _load(_loads(_thing(), palm=turning, gravity=[0, 0, -10]), TIMES)
    inertia = _load(_loads(_thing(), palm={**turning, "inertia": True}), TIMES)
    both = _load(_loads(_thing(), palm={**turning, "inertia": True}, gravity=[0, 0, -10]), TIMES)
    assert np.linalg.norm(weight[:, :3], axis=1) == pytest.approx(np.full(8, 4.0))
    assert both == pytest.approx(weight + inertia)
    assert np.abs(inertia).max() > 0.01


def test_an_object_in_free_fall_has_no_load() -> None:
    """The palm starts to fall with g: m (g - a) = 0 at the first knot, and the double weight when it is caught."""
    fall = 9.81 * 0.8**2 / 6  # cubic: s''(0) = 6 / T^2
    palm = {"shift": ["0 m", "0 m", f"{-fall} m"], "profile": "cubic", "inertia": True}
    wrench = _loads(_thing(), palm=palm, gravity=[0, 0, -9.81]).wrench
    assert wrench is not None
    assert wrench[0] == pytest.approx(np.zeros(6), abs=1e-12)
    assert wrench[-1, 2] == pytest.approx(-2 * 0.4 * 9.81)


@pytest.mark.parametrize("shape", [Sphere(0.03), Box((0.02, 0.06, 0.15)), Cylinder(0.03, 0.1), BOX])
def test_tensors_are_the_second_moments_of_points_inside(shape: Shape) -> None:
    """On a grid of points, told inside by the surface of the shape."""
    line = (np.arange(40) + 0.5) / 40 * 0.2 - 0.1
    points = np.array(
        [p for p in np.stack(np.meshgrid(line, line, line), -1).reshape(-1, 3) if shape.surface(p)[0] < 0]
    )
    expected = np.mean((points**2).sum(axis=1)) * np.eye(3) - points.T @ points / len(points)
    assert shape.inertia == pytest.approx(expected, abs=0.05 * np.trace(expected))
    assert np.trace(shape.inertia) == pytest.approx(np.trace(expected), rel=0.02)


def test_without_a_shape_the_object_is_a_point_mass() -> None:
    assert not _load(_loads(_thing(), palm=PALM), TIMES)[:, 3:].any()


@pytest.mark.parametrize(
    ("mass", "keys", "fragment"),
    [
        (0.0, {}, "inertia needs the mass of the object"),
        (1e99, {"duration": "1e-3 s"}, "is too large; check task.duration"),
    ],
)
def test_inertia_that_cannot_be_is_refused(mass: float, keys: dict[str, Any], fragment: str) -> None:
    with pytest.raises(InputError) as caught:
        _loads(_thing(mass), palm=PALM, **keys)
    (issue,) = caught.value.issues
    assert issue.key == "task.palm.inertia"
    assert fragment in issue.message


def test_a_palm_needs_time_to_move(tmp_path: Path) -> None:
    (tmp_path / "w.csv").write_text("t_s,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm\n0,0,0,0,0,0,0\n", encoding="utf-8")
    task = TaskTable.model_validate({"palm": PALM, "wrench": "w.csv"})
    with pytest.raises(InputError) as caught:
        loads(task, tmp_path, 1.0, _thing())
    assert [issue.key for issue in caught.value.issues] == ["task.palm.inertia"]
