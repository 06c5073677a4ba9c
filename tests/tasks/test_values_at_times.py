"""Loads and targets have values at times, the ones that a task of that length gives them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import synergrip as sg

BALL = sg.Object(mass=0.2, shape=sg.Sphere(radius=0.05))
TIMES = np.linspace(0.0, 2.0, 5)
LOADS: dict[str, Any] = {
    "gravity": sg.Gravity((0, 1.0, -9.81)),
    "wrench": sg.Wrench((0, 0, -2.5, 0.1, 0, 0)),
    "table": sg.WrenchTable([0.0, 2.0], [[0, 0, -2, 0, 0, 0], [0, 0, -3, 0, 0, 0.1]]),
}


@pytest.mark.parametrize("name", LOADS)
def test_a_load_is_at_times_what_a_task_makes_of_it(name: str) -> None:
    hard = sg.HardFinger(friction=0.6)
    tips = [sg.ContactAt(f"finger{i}/tip", hard, stiffness=8e3) for i in (1, 2, 3)]
    grasp = sg.make_grasp("barrett", BALL, posture="ball", synergies="motors", contacts=tips)
    timed = sg.Task(duration=2.0, knots=5, loads=[LOADS[name]]).timed(grasp)
    assert LOADS[name].at(TIMES, object=BALL) == pytest.approx(timed.wrench, abs=1e-12)
    assert np.abs(timed.wrench).max() > 0.1


def test_a_wrench_needs_no_object_and_a_weight_does() -> None:
    assert LOADS["wrench"].at([0.0, 1.0]).tolist() == [[0, 0, -2.5, 0.1, 0, 0]] * 2
    assert LOADS["gravity"].at([0.0], object=BALL) == pytest.approx(np.array([[0, 0.2, -1.962, 0, 0, 0]]))
    with pytest.raises(sg.InputError, match=r"Gravity\.at: gravity needs the mass .* at\(times, object=Object\("):
        LOADS["gravity"].at([0.0])
    with pytest.raises(sg.InputError, match=r"Wrench\.at\.object: expected an Object"):
        LOADS["wrench"].at([0.0], object=0.2)


def test_a_move_ends_where_it_leads_and_holding_stays() -> None:
    lift = sg.Move(axis="z", lift=0.01).at(TIMES)
    assert lift.shape == (5, 6)
    assert lift[0] == pytest.approx(np.zeros(6))
    assert lift[-1] == pytest.approx([0, 0, 0.01, 0, 0, 0])
    assert not sg.Hold().at(TIMES).any()
