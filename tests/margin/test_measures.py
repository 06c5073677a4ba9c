"""Margins of contact forces against trigonometry, and against what they mean when friction changes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from random_grasps import random_grasp
from small_grasps import pinch, tripod

import synergrip as sg
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import frozen
from synergrip.margin.headroom import headrooms
from synergrip.margin.measures import measures
from synergrip.statics.motion import Motion, forward

TIMES = frozen([0.0, 0.5, 1.0])


def forces(grasp: Grasp, seed: int = 0) -> np.ndarray:
    """Forces inside their cones, mostly."""
    rng = np.random.default_rng(seed)
    found = 0.2 * rng.normal(size=(len(TIMES), grasp.n_l))
    found[:, grasp.normal_rows] = rng.uniform(1.0, 3.0, (len(TIMES), grasp.n_c))
    return found


def test_a_hard_finger_is_measured_as_trigonometry_has_it() -> None:
    grasp = tripod(mu=0.8)
    n, t, o = np.moveaxis(forces(grasp).reshape(3, 3, 3), 2, 0)
    found = measures(grasp, TIMES, forces(grasp), least=0.5)
    shear = np.hypot(t, o)
    assert np.allclose(found["slip margin"].value, 0.8 * n - shear)
    assert np.allclose(found["angle to cone"].value, np.degrees(np.arctan(0.8) - np.arctan2(shear, n)))
    assert np.allclose(found["friction safety factor"].value, 0.8 * n / shear)
    assert np.allclose(found["required friction"].value, shear / n)
    assert np.allclose(found["lift-off margin"].value, n - 0.5)
    for k in range(3):  # the distance of a point to the cone, by its nearest point on the edge of the cone in its plane
        edge = np.array([1.0, 0.8]) / np.hypot(1.0, 0.8)
        point = np.array([n[0, k], shear[0, k]])
        assert found["cone distance"].value[0, k] == pytest.approx(np.linalg.norm(point - (point @ edge) * edge))


def test_a_soft_finger_spends_friction_on_its_spin() -> None:
    grasp = pinch(mu=0.5, nu=0.005)
    own = np.zeros((3, 8))
    own[:, [0, 4]], own[:, 1], own[:, 3] = 4.0, 0.6, 0.008  # n, t and the moment about the normal
    found = measures(grasp, TIMES, own)["slip margin"].value
    assert np.allclose(found[:, 0], 0.5 * 4.0 - np.hypot(0.6, 0.5 * 0.008 / 0.005))
    assert np.allclose(found[:, 1], 2.0)


@pytest.mark.parametrize("seed", range(6))
def test_with_the_friction_that_is_required_a_contact_is_about_to_slip(seed: int) -> None:
    rng = np.random.default_rng(seed)
    grasp = random_grasp(rng, [str(kind) for kind in rng.choice(["hard", "soft"], 4)])
    found = measures(grasp, TIMES, forces(grasp, seed))
    needed = found["required friction"].value[1] / [contact.friction for contact in grasp.contacts]
    contacts = tuple(
        replace(contact, kind=contact.kind.slippery(float(share)))
        for contact, share in zip(grasp.contacts, needed, strict=True)
    )
    again = measures(replace(grasp, contacts=contacts), TIMES, forces(grasp, seed))
    assert np.allclose(again["slip margin"].value[1], 0.0, atol=1e-12)
    assert np.allclose(again["friction safety factor"].value[1], 1.0)


def test_the_worst_is_the_first_of_those_that_are_as_bad() -> None:
    grasp = tripod()
    own = np.tile([2.0, 0.3, 0.0], (3, 3))
    own[2, 3] = 1.0
    worst = measures(grasp, TIMES, own)["slip margin"].worst
    assert (worst.name, worst.time_s) == ("C1", 1.0)
    own[2, 3] = 2.0
    worst = measures(grasp, TIMES, own)["required friction"].worst
    assert (worst.name, worst.time_s, worst.value) == ("C0", 0.0, pytest.approx(0.15))


def test_a_contact_without_friction_needs_none_and_is_no_cone_of_half_a_right_angle() -> None:
    grasp = random_grasp(np.random.default_rng(0), ["frictionless", "hard", "hard", "hard"])
    own = forces(grasp)
    found = {name: each.value[:, 0] for name, each in measures(grasp, TIMES, own).items()}
    assert np.array_equal(found["slip margin"], own[:, 0])
    assert np.array_equal(found["cone distance"], own[:, 0])
    assert np.all(np.isinf(found["angle to cone"]))
    assert np.all(np.isinf(found["friction safety factor"]))
    assert np.all(found["required friction"] == 0)


def test_no_friction_holds_a_contact_that_would_have_to_pull() -> None:
    own = np.tile([-0.5, 0.2, 0.0], (3, 3))
    found = measures(tripod(mu=0.8), TIMES, own)
    assert np.all(np.isinf(found["required friction"].value))
    assert np.all(found["friction safety factor"].value < 0)
    assert np.allclose(found["slip margin"].value, -0.8 * 0.5 - 0.2)


def test_slip_margins_are_those_of_the_plan() -> None:
    for name in ("tripod", "pinch-soft", "gripper-box"):
        problem = sg.load_problem(name)
        plan = sg.plan(problem.grasp, problem.task)
        assert isinstance(plan, sg.Plan)
        assert np.allclose(measures(plan.grasp, plan.time, plan.forces)["slip margin"].value, plan.margins, atol=1e-9)


def test_a_factor_that_is_huge_elsewhere_hides_no_small_one() -> None:
    own = np.tile([2.0, 1e-15, 0.0], (3, 3))
    own[2, 3:5] = 2.0, 0.2
    worst = measures(tripod(mu=0.8), TIMES, own)["friction safety factor"].worst
    assert (worst.name, worst.time_s, worst.value) == ("C1", 1.0, pytest.approx(8.0))


def test_without_shear_no_friction_is_needed() -> None:
    own = np.tile([2.0, 0.0, 0.0], (3, 3))
    found = measures(tripod(), TIMES, own)
    assert np.all(np.isinf(found["friction safety factor"].value))
    assert np.all(found["required friction"].value == 0)


def test_headroom_is_what_is_left_of_the_limits_that_are_set_or_that_the_hand_has() -> None:
    problem = sg.load_problem("gripper-box", ["limits.joint_torque=[1, 2, 4, 8]", "task.knots=5"])
    found = sg.margins(problem.grasp, problem.task, only=["heaviest_kg"])
    assert isinstance(found, sg.Margins)
    assert found.linear is not None
    most, torques = np.array([1.0, 2.0, 4.0, 8.0]), found.plan.motion.torques
    room = found.measures["torque headroom"]
    assert np.allclose(room.value, 1 - np.abs(torques) / most)
    k, j = np.unravel_index(np.argmax(np.abs(torques) / most), torques.shape)
    assert (room.worst.name, room.worst.time_s) == (problem.grasp.joints[j], found.plan.time[k])
    assert room.worst.value == pytest.approx(1 - abs(torques[k, j]) / most[j])
    assert not np.allclose(found.linear["torque headroom"].value, room.value, atol=1e-4)
    assert "effort headroom" not in found.measures  # this hand states none


def test_headroom_without_limits_of_the_task_is_that_of_the_hand_and_there_may_be_none() -> None:
    problem = sg.load_problem("gripper-box", ["task.knots=5"])
    grasp = problem.grasp
    motion = forward(sg.analyse(grasp).response, TIMES, np.zeros((3, grasp.n_z)), np.tile(grasp.w_0 + 0.1, (3, 1)))
    stated = np.array([joint.torque_limit for joint in grasp.held.hand.joints])  # type: ignore[union-attr]
    bare, some = (
        headrooms(grasp, (), motion),
        headrooms(grasp, (sg.JointTorque([np.inf, 0.5, np.inf, np.inf]),), motion),
    )
    assert np.allclose(bare["torque headroom"].value, 1 - np.abs(motion.torques) / stated)
    assert np.allclose(some["torque headroom"].value, 1 - np.abs(motion.torques) / [stated[0], 0.5, *stated[2:]])
    one = headrooms(tripod(), (sg.ActuatorEffort([np.inf, 3.0, np.inf]), sg.ActuatorEffort(30.0)), pulling(tripod()))
    assert list(one) == ["effort headroom"]
    assert np.allclose(one["effort headroom"].value, 1 - np.abs(pulling(tripod()).efforts) / [30, 3, 30])
    assert headrooms(tripod(), (), pulling(tripod())) == {}


def pulling(grasp: Grasp) -> Motion:
    return forward(sg.analyse(grasp).response, TIMES, 1e-3 * np.eye(3)[:, : grasp.n_z], np.zeros((3, 6)))
