"""The bundled hands against the published numbers, computed here without the library."""

import math
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from published_hands import check_frames

from synergrip.files import bundled
from synergrip.hands.folder import bundled_hands, load_hand
from synergrip.hands.synergies.matrix import posture
from synergrip.hands.synergies.select import select

DEG = math.pi / 180
ORIGIN = np.zeros(3)

# Barrett manual D3000, section 9.5; (r, j) of the manual's fingers, which are fingers 2, 3 and 1 of the paper
MANUAL = {"Aw": 0.025, "A1": 0.050, "A2": 0.070, "A3": 0.050, "Dw": 0.076, "D3": 0.0095}
SIGNS = {1: (0, -1), 2: (-1, 1), 3: (1, 1)}
PHI2, PHI3 = 2.46 * DEG, 39.56 * DEG


def craig(alpha, a, d, theta):
    """One row of a modified Denavit-Hartenberg table."""
    ca, sa, ct, st = math.cos(alpha), math.sin(alpha), math.cos(theta), math.sin(theta)
    return np.array([[ct, -st, 0, a], [st * ca, ct * ca, -sa, -sa * d], [st * sa, ct * sa, ca, ca * d], [0, 0, 0, 1]])


def manual_frames(finger, spread, inner, outer, sizes=MANUAL, phi2=PHI2, phi3=PHI3):
    """Return the frames of the inner link, outer link and tip of a finger, in the wrist frame."""
    r, j = SIGNS[finger]
    base = craig(0, r * sizes["Aw"], sizes["Dw"], r * spread - math.pi / 2 * j)
    first = base @ craig(math.pi / 2, sizes["A1"], 0, inner + phi2)
    second = first @ craig(0, sizes["A2"], 0, outer + phi3)
    return first, second, second @ craig(-math.pi / 2, sizes["A3"], sizes["D3"], 0)


@pytest.fixture(scope="module")
def barrett():
    return load_hand("barrett")


@pytest.fixture(scope="module")
def idealised():
    return load_hand("barrett-table2")


def tips(hand, q):
    pads = [hand.pads[f"finger{k}/tip"] for k in (1, 2, 3)]
    motions = hand.kinematics.at(q, [(pad.link, pad.point) for pad in pads])
    normals = [motion.rotation @ pad.normal for motion, pad in zip(motions, pads, strict=True)]
    return np.array([motion.position for motion in motions]), np.array(normals)


@pytest.mark.parametrize("seed", range(20))
def test_the_frames_are_those_of_the_manual(barrett, seed):
    rng = np.random.default_rng(seed)
    spread = rng.uniform(0, math.pi)
    inner, outer = rng.uniform(0, 140 * DEG, 3), rng.uniform(0, 48 * DEG, 3)
    q = [inner[0], outer[0], spread, inner[1], outer[1], -spread, inner[2], outer[2]]
    for k in (1, 2, 3):
        links = [f"finger{k}_{name}" for name in ("inner_link", "outer_link", "tip")]
        expected = manual_frames(k, spread, inner[k - 1], outer[k - 1])
        check_frames(barrett, np.array(q), links, expected, atol=1e-9)


@pytest.mark.parametrize(("name", "alpha"), [("barrett", 1 / 3), ("barrett-table2", 1.0)])
def test_the_synergy_matrix_is_that_of_the_paper(name, alpha):
    """(37)."""
    motors = select(load_hand(name), None)
    assert motors.synergies == ("spread", "finger1", "finger2", "finger3")
    expected = np.zeros((8, 4))
    expected[0, 1] = expected[3, 2] = expected[6, 3] = 1
    expected[1, 1] = expected[4, 2] = expected[7, 3] = alpha
    expected[2, 0], expected[5, 0] = 1, -1
    np.testing.assert_array_equal(motors.S, expected)
    np.testing.assert_array_equal(motors.offset, np.zeros(8))


def test_the_joints_are_those_of_the_paper_with_the_published_ranges(barrett):
    outer = [f"finger{k}_outer" for k in (1, 2, 3)]
    assert barrett.joint_names == (
        *("finger1_inner", "finger1_outer"),
        *("finger2_spread", "finger2_inner", "finger2_outer"),
        *("finger3_spread", "finger3_inner", "finger3_outer"),
    )
    upper = [joint.upper / DEG for joint in barrett.joints]
    lower = [joint.lower / DEG for joint in barrett.joints]
    np.testing.assert_allclose(upper, [140, 48, 180, 140, 48, 0, 140, 48])
    np.testing.assert_allclose(lower, [0, 0, 0, 0, 0, -180, 0, 0])
    assert {joint.torque_limit for joint in barrett.joints if joint.name in outer} == {1.0}
    np.testing.assert_array_equal(barrett.C_q, 0.025 * np.eye(8))


def test_the_urdf_states_the_same_torque_limits(barrett):
    root = ET.parse(bundled("models") / "hands" / "barrett" / "hand.urdf").getroot()
    efforts = {joint.get("name"): joint.find("limit") for joint in root.iter("joint")}
    for joint in barrett.joints:
        assert float(efforts[joint.name].get("effort")) == joint.torque_limit


def test_spreading_opens_fingers_2_and_3_symmetrically(barrett):
    def at(spread):
        points, _ = tips(barrett, posture(barrett, select(barrett, None), {"spread": spread, "close": 0.5}))
        return points

    mirror = np.diag([-1, 1, 1])
    for spread in (0.0, 0.7, 2.0):
        np.testing.assert_allclose(at(spread)[2], mirror @ at(spread)[1], atol=1e-15)
    assert at(0.7)[2, 0] > at(0.0)[2, 0] > 0
    assert at(0.0)[1, 1] < 0 < at(0.0)[0, 1]
    together = at(math.pi)[:, 1:]  # at 180 deg all three fingers stand side by side
    np.testing.assert_allclose(together[1:], together[[0, 0]], atol=1e-15)


def test_pads_push_toward_the_closing_side(barrett):
    q = posture(barrett, select(barrett, None), {"close": 0.5})
    for k in (1, 2, 3):
        for kind in ("tip", "pad"):
            pad = barrett.pads[f"finger{k}/{kind}"]
            (motion,) = barrett.kinematics.at(q, [(pad.link, pad.point)])
            closing = motion.jacobian[:3, barrett.joint_names.index(f"finger{k}_outer")]
            cosine = motion.rotation @ pad.normal @ closing / np.linalg.norm(closing)
            assert cosine > 0.98


def test_the_pads_are_where_the_cad_geometry_has_them(barrett):
    """38 mm along and 34 mm above the outer joint in the extended finger."""
    pad = barrett.pads["finger1/pad"]
    pad_motion, joint = barrett.kinematics.at(np.zeros(8), [(pad.link, pad.point), (pad.link, ORIGIN)])
    np.testing.assert_allclose(pad_motion.position - joint.position, [0, 0.038, 0.034], atol=1e-5)


def test_the_ball_posture_holds_a_ball(barrett):
    q = posture(barrett, select(barrett, None), "ball")
    points, normals = tips(barrett, q)
    centre = np.array([0, 3.345, 148.837]) * 1e-3
    inward = (centre - points) / np.linalg.norm(centre - points, axis=1, keepdims=True)
    np.testing.assert_allclose(np.linalg.norm(centre - points, axis=1), 0.05, atol=1e-6)
    angles = np.degrees(np.arccos(np.sum(inward * normals, axis=1)))
    assert angles[0] < 2
    assert np.all(angles < 29.3)
    # equal squeezes along the lines to the middle of the circle through the contacts: balanced, within friction 0.5
    shares = np.linalg.solve(np.vstack([(centre - points)[:, :2].T, np.ones(3)]), [0, 0, 1])
    assert np.all(shares > 0.2)
    across = np.cross(points[1] - points[0], points[2] - points[0])
    tilt = np.arcsin(np.abs(inward @ across) / np.linalg.norm(across))
    np.testing.assert_allclose(np.tan(tilt), 0.465, atol=0.001)
    assert centre[2] - 0.05 > 0.081  # above the palm


def test_the_idealised_hand_touches_at_the_points_of_table_2(idealised):
    q = posture(idealised, select(idealised, None), "table2")
    np.testing.assert_allclose(q, np.array([0, 0, 30, 90, 90, -30, 90, 90]) * DEG, atol=1e-15)
    points, _ = tips(idealised, q)
    np.testing.assert_allclose(points, [[0, 0.170, 0], [-0.025, 0, 0.070], [0.025, 0, 0.070]], rtol=0, atol=1e-13)
    tip_spread = idealised.kinematics.at(q, [("finger2_tip", ORIGIN)])[0].jacobian[:3, 2]
    np.testing.assert_allclose(tip_spread, np.zeros(3), atol=1e-15)
    assert "idealised" in idealised.title


@pytest.mark.parametrize("seed", range(5))
def test_the_idealised_hand_has_the_lengths_of_the_manual_and_nothing_else(idealised, seed):
    spread, inner, outer = np.random.default_rng(seed).uniform(0, 2, 3)
    q = np.array([inner, outer, spread, inner, outer, -spread, inner, outer])
    sizes = {**MANUAL, "Dw": 0, "D3": 0}
    points, normals = tips(idealised, q)
    for k in (1, 2, 3):
        frame = manual_frames(k, spread, inner, outer, sizes, 0, 0)[2]
        np.testing.assert_allclose(points[k - 1], frame[:3, 3], atol=1e-15)
        np.testing.assert_allclose(normals[k - 1], frame[:3, 2], atol=1e-14)


@pytest.mark.parametrize("name", bundled_hands())
def test_every_bundled_hand_says_where_its_numbers_come_from(name):
    folder = bundled("models") / "hands" / name
    readme = (folder / "README.md").read_text(encoding="utf-8")
    assert "| number | value |" in readme
    hand = load_hand(name)
    for title in hand.postures:
        posture(hand, select(hand, None), title)
