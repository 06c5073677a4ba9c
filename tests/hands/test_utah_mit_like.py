"""The UTAH/MIT-like hand against the tables of its README, and its grasp of a ball."""

import math

import numpy as np
import pytest
from denavit_hartenberg import frames, row
from pad_motion import pads_at, push, urdf_efforts
from published_hands import check_frames

from synergrip.hands.folder import load_hand
from synergrip.hands.synergies.select import select
from synergrip.problems.problem import load_problem

DEG = math.pi / 180
DIGITS = ("thumb", "index", "middle", "ring")
PARTS = ("abduction", "proximal", "middle", "distal")
ROWS = [(0, 0, 0.012, math.pi / 2), (0, 0, 0.045, 0), (0, 0, 0.032, 0), (0, 0, 0.017, 0)]
FINGER = [(-20, 20), (-10, 95), (0, 95), (0, 80)]
THUMB = [(-45, 45), (-30, 80), (0, 95), (0, 80)]
TIPS = [f"{digit}/tip" for digit in DIGITS]
CENTRE = np.array([0.1125, 0, 0.0805])


@pytest.fixture(scope="module")
def hand():
    return load_hand("utah-mit-like")


def base(digit):
    if digit == "thumb":  # x along the palm's z, z along the palm's x
        return np.array([[0, 0, 1, 0.015], [0, -1, 0, 0], [1, 0, 0, 0.010], [0, 0, 0, 1]], dtype=float)
    frame = np.eye(4)
    frame[:3, 3] = 0.080, {"index": 0.025, "middle": 0, "ring": -0.025}[digit], 0
    return frame


@pytest.mark.parametrize("seed", range(5))
def test_the_frames_are_those_of_the_table(hand, seed):
    q = np.random.default_rng(seed).uniform(-1.5, 1.5, 16)
    for digit, angles in zip(DIGITS, q.reshape(4, 4), strict=True):
        chain = [base(digit), *frames(base(digit), ROWS, angles)]
        turned = [frame @ row(angle, 0, 0, 0) for frame, angle in zip(chain[:-1], angles, strict=True)]
        links = [*(f"{digit}_{part}_link" for part in PARTS), f"{digit}_tip"]
        check_frames(hand, q, links, [*turned, chain[-1]])


def test_the_structure_is_four_digits_of_four_joints_and_the_title_says_that_no_more_is_claimed(hand):
    assert hand.joint_names == tuple(f"{digit}_{part}" for digit in DIGITS for part in PARTS)
    assert not hand.couplings
    ranges = [(joint.lower / DEG, joint.upper / DEG) for joint in hand.joints]
    np.testing.assert_allclose(ranges, [*THUMB, *(3 * FINGER)], rtol=1e-12, atol=1e-12)
    assert hand.title == "UTAH/MIT-like hand: structure only (4 digits x 4 joints, 32 tendons); every length is ours"
    actuators = select(hand, "actuators")
    assert actuators.synergies == hand.joint_names
    np.testing.assert_array_equal(actuators.S, np.eye(16))


def test_torque_limits_are_25_newtons_at_a_straight_fingertip(hand):
    levers = {"abduction": 0.094, "proximal": 0.094, "middle": 0.049, "distal": 0.017}
    for joint in hand.joints:
        assert joint.torque_limit == pytest.approx(25 * levers[joint.name.split("_")[1]], abs=0.05)
    assert urdf_efforts("utah-mit-like") == {joint.name: joint.torque_limit for joint in hand.joints}
    np.testing.assert_array_equal(hand.C_q, 0.025 * np.eye(16))


def test_the_hand_made_synergies_move_what_they_say(hand):
    flex = select(hand, None)
    assert (flex.name, flex.synergies) == ("flex", ("fingers", "thumb", "curl"))
    moved = [{hand.joint_names[i] for i in np.flatnonzero(column)} for column in flex.S.T]
    assert moved == [
        {"index_proximal", "middle_proximal", "ring_proximal"},
        {"thumb_proximal"},
        {"thumb_distal", "index_distal", "middle_distal", "ring_distal"},
    ]
    assert set(np.unique(flex.S)) == {0.0, 1.0}


@pytest.mark.parametrize("digit", DIGITS)
def test_pads_push_the_closing_way(hand, digit):
    q = hand.postures["ball"]
    assert push(hand, q, f"{digit}/tip", f"{digit}_distal") > 0.99
    assert push(hand, q, f"{digit}/middle", f"{digit}_middle") > 0.8
    assert push(hand, q, f"{digit}/proximal", f"{digit}_proximal") > 0.8


def test_index_and_ring_mirror_each_other_and_the_thumb_faces_the_fingers(hand):
    points, normals, _ = pads_at(hand, hand.postures["ball"], TIPS)
    mirror = np.diag([1, -1, 1])
    np.testing.assert_allclose(points[3], mirror @ points[1], atol=1e-15)
    np.testing.assert_allclose(normals[3], mirror @ normals[1], atol=1e-15)
    np.testing.assert_allclose(points[[0, 2], 1], 0, atol=1e-15)
    assert normals[0, 0] > 0.5
    assert np.all(normals[1:, 0] < -0.5)
    np.testing.assert_array_equal(pads_at(hand, hand.postures["open"], ["palm"])[1], [[0, 0, 1]])


def test_the_four_tips_touch_the_ball():
    held = load_problem("utah-mit-ball").held
    np.testing.assert_array_equal(held.body.position, CENTRE)
    points, normals, radii = pads_at(held.hand, held.q, TIPS)
    distance = np.linalg.norm(points - CENTRE, axis=1)
    np.testing.assert_allclose(distance - radii, 0.035, rtol=0, atol=5e-5)
    facing = np.sum(normals * (CENTRE - points), axis=1) / distance
    assert np.all(facing > math.cos(32 * DEG))
    assert CENTRE[2] - 0.035 > held.hand.pads["palm"].point[2]  # above the palm
