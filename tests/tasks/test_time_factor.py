"""A task at another pace: what scales with it by physics, what does not, and how fast it may go in closed form."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import synergrip as sg
from synergrip.linalg import Array
from synergrip.margin.direct_number import DirectNumber

PATH_TIMES = np.linspace(0.2, 1.0, 41)
SHARE = (PATH_TIMES - 0.2) / 0.8
GONE = 10 * SHARE**3 - 15 * SHARE**4 + 6 * SHARE**5
LIFT = np.outer(GONE, [0, 0, 0.2, 0, 0, 0])
SWING = np.outer(GONE, [0.3, -0.1, 0.2, 0.7, -1.1, 0.4])
BALL = sg.Object(mass=0.4, shape=sg.Box((0.02, 0.06, 0.15)), position=(0.02, -0.05, 0.11))
GRAVITY = sg.Gravity((1.0, -2.0, -9.0))


def wrench(*loads: Any, factor: float, **more: Any) -> Array:
    """The load at the knots of a task on a box, (T, 6)."""
    grasp = sg.load_problem("gripper-box").grasp.replace(mass=BALL.mass)
    task = sg.Task(loads=[GRAVITY, *loads], time_factor=factor, **more)
    return task.timed(grasp).wrench


@pytest.mark.parametrize("factor", [0.5, 3.0])
@pytest.mark.parametrize("way", ["path", "turn and shift"])
def test_inertia_goes_by_the_square_of_the_pace_and_weight_stays(way: str, factor: float) -> None:
    def palm(inertia: bool) -> sg.Palm | sg.PalmPath:
        if way == "path":
            return sg.PalmPath(PATH_TIMES, SWING, inertia=inertia)
        shift = (0.1, 0.2, 0.3) if inertia else None
        return sg.Palm(axis=(1, 2, -1), turn=2.0, shift=shift, inertia=inertia)

    count = {} if way == "path" else {"knots": 17}
    weight, whole = (wrench(palm(inertia), factor=1.0, **count) for inertia in (False, True))
    found = wrench(palm(True), factor=factor, **count)
    assert np.abs(whole - weight).max() > 0.5
    np.testing.assert_allclose(found, weight + (whole - weight) / factor**2, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize(
    ("target", "duration"),
    [
        (sg.Move(axis="z", lift=0.01), 1.0),
        (sg.Waypoints(times=[0.5, 2.0], positions=[[0, 0, 0.01], [0.001, 0, 0]], profile="spline"), 2.0),
        (sg.MotionTable([0.0, 0.4, 1.5], np.outer([0, 1, 2], [0, 0, 0.01, 0, 0, 0])), 1.5),
        (sg.Hold(), 1.0),
    ],
    ids=["move", "waypoints", "table", "hold"],
)
def test_a_motion_goes_through_the_same_places_at_another_pace(target: Any, duration: float) -> None:
    grasp, count = sg.load_problem("gripper-box").grasp, 9 if isinstance(target, sg.Waypoints) else 16
    once, slow = (sg.Task(target=target, knots=count, time_factor=f).timed(grasp) for f in (1.0, 2.5))
    assert once.times[-1] == pytest.approx(duration)
    np.testing.assert_allclose(slow.times, 2.5 * once.times)
    np.testing.assert_allclose(slow.target.values, once.target.values, atol=1e-12)
    stated = sg.Task(duration=2.0, knots=3, target=sg.Hold(), time_factor=0.25).timed(grasp)
    assert stated.times[-1] == pytest.approx(0.5)


@pytest.mark.parametrize(
    "load",
    [
        sg.WrenchTable([0.0, 1.0], np.ones((2, 6))),
        sg.Push(force=1.0, direction="z", start=0.2, end=0.4),
    ],
    ids=["table", "push"],
)
def test_a_load_with_times_of_its_own_is_refused(load: Any) -> None:
    grasp = sg.load_problem("gripper-box").grasp
    task = sg.Task(loads=[GRAVITY, load], time_factor=2.0)
    with pytest.raises(sg.InputError, match="times of its own") as caught:
        task.timed(grasp)
    assert caught.value.issues[0].key == "Task.loads[1]"
    assert task.replace(time_factor=1.0).timed(grasp).times[-1] == 1.0
    lasting = sg.Push(force=1.0, direction="z")
    assert sg.Task(loads=[GRAVITY, lasting], knots=3, time_factor=2.0).timed(grasp).times[-1] == 2.0


def test_a_factor_that_is_none_or_too_small_is_refused_at_its_place() -> None:
    with pytest.raises(sg.InputError, match="greater than 0") as caught:
        sg.load_problem("gripper-box", ["task.time_factor=0"])
    assert caught.value.issues[0].key == "task.time_factor"
    task = sg.Task(loads=[GRAVITY, sg.PalmPath(PATH_TIMES, LIFT)], time_factor=1e-5)
    with pytest.raises(sg.InputError, match="1 us apart") as caught:
        task.timed(sg.load_problem("gripper-box").grasp)
    assert caught.value.issues[0].key == "Task.loads[1]"


def duration(grasp: sg.Grasp, task: sg.Task) -> DirectNumber:
    found = sg.margins(grasp, task, only=["shortest_duration_s"])
    assert isinstance(found, sg.Margins)
    return found.direct["shortest_duration_s"]


def test_how_fast_a_lift_along_a_path_may_be_is_its_closed_form() -> None:
    """All that the jaws hold is m (g + a), a = a_1 / factor^2, and what they have to press is so many times that."""
    grasp = sg.load_problem("gripper-box").grasp
    down, path = sg.Gravity((0, 0, -9.81)), sg.PalmPath(PATH_TIMES, LIFT, inertia=True)
    still = sg.Task(loads=[down], linearise="once")
    resting = sg.margins(grasp, still, only=["least_peak_N"])
    assert isinstance(resting, sg.Margins)
    rest = resting.direct["least_peak_N"].value
    assert rest is not None
    task = sg.Task(loads=[down, path], limits=[sg.NormalForce(upper=2.0 * rest)], linearise="once")
    weight = 9.81 * grasp.held.body.mass  # type: ignore[union-attr]
    peak = -task.timed(grasp).wrench[:, 2].min() / weight - 1  # of a_1 / g
    factor = np.sqrt(peak / (2.0 - 1.0))
    number = duration(grasp, task)
    assert not number.proven  # faster still there might be a plan again
    assert number.value == pytest.approx(0.8 * factor, rel=2e-3)
    assert number.setting.startswith("task.time_factor=")
    assert float(number.setting.split("=")[1]) == pytest.approx(factor, rel=2e-3)
    assert number.upper == number.value >= 0.8 * factor
    slower, faster = (task.replace(time_factor=share * factor) for share in (1.003, 0.997))
    assert isinstance(sg.plan(grasp, slower), sg.Plan)
    assert isinstance(sg.plan(grasp, faster), sg.Infeasible)
    # the same of a task that has a factor already, and of one whose time is its duration
    again = duration(grasp, task.replace(time_factor=1.7))
    assert again.value is not None  # 99.9 % of the way there are tried on a hand
    assert again.value - 0.8 * factor < 1.1e-3 * (1.7 - factor) * 0.8
    assert float(again.setting.split("=")[1]) == pytest.approx(again.value / 0.8, rel=1e-9)
    palm = sg.Palm(shift=(0, 0, 0.2), inertia=True)
    stated = sg.Task(duration=2.0, loads=[down, palm], limits=task.limits, linearise="once", time_factor=2.0)
    number = duration(grasp, stated)
    assert number.setting.startswith("task.duration=")
    assert number.value is not None
    typed = float(number.setting.split('"')[1].split()[0])
    assert typed == pytest.approx(number.value / 2.0, rel=1e-9)
    assert isinstance(sg.plan(grasp, stated.replace(duration=typed)), sg.Plan)
    assert not isinstance(sg.plan(grasp, stated.replace(duration=0.98 * typed)), sg.Plan)
