"""Posture, compliance and limits of a problem in the units of its joints: one that slides, one that turns."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from synergrip.conic.limits.actuator_effort import ActuatorEffort
from synergrip.conic.limits.joint_range import JointRange
from synergrip.conic.limits.joint_torque import JointTorque
from synergrip.errors import InputError
from synergrip.problems.problem import Problem, load_problem

TWO = """<robot name="r">
  <link name="palm"/><link name="left"/><link name="right"/>
  <joint name="push" type="prismatic">
    <parent link="palm"/><child link="left"/><axis xyz="0 1 0"/><limit lower="0" upper="0.05"/>
  </joint>
  <joint name="turn" type="{kind}">
    <parent link="palm"/><child link="right"/><axis xyz="{axis}"/><limit lower="-0.05" upper="0.05"/>
  </joint>
</robot>
"""
PROBLEM = """schema = 1
[hand]
model = "two.urdf"
posture = {{ push = "5 mm", turn = "{turn}" }}
[object]
shape = {{ sphere = {{ radius = "10 mm" }} }}
mass = "100 g"
position = ["0 mm", "5 mm", "80 mm"]
[contacts]
model = "soft"
friction = 0.6
spin_friction = "5 mm"
stiffness = "8 N/mm"
spin_stiffness = "2 N m/rad"
[[contact]]
name = "L"
link = "left"
point = ["0 mm", "-10 mm", "80 mm"]
[[contact]]
name = "R"
link = "right"
point = ["0 mm", "{right} mm", "80 mm"]
[task]
gravity = [0, 0, -9.81]
[limits]
normal_force = "30 N"
joint_range = "hand"
"""
MIXED = ("revolute", "1 0 0", "0 deg", 15)
SLIDES = ("prismatic", "0 1 0", "5 mm", 10)


@pytest.fixture
def place(tmp_path: Path, request: pytest.FixtureRequest) -> Path:
    kind, axis, turn, right = getattr(request, "param", MIXED)
    (tmp_path / "two.urdf").write_text(TWO.format(kind=kind, axis=axis))
    (tmp_path / "two.toml").write_text(PROBLEM.format(turn=turn, right=right))
    return tmp_path / "two.toml"


def torque(problem: Problem) -> JointTorque:
    (limit,) = (limit for limit in problem.timed.limits if isinstance(limit, JointTorque))
    return limit


def test_each_joint_has_its_own_units(place: Path) -> None:
    problem = load_problem(
        place,
        [
            "hand.compliance.joint=['0.1 mm/N', '0.02 rad/(N m)']",
            "limits.joint_torque=['3 N', '2 N m']",
            "limits.actuator_effort=['4 N', 5]",
        ],
    )
    assert problem.held is not None
    np.testing.assert_array_equal(problem.held.q, [0.005, 0.0])
    np.testing.assert_allclose(np.diag(problem.grasp.C_q), [1e-4, 0.02])
    np.testing.assert_array_equal(torque(problem).limit, [3, 2])
    assert torque(problem).unit(problem.grasp) == ""
    (effort,) = (limit for limit in problem.timed.limits if isinstance(limit, ActuatorEffort))
    np.testing.assert_array_equal(effort.limit, [4, 5])


@pytest.mark.parametrize("place", [SLIDES], indirect=True)
def test_slides_have_lengths_and_forces(place: Path) -> None:
    problem = load_problem(place, ["hand.compliance.joint=0.1 mm/N", "limits.joint_torque=3 N"])
    np.testing.assert_allclose(np.diag(problem.grasp.C_q), [1e-4, 1e-4])
    np.testing.assert_array_equal(torque(problem).limit, [3, 3])
    assert torque(problem).unit(problem.grasp) == "N"
    assert [limit.unit(problem.grasp) for limit in problem.timed.limits if isinstance(limit, JointRange)] == ["m"]


@pytest.mark.parametrize(
    ("override", "found"),
    [
        ("hand.posture={push='1 deg', turn='1 mm'}", {"hand.posture.push": "slides", "hand.posture.turn": "turns"}),
        ("hand.compliance.joint=0.1 mm/N", {"hand.compliance.joint": "'turn' turns"}),
        ("hand.compliance.joint=0.1 rad/(N m)", {"hand.compliance.joint": "'push' slides"}),
        (
            "hand.compliance.joint=['0.1 rad/(N m)', '0.1 mm/N']",
            {"hand.compliance.joint[0]": "a slide compliance", "hand.compliance.joint[1]": "a joint compliance"},
        ),
        ("limits.joint_torque=3 N", {"limits.joint_torque": "'turn' turns: write a torque"}),
        ("limits.joint_torque=[1, '3 N']", {"limits.joint_torque[1]": "'turn' turns: write a torque"}),
        ("limits.joint_torque=['3 N m', 1]", {"limits.joint_torque[0]": "'push' slides: write a force"}),
        ("limits.actuator_effort=['3 N m', '3 N m']", {"limits.actuator_effort[0]": "slide: write a force"}),
    ],
)
def test_units_of_the_other_kind_are_refused(place: Path, override: str, found: dict[str, str]) -> None:
    with pytest.raises(InputError) as caught:
        load_problem(place, [override])
    assert [issue.key for issue in caught.value.issues] == list(found)
    for issue, fragment in zip(caught.value.issues, found.values(), strict=True):
        assert fragment in issue.message


def test_plain_numbers_stay_si(place: Path) -> None:
    np.testing.assert_array_equal(torque(load_problem(place, ["limits.joint_torque=3"])).limit, [3, 3])


def test_joints_that_turn_keep_newton_metres() -> None:
    problem = load_problem("barrett-ball-hold", ["limits.joint_torque=3 N m"])
    assert torque(problem).unit(problem.grasp) == "N m"
