"""Plans of many tasks judged as physics: what breaks a limit, a margin or the equilibrium does not hold."""

from __future__ import annotations

import numpy as np
import pytest
from random_cone_problems import grasp_like, random_wrenches

import synergrip as sg
from synergrip.batch import numpy_kernel
from synergrip.batch.asked import asked
from synergrip.batch.assembly import assembled
from synergrip.batch.decided import OF_MARGIN
from synergrip.batch.physical import judged
from synergrip.batch.stated import stated_on

GRASP = grasp_like(np.random.default_rng(0), ["hard", "soft", "hard"])
LIMITS = {
    "normal force": sg.NormalForce(upper=4.0),
    "joint torque": sg.JointTorque(0.3),
    "actuator effort": sg.ActuatorEffort(0.3),
    "synergy reference": sg.SynergyReference(0.4),
    "joint range": sg.JointRange(start=0.0, lower=-0.4, upper=0.4),
}


@pytest.mark.parametrize("name", LIMITS)
def test_a_squeeze_beyond_the_limit_that_stopped_it_does_not_hold(name: str) -> None:
    wrench = random_wrenches(np.random.default_rng(1), 12, 0.2)
    task = sg.Task(knots=1, limits=[LIMITS[name]], goals=[sg.LargestMargin()])
    programs = assembled(stated_on(sg.analyse(GRASP), asked(GRASP, task, wrench, None, None).task, wrench, None))
    found = numpy_kernel.solve(programs.largest_margin(), OF_MARGIN, np.full(12, -np.inf))
    assert found.x[:, -1].min() > 0  # where contacts pull, margins are told otherwise
    v, margin = found.x[:, :-1], found.x[:, -1] * programs.unit
    right = judged(programs, v, margin, wrench)
    assert right.holds.all()
    assert np.allclose(right.margins.min(axis=1), margin, atol=1e-6)
    assert not judged(programs, 1.01 * v, margin - 100.0, wrench).holds.any()
    assert judged(programs, 0.99 * v, margin - 100.0, wrench).holds.all()
    assert not judged(programs, v, margin + 1e-3, wrench).holds.any()
    for axis in range(6):
        assert not judged(programs, v, margin, wrench + 1e-5 * np.eye(6)[axis]).holds.any()
    assert not judged(programs, np.nan * v, margin, wrench).holds.any()


BOTH_SIDES = {"normal force": sg.NormalForce(lower=0.1, upper=4.0)}


@pytest.mark.parametrize("name", LIMITS)
def test_rows_that_are_said_to_be_opposite_are(name: str) -> None:
    """Lower and upper bounds; those of normal forces may be in different units, and are none."""
    wrench = random_wrenches(np.random.default_rng(2), 4)
    limits = [BOTH_SIDES.get(name, LIMITS[name]), sg.JointTorque(np.append(np.inf, np.full(8, 0.3)))]
    task = sg.Task(knots=1, limits=limits[: 1 + (name != "joint torque")], goals=[sg.LargestMargin()])
    programs = assembled(stated_on(sg.analyse(GRASP), asked(GRASP, task, wrench, None, None).task, wrench, None))
    expected = {"normal force": 8, "joint torque": 9, "actuator effort": 5 + 8, "synergy reference": 5 + 8}
    assert programs.pairs == expected.get(name, 9 + 8)
    for each in (programs.largest_margin(), programs.least_effort("contact", 0.0)[0], programs.least_peak(0.0)):
        first, second = each.A[:, : each.pairs], each.A[:, each.pairs : 2 * each.pairs]
        assert each.pairs == programs.pairs
        assert np.array_equal(first, -second)
        assert np.abs(first).max() > 0
