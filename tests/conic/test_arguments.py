"""Limits and goals judge themselves: numbers as a problem file has them, and an error that names the argument."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from random_formulations import LIMITS, random_formulation
from small_grasps import pinch

from synergrip.conic.goals.centred_joints import CentredJoints
from synergrip.conic.goals.goal import Goal
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.goals.least_motion import LeastMotion
from synergrip.conic.goals.least_peak import LeastPeak
from synergrip.conic.goals.registry import GOALS
from synergrip.conic.goals.weighted_sum import WeightedSum
from synergrip.conic.limits.actuator_effort import ActuatorEffort
from synergrip.conic.limits.elastic_motion import ElasticMotion
from synergrip.conic.limits.friction_reserve import FrictionReserve
from synergrip.conic.limits.joint_range import JointRange
from synergrip.conic.limits.joint_torque import JointTorque
from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.limits.object_error import ObjectError
from synergrip.conic.limits.slip_margin import SlipMargin
from synergrip.conic.limits.synergy_acceleration import SynergyAcceleration
from synergrip.conic.limits.synergy_rate import SynergyRate
from synergrip.conic.limits.synergy_reference import SynergyReference
from synergrip.errors import InputError
from synergrip.problems.problem import load_problem

nan, inf = float("nan"), float("inf")


def refusal(call: Callable[[], Any]) -> tuple[str, str]:
    with pytest.raises(InputError) as caught:
        call()
    return caught.value.issues[0].key, caught.value.issues[0].message


@pytest.mark.parametrize(
    ("call", "key", "fragment"),
    [
        (lambda: SlipMargin(-1), "SlipMargin.margin", "expected a slip margin in newtons of at least 0"),
        (lambda: SlipMargin(nan), "SlipMargin.margin", "got nan"),
        (lambda: SlipMargin(inf), "SlipMargin.margin", "got inf"),
        (lambda: SlipMargin("0.5 N"), "SlipMargin.margin", "got '0.5 N'"),
        (lambda: SlipMargin(True), "SlipMargin.margin", "got true"),
        (lambda: SlipMargin(np.ones(2)), "SlipMargin.margin", "got an array of shape (2,)"),
        (lambda: NormalForce(upper=-1.0), "NormalForce.upper", "a force in newtons of at least 0, or infinity for no"),
        (lambda: NormalForce(upper=nan), "NormalForce.upper", "got nan"),
        (lambda: NormalForce(lower=-2.0), "NormalForce.lower", "at least 0, or minus infinity for no bound, got -2.0"),
        (lambda: NormalForce(lower=inf), "NormalForce.lower", "got inf"),
        (lambda: NormalForce(lower=5.0, upper=1.0), "NormalForce.lower", "5 N is above the upper bound 1 N; swap them"),
        (lambda: NormalForce(upper=None), "NormalForce.upper", "got null"),
        (lambda: JointTorque(-np.ones(3)), "JointTorque.limit", "expected sizes greater than 0, got -1"),
        (lambda: JointTorque(0), "JointTorque.limit", "expected sizes greater than 0, got 0"),
        (lambda: JointTorque([1.0, nan]), "JointTorque.limit", "got nan; infinity stands for no bound"),
        (lambda: JointTorque("1 N m"), "JointTorque.limit", "expected a number, or one for each joint, got '1 N m'"),
        (lambda: JointTorque(None), "JointTorque.limit", "got null"),
        (lambda: JointTorque([[1.0]]), "JointTorque.limit", "got an array of shape (1, 1)"),
        (lambda: JointTorque([1.0, "a"]), "JointTorque.limit", "expected a number, or one for each joint, got a list"),
        (lambda: JointTorque({"a": 1}), "JointTorque.limit", "got a table"),
        (lambda: JointTorque([1, 2, 3]).on(pinch()), "JointTorque.limit", "8 numbers, one for each of the joints"),
        (lambda: JointTorque("hand").on(pinch()), "JointTorque.limit", "'hand' needs a hand; a grasp given as matric"),
        (lambda: ActuatorEffort([1, 2]).on(pinch()), "ActuatorEffort.limit", "expected 1 numbers, one for each of the"),
        (lambda: ActuatorEffort("hnad"), "ActuatorEffort.limit", "got 'hnad'"),
        (lambda: SynergyReference("hand"), "SynergyReference.limit", "got 'hand'"),
        (lambda: SynergyReference([1, 2]).on(pinch()), "SynergyReference.limit", "got 2"),
        (lambda: SynergyRate(-1), "SynergyRate.limit", "greater than 0, got -1"),
        (lambda: SynergyRate([1, 2]).on(pinch()), "SynergyRate.limit", "got 2"),
        (lambda: SynergyAcceleration([]).on(pinch()), "SynergyAcceleration.limit", "got an array of shape (0,)"),
        (lambda: JointRange().on(pinch()), "JointRange.start", "needs a hand with joint ranges; a grasp given as matr"),
        (lambda: JointRange(lower=0).on(pinch()), "JointRange.start", "give start and upper"),
        (lambda: JointRange(0, 1, -1), "JointRange.lower", "the lower bound 1 is above the upper bound -1; swap them"),
        (lambda: JointRange(0, [1, 5, 1], [2, 3, 2]), "JointRange.lower", "bound 5 is above the upper bound 3"),
        (lambda: JointRange(nan, -1, 1), "JointRange.start", "got nan"),
        (lambda: JointRange(inf, -1, 1), "JointRange.start", "expected finite numbers, got inf"),
        (lambda: JointRange(0, nan, 1), "JointRange.lower", "expected finite numbers or infinity, got nan"),
        (lambda: JointRange([0, 0], -1, 1).on(pinch()), "JointRange.start", "expected 8 numbers"),
        (lambda: ElasticMotion(0), "ElasticMotion.limit", "expected a length in metres greater than 0, got 0"),
        (lambda: ElasticMotion("1 mm"), "ElasticMotion.limit", "got '1 mm'"),
        (lambda: ObjectError(nan), "ObjectError.limit", "got nan"),
        (lambda: ObjectError(1e-3, axes=("x", "w")), "ObjectError.axes", "'w' is not one of 'x', 'y', 'z'"),
        (lambda: ObjectError(1e-3, axes=()), "ObjectError.axes", "expected one or more of x, y, z, rx, ry, rz, got"),
        (lambda: ObjectError(1e-3, part="al"), "ObjectError.part", "'al' is not one of 'whole' or 'rigid'"),
        (lambda: FrictionReserve(), "FrictionReserve", "expected one of factor, angle and ratios, got none of them"),
        (lambda: FrictionReserve(1.2, 0.1), "FrictionReserve", "got factor and angle"),
        (lambda: FrictionReserve(factor=0.9), "FrictionReserve.factor", "expected a factor of at least 1, got 0.9"),
        (lambda: FrictionReserve(angle=-0.1), "FrictionReserve.angle", "an angle in radians greater than 0, got -0.1"),
        (lambda: FrictionReserve(ratios=1.5), "FrictionReserve.ratios", "friction between 0 and 1, got 1.5"),
        (lambda: FrictionReserve(ratios=[1, 1, 1]).on(pinch()), "FrictionReserve.ratios", "one for each of the con"),
        (lambda: FrictionReserve(angle=1.5).on(pinch()), "FrictionReserve.angle", "deg wide; ask for less"),
        (lambda: LeastEffort("torqe"), "LeastEffort.of", "did you mean 'torque'?"),
        (lambda: LeastMotion(of="rate"), "LeastMotion.of", "did you mean 'rates'?"),
        (lambda: CentredJoints().on(pinch()), "CentredJoints.start", "needs a hand with joint ranges"),
        (lambda: CentredJoints(0, 1, -1), "CentredJoints.lower", "is above the upper bound"),
        (lambda: WeightedSum(()), "WeightedSum.goals", "expected pairs of a goal and its weight, got none"),
        (lambda: WeightedSum({LeastEffort(): 1}), "WeightedSum.goals", "got a table"),
        (lambda: WeightedSum((LeastEffort(),)), "WeightedSum.goals[0]", "expected a pair of a goal and its weight"),
        (lambda: WeightedSum((("effort", 1),)), "WeightedSum.goals[0]", "write for example WeightedSum((("),
        (lambda: WeightedSum(((LeastEffort(), 0),)), "WeightedSum.goals[0]", "a weight greater than 0, got 0"),
        (lambda: WeightedSum(((LeastPeak(), 1.0),)), "WeightedSum.goals[0]", "only sums of squares have weights"),
        (lambda: WeightedSum(((LargestMargin(), 1.0),)), "WeightedSum.goals[0]", "'largest margin' is no sum of squar"),
        (lambda: WeightedSum(((LeastEffort(), 1), (LeastEffort(), 2))), "WeightedSum.goals[1]", "is listed twice"),
    ],
)  # fmt: skip
def test_what_is_no_argument_is_refused_by_name(call: Callable[[], Any], key: str, fragment: str) -> None:
    found, message = refusal(call)
    assert found == key
    assert fragment in message


@pytest.mark.parametrize("kind", [JointTorque, ActuatorEffort, SynergyReference, SynergyRate, SynergyAcceleration])
def test_a_number_is_one_for_each(kind: Any) -> None:
    grasp = load_problem("barrett-ball-hold").grasp
    count = grasp.n_q if kind is JointTorque else grasp.n_z
    for number in (2, 2.0, np.float64(2), [2.0] * count, np.full(count, 2.0)):
        made = kind(number).on(grasp)
        assert made.limit.tolist() == [2.0] * count
        assert made.on(grasp) == made


def test_what_a_hand_states_is_filled_in_as_by_a_file() -> None:
    problem = load_problem(
        "barrett-ball-hold",
        ["limits.joint_torque=hand", "limits.joint_range=hand", "limits.margin_angle=2 deg", "limits.drift=1 mm"],
    )
    limits = {limit.key: limit for limit in problem.task.limits}
    own = [JointTorque("hand"), JointRange(), FrictionReserve(angle=np.radians(2)), ObjectError(1e-3)]
    for limit in own:
        assert limit.on(problem.grasp) == limits[limit.key]
    assert np.all(np.isfinite(limits["limits.joint_torque"].limit))  # type: ignore[attr-defined]


def test_a_friction_reserve_goes_by_the_friction_of_the_grasp_that_it_is_for() -> None:
    for mu in (0.3, 0.5, 0.9):
        angle, factor = FrictionReserve(angle=0.1).on(pinch(mu)), FrictionReserve(factor=1.25).on(pinch(mu))
        narrow = np.tan(np.arctan(mu) - 0.1) / mu
        assert angle.on(pinch(0.7)).on(pinch(mu)).used(pinch(mu)) == pytest.approx([narrow] * 2)
        assert factor.used(pinch(mu)) == pytest.approx([0.8] * 2)
        assert angle.loosened(0.5).loosened(0.5).used(pinch(mu)) == pytest.approx([1 - (1 - narrow) / 4] * 2)
    assert FrictionReserve(ratios=[0.5, 1.0]).on(pinch()).used(pinch()).tolist() == [0.5, 1.0]


@pytest.mark.parametrize("name", LIMITS)
def test_limits_compare_by_content_hash_and_pickle(name: str) -> None:
    _, formulation = random_formulation(0)
    grasp = formulation.response.grasp
    one, same = LIMITS[name](grasp), LIMITS[name](grasp)
    assert one == same
    assert hash(one) == hash(same)
    assert pickle.loads(pickle.dumps(one)) == one
    assert len(repr(one).splitlines()) <= 6
    others: list[Limit] = [LIMITS[other](grasp) for other in LIMITS if other != name]
    assert one not in others


@pytest.mark.parametrize("goal", [*GOALS.values(), WeightedSum(((LeastEffort(), 1.0), (CentredJoints(), 2.0)))])
def test_goals_compare_by_content_hash_and_pickle(goal: Goal) -> None:
    assert pickle.loads(pickle.dumps(goal)) == goal
    assert len({goal, pickle.loads(pickle.dumps(goal))}) == 1
    assert [each for each in GOALS.values() if each == goal] == [goal] * (not isinstance(goal, WeightedSum))
