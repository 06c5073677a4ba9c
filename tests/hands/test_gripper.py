"""The bundled gripper against its own table, and its problems against closed forms."""

import math

import numpy as np
import pytest
from denavit_hartenberg import frames, row
from pad_motion import pads_at, push, urdf_efforts
from published_hands import check_frames

from synergrip.hands.folder import load_hand
from synergrip.hands.synergies.select import select
from synergrip.planning.planning import plan_of_start_posture as plan
from synergrip.problems.problem import load_problem

DEG = math.pi / 180
JOINTS = ("left_proximal", "left_distal", "right_proximal", "right_distal")
ROWS = [(0, 0, 0.060, 0), (0, 0, 0.042, 0)]
# x along the palm's z, z along the joint axis; columns are x, y, z
BASES = {
    "left": np.array([[0, -1, 0, 0.035], [0, 0, -1, 0], [1, 0, 0, 0.020], [0, 0, 0, 1]], dtype=float),
    "right": np.array([[0, 1, 0, -0.035], [0, 0, 1, 0], [1, 0, 0, 0.020], [0, 0, 0, 1]], dtype=float),
}


@pytest.fixture(scope="module")
def gripper():
    return load_hand("gripper")


@pytest.mark.parametrize("seed", range(5))
def test_the_frames_are_those_of_the_table(gripper, seed):
    q = np.random.default_rng(seed).uniform(-1, 1, 4)
    for side, angles in (("left", q[:2]), ("right", q[2:])):
        links = [f"{side}_proximal_link", f"{side}_distal_link", f"{side}_tip"]
        chain = frames(BASES[side], ROWS, angles)
        expected = [BASES[side] @ row(angles[0], 0, 0, 0), chain[0] @ row(angles[1], 0, 0, 0), chain[1]]
        check_frames(gripper, q, links, expected)


def test_joints_limits_and_synergies_are_those_of_the_readme(gripper):
    assert gripper.joint_names == JOINTS
    limits = [(joint.lower / DEG, joint.upper / DEG, joint.torque_limit) for joint in gripper.joints]
    np.testing.assert_allclose(limits, 2 * [(-45, 75, 2.0), (-10, 90, 1.0)])
    np.testing.assert_array_equal(gripper.C_q, 0.025 * np.eye(4))
    assert urdf_efforts("gripper") == {joint.name: joint.torque_limit for joint in gripper.joints}
    default = select(gripper, None)
    assert (default.name, default.synergies) == ("synergies", ("proximal", "distal"))
    np.testing.assert_array_equal(default.S, [[1, 0], [0, 1], [1, 0], [0, 1]])
    np.testing.assert_array_equal(default.offset, np.zeros(4))


def test_pads_push_the_closing_way_and_the_sides_mirror_each_other(gripper):
    q = np.array([-0.2, 0.5, -0.2, 0.5])
    names = ["left/tip", "left/proximal", "right/tip", "right/proximal"]
    points, normals, _ = pads_at(gripper, q, names)
    mirror = np.diag([-1, 1, 1])
    np.testing.assert_allclose(points[2:], points[:2] @ mirror, atol=1e-15)
    np.testing.assert_allclose(normals[2:], normals[:2] @ mirror, atol=1e-15)
    assert np.all(normals[:2, 0] < -0.8)  # the left finger pushes toward -x
    for side in ("left", "right"):
        assert push(gripper, q, f"{side}/tip", f"{side}_distal") > 0.99
        assert push(gripper, q, f"{side}/proximal", f"{side}_proximal") > 0.95
    np.testing.assert_array_equal(pads_at(gripper, q, ["palm"])[1], [[0, 0, 1]])


def test_the_tips_touch_the_box():
    held = load_problem("gripper-box").held
    points, normals, radii = pads_at(held.hand, held.q, ["left/tip", "right/tip"])
    np.testing.assert_allclose(np.abs(points[:, 0]) - radii, 0.020, rtol=0, atol=5e-5)
    np.testing.assert_allclose(
        points[:, 2], 0.020 + 0.060 * math.cos(5 * DEG) + 0.042 * math.cos(16.9 * DEG), atol=1e-12
    )
    np.testing.assert_allclose(normals[:, 0], [-math.cos(16.9 * DEG), math.cos(16.9 * DEG)], atol=1e-12)


def test_all_pads_touch_the_bar():
    held = load_problem("gripper-bar").held
    names = ["palm", "left/tip", "right/tip", "left/proximal", "right/proximal"]
    points, _, radii = pads_at(held.hand, held.q, names)
    gaps = np.hypot(points[:, 0], points[:, 2] - 0.05504) - 0.035 - radii
    assert np.abs(gaps).max() < 0.05e-3
    assert points[1, 0] - radii[1] > 0  # the tips do not meet


def test_the_forces_on_the_box_are_the_closed_form():
    """Each soft contact carries half of the weight and half of its moment about the line of the contacts."""
    problem = load_problem("gripper-box")
    outcome = plan(problem.grasp, problem.task)
    assert outcome.verdict == "feasible"
    mu, nu, margin, weight = 0.6, 0.005, 0.5, 0.2 * 9.81
    share = problem.timed.times / problem.timed.times[-1]
    angle = math.pi * (10 * share**3 - 15 * share**4 + 6 * share**5)
    force_y, force_z = -weight * np.sin(angle), -weight * np.cos(angle)
    height = 0.020 + 0.060 * math.cos(5 * DEG) + 0.042 * math.cos(16.9 * DEG)
    moment = 0.004 * force_z - (0.120 - height) * force_y
    expected = (margin + np.sqrt((weight / 2) ** 2 + (mu * moment / (2 * nu)) ** 2)) / mu
    normal = outcome.motion.forces[:, [0, 4]]
    np.testing.assert_allclose(normal, np.column_stack([expected, expected]), rtol=1e-6)
    true = problem.file.expect.peak_normal_N  # at the posture that the hand then has
    assert true == pytest.approx(expected.max(), rel=5e-3)
    lifted = outcome.motion.du[-1] - outcome.motion.sag[-1]
    np.testing.assert_allclose(lifted, [0, 0, 0.002, 0, 0, 0], atol=1e-9)
