"""DLR Hand II against the numbers of GraspIt! (models/robots/DLR), carried over here in its units: mm, deg."""

import math

import numpy as np
import pytest
from denavit_hartenberg import frames, row
from pad_motion import pads_at, push, urdf_efforts
from published_hands import check_fingertip, check_frames

from synergrip.hands.folder import load_hand
from synergrip.hands.synergies.select import select
from synergrip.problems.problem import load_problem

DEG = math.pi / 180
FINGERS = ("thumb", "index", "middle", "ring")
PARTS = ("proximal", "abduction", "medial", "distal")
# theta offset, d, a, alpha
TABLE = [(90, 0, 0, -90), (0, 0, 100.35, 90), (0, 0, 40, 0), (90, 0, 0, 90)]
RANGES = [(-20, 70), (-30, 30), (0, 100), (0, 104.7619048)]
ABDUCTION = {"thumb": (-30, 30), "index": (-30, 10), "middle": (-30, 30), "ring": (-10, 30)}
PLACES = {
    "thumb": (-44.5493, 26.5, 19.85),
    "index": (-1.92188, 134.5, 39.0717),
    "middle": (0, 134.5, 0),
    "ring": (-2.17275, 134.5, -39.0717),
}
TURNS = {"thumb": (180, 90), "index": (6, 0), "middle": (0, 0), "ring": (-6, 0)}  # about x, then about z
EIGENGRASPS = [
    [1.0, 0.0, 0.0, 1.0, 1.0, 0.1, 1.0, 0.0, 0.1, 1.0, -1.0, 0.1],
    [0.6, 0.0, 1.0, -0.3, 0.0, 1.0, -0.3, 0.0, 1.0, -0.3, 0.0, 1.0],
]
ORIGIN_OF_EIGENGRASPS = [0.26, 0.0, 0.78, 0.69, -0.17, 0.78, 0.69, 0.0, 0.78, 0.69, 0.17, 0.78]
# contacts on the fingertips, in the frame after the last row: place, normal
CONTACTS = {
    "thumb": ((9.998159, -0.456864, 39.346258), (0.942711, -0.149329, 0.298325)),
    "index": ((9.910617, -1.009518, 39.346256), (0.936925, -0.148412, 0.316457)),
    "middle": ((10.123816, -0.000168, 39.040766), (0.979872, 0.102989, 0.171010)),
    "ring": ((10.070500, -0.000169, 39.346260), (0.940934, 0.132204, 0.311715)),
}
# contacts on the other links, in the frame after the row that ends the link: along it, and out of it
MEDIAL = {
    "thumb": (-27.006066, 11.210573),
    "index": (-22.983158, 11.150702),
    "middle": (-23.621599, 11.146067),
    "ring": (-21.752142, 11.117995),
}
PROXIMAL = {
    "thumb": (-44.553649, 12.265286),
    "index": (-38.486063, 12.159375),
    "middle": (-38.825270, 12.165295),
    "ring": (-38.486158, 12.159376),
}
TIPS = [f"{finger}/tip" for finger in FINGERS]
CENTRE = np.array([-0.1484, 0.1973, 0.0002])


@pytest.fixture(scope="module")
def hand():
    return load_hand("dlr-hand-ii")


def base(finger):
    about_x, about_z = TURNS[finger]
    frame = row(0, 0, 0, about_x * DEG) @ row(about_z * DEG, 0, 0, 0)
    frame[:3, 3] = np.array(PLACES[finger]) / 1e3
    return frame


def driven(values):
    """Return the joint values (16,) that 12 degrees of freedom stand for: a distal joint follows its medial joint."""
    return np.array([[a, b, c, 22 / 21 * c] for a, b, c in np.reshape(values, (4, 3))]).ravel()


@pytest.mark.parametrize("seed", range(10))
def test_the_frames_are_those_of_graspit(hand, seed):
    q = np.random.default_rng(seed).uniform(-1.5, 1.5, 16)
    rows = [(offset * DEG, d / 1e3, a / 1e3, alpha * DEG) for offset, d, a, alpha in TABLE]
    for finger, angles in zip(FINGERS, q.reshape(4, 4), strict=True):
        chain = [base(finger), *frames(base(finger), rows, angles)]
        turned = [frame @ row(r[0] + angle, r[1], 0, 0) for frame, r, angle in zip(chain, rows, angles, strict=False)]
        links = [*(f"{finger}_{part}_link" for part in PARTS), f"{finger}_tip"]
        check_frames(hand, q, links, [*turned, chain[-1]])


def test_joints_and_ranges_are_those_of_graspit(hand):
    assert hand.joint_names == tuple(f"{finger}_{part}" for finger in FINGERS for part in PARTS)
    ranges = [
        ABDUCTION[finger] if part == "abduction" else RANGES[i] for finger in FINGERS for i, part in enumerate(PARTS)
    ]
    np.testing.assert_allclose([(j.lower / DEG, j.upper / DEG) for j in hand.joints], ranges, rtol=1e-9)


def test_distal_joints_follow_22_to_21(hand):
    assert set(hand.couplings) == {f"{finger}_distal" for finger in FINGERS}
    for finger in FINGERS:
        coupling = hand.couplings[f"{finger}_distal"]
        assert coupling.ratios == {f"{finger}_medial": pytest.approx(22 / 21, abs=1e-15)}
        assert coupling.ratios[f"{finger}_medial"] == pytest.approx(1.047619, abs=1e-6)  # as printed
        assert coupling.offset == 0


def test_the_eigengrasps_are_those_of_graspit(hand):
    eigengrasps = select(hand, None)
    assert eigengrasps.name == "eigengrasps"
    np.testing.assert_allclose(eigengrasps.S, np.column_stack([driven(e) for e in EIGENGRASPS]), atol=1e-15)
    np.testing.assert_allclose(eigengrasps.offset, driven(ORIGIN_OF_EIGENGRASPS), atol=1e-15)
    np.testing.assert_allclose(hand.postures["origin"], driven(ORIGIN_OF_EIGENGRASPS), atol=1e-15)


def test_each_actuator_moves_one_joint_or_a_coupled_pair(hand):
    actuators = select(hand, "actuators")
    assert actuators.synergies == tuple(f"{finger}_{part}" for finger in FINGERS for part in PARTS[:3])
    np.testing.assert_allclose(actuators.S, np.column_stack([driven(e) for e in np.eye(12)]), atol=1e-15)
    limits = dict(zip(actuators.synergies, actuators.effort_limits, strict=True))
    assert {name for name, limit in limits.items() if limit == 3.6} == {f"{finger}_medial" for finger in FINGERS}
    assert all(limit in (3.6, math.inf) for limit in limits.values())


def test_torque_limits_are_30_newtons_at_the_stretched_fingertip(hand):
    levers = {"proximal": 0.155, "abduction": 0.155, "medial": 0.080, "distal": 0.040}
    for joint in hand.joints:
        assert joint.torque_limit == pytest.approx(30 * levers[joint.name.split("_")[1]], rel=0.012)
    assert urdf_efforts("dlr-hand-ii") == {joint.name: joint.torque_limit for joint in hand.joints}
    np.testing.assert_array_equal(hand.C_q, 0.025 * np.eye(16))


@pytest.mark.parametrize("finger", FINGERS)
def test_fingertips_pass_through_the_contacts_of_graspit(hand, finger):
    pad = hand.pads[f"{finger}/tip"]
    place, normal = np.array(CONTACTS[finger][0]) / 1e3, np.array(CONTACTS[finger][1])
    check_fingertip(pad, place, normal)
    assert pad.normal @ normal > math.cos(21 * DEG)


def test_the_other_pads_are_those_of_graspit(hand):
    for finger in FINGERS:
        (along, out), pad = MEDIAL[finger], hand.pads[f"{finger}/medial"]
        np.testing.assert_allclose(1e3 * pad.point, [40 + along, out, 0], rtol=0, atol=0.006)
        (along, out), pad = PROXIMAL[finger], hand.pads[f"{finger}/proximal"]
        np.testing.assert_allclose(1e3 * pad.point, [100.35 + along, 0, out], rtol=0, atol=0.006)
    np.testing.assert_allclose(1e3 * hand.pads["palm"].point, [-28.005452, 90.468886, 8.779276], rtol=0, atol=0.006)


@pytest.mark.parametrize("finger", FINGERS)
def test_pads_push_the_closing_way(hand, finger):
    q = hand.postures["origin"]
    assert push(hand, q, f"{finger}/tip", f"{finger}_distal") > 0.95
    assert push(hand, q, f"{finger}/medial", f"{finger}_medial") > 0.7
    assert push(hand, q, f"{finger}/proximal", f"{finger}_proximal") > 0.95


def test_fingers_lie_in_front_of_a_palm_that_faces_minus_x(hand):
    points, normals, _ = pads_at(hand, hand.postures["open"], ["palm", *TIPS])
    np.testing.assert_array_equal(normals[0], [-1, 0, 0])
    np.testing.assert_allclose(normals[2:], [[-1, 0, 0]] * 3, atol=1e-15)  # fingers straight, facing as the palm
    np.testing.assert_allclose(normals[1], [0, 1, 0], atol=1e-15)  # the thumb straight, facing the fingers
    assert points[2, 2] > points[3, 2] > points[4, 2]


@pytest.mark.parametrize("problem", ["dlr-ball-eigengrasps", "dlr-ball-move"])
def test_the_four_tips_touch_the_ball(problem):
    held = load_problem(problem).held
    np.testing.assert_array_equal(held.body.position, CENTRE)
    points, normals, radii = pads_at(held.hand, held.q, TIPS)
    distance = np.linalg.norm(points - CENTRE, axis=1)
    np.testing.assert_allclose(distance - radii, 0.045, rtol=0, atol=2e-5)
    outward = (points - CENTRE) / distance[:, None]
    assert np.all(-np.sum(normals * outward, axis=1) > math.cos(27 * DEG))
    fingers = outward[1:].sum(axis=0)
    assert outward[0] @ fingers / np.linalg.norm(fingers) < -math.cos(2 * DEG)  # the thumb is opposite
