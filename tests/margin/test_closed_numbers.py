"""Numbers of `margins` that pencil and paper, or the literature, give to the digit."""

from __future__ import annotations

import math

import numpy as np
import pytest
from driven_grasp import nose_cone
from small_grasps import pinch, tripod

import synergrip as sg
from synergrip.conic.goals.goal import Goal
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.goals.least_peak import LeastPeak
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import frozen
from synergrip.margin.direct_number import DirectNumber
from synergrip.margin.found import Margins
from synergrip.margin.margins import margins
from synergrip.problems.problem import load_problem
from synergrip.tasks.timed_task import TimedTask, still

MU, NU, CAP = 0.5, 0.005, 20.0
WEIGHT, MOMENT, BELOW = 3.0, 0.02, 0.3


def asked(wrench: list[float], goal: Goal, *, cap: float | None = CAP) -> TimedTask:
    """Hold a load at one instant."""
    time = frozen([0.0])
    limits = () if cap is None else (NormalForce(upper=cap),)
    return TimedTask(time, frozen([wrench]), still(time), 0.0, limits, (goal,))


def found(grasp: Grasp, task: TimedTask | sg.Task, name: str) -> tuple[Margins, DirectNumber]:
    answer = margins(grasp, task, only=[name])
    assert isinstance(answer, Margins)
    return answer, answer.direct[name]


DOWN = [0.0, 0.0, -WEIGHT, 0.0, 0.0, 0.0]
ON_A_BALL = 3 * (math.sin(BELOW) + MU * math.cos(BELOW))
"""What three fingers below the equator carry for each newton that they press with: W / 3 = n sin + t cos."""
PEAKS = {
    "antipodal pinch": (pinch(MU, NU), DOWN, WEIGHT / (2 * MU)),
    "spin of two soft fingers": (pinch(MU, NU), [0.0, 0.0, 0.0, MOMENT, 0.0, 0.0], MOMENT / (2 * NU)),
    "tripod": (tripod(MU), DOWN, WEIGHT / (3 * MU)),
    "sphere from below": (tripod(MU, BELOW), DOWN, WEIGHT / ON_A_BALL),
}


@pytest.mark.parametrize("name", PEAKS)
def test_the_least_grip_and_the_largest_load_are_those_of_the_formula(name: str) -> None:
    grasp, wrench, least = PEAKS[name]
    for number, closed in (("least_peak_N", least), ("load_factor", CAP / least)):
        direct = found(grasp, asked(wrench, LeastPeak()), number)[1]
        assert direct.value == pytest.approx(closed, rel=1e-4)
        assert direct.lower is not None
        assert direct.upper is not None
        assert direct.lower <= closed <= direct.upper
        assert direct.proven


def test_a_gripper_that_lifts_fast_grips_as_hard_as_its_formula() -> None:
    """S m (g + a) / (2 mu): 1 kg, twice the load, 0.2 m up in 0.5 s, at the true equilibria of the hand.

    The largest acceleration of a minimum-jerk rise is 10 / sqrt(3) times the way through the time squared, when
    1/2 - sqrt(3)/6 of the time has passed; of 72 knots the 16th is there to 3e-4 of it.
    """
    mass, share, way, time = 1.0, 2.0, 0.2, 0.5
    closed = share * mass * (9.81 + 10 / math.sqrt(3) * way / time**2) / (2 * MU)
    assert closed == pytest.approx(28.8576, abs=5e-5)
    problem = load_problem("gripper-box", [
        f"object.mass={mass} kg", 'object.position=["0 mm", "0 mm", "120 mm"]', f"contacts.friction={MU}",
        f'task.palm={{axis="x", turn="0 deg", shift=["0 mm", "0 mm", "{way} m"], inertia=true}}', "task.move=[]",
        f"task.duration={time} s", "task.knots=72", f"task.load_factor={share}", "task.between=report",
        'limits={margin="0 N", normal_force="100 N"}', 'goal={minimise="peak_force"}',
    ])  # fmt: skip
    answer, number = found(problem.grasp, problem.task, "least_peak_N")
    normal = answer.plan.forces[:, problem.grasp.normal_rows]
    assert normal.max() == pytest.approx(28.8576, abs=5e-5)
    assert int(np.argmax(normal.max(axis=1))) == 15
    assert number.value == pytest.approx(28.8576, rel=5e-5)
    assert number.lower is not None
    assert number.upper is not None
    assert number.lower <= closed <= number.upper


def test_the_nose_cone_keeps_the_margin_of_its_model() -> None:
    """Lobo, Vandenberghe, Boyd and Lebret (1998), the numbers of the AMPL model; nothing but the load bounds it."""
    answer, number = found(
        nose_cone(), asked([0.0, 0.0, -1.0, 0.0, 0.0, 0.0], LargestMargin(), cap=None), "load_factor"
    )
    assert answer.plan.largest_margin == pytest.approx(0.0247526, abs=5e-8)
    assert answer.measures["slip margin"].worst.value == pytest.approx(0.0247526, abs=1e-7)
    assert number.value is None  # forces grow with the load
    peak = found(nose_cone(), asked([0.0, 0.0, -1.0, 0.0, 0.0, 0.0], LeastPeak()), "least_peak_N")[1]
    assert peak.value == pytest.approx(0.491089, rel=1e-4)
