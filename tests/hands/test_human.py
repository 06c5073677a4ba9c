"""The human hand against SynGrasp's tables, and the Santello synergies against what is known of them."""

from __future__ import annotations

import tomllib
import xml.etree.ElementTree as ET
from itertools import pairwise

import numpy as np
import pytest
from paradigmatic_hand import DIGITS, JOINTS, PALMAR, RADIUS, hand_frames

from synergrip.files import bundled
from synergrip.hands.folder import load_hand
from synergrip.hands.synergies.select import select

FINGERS = DIGITS[1:]
ORIGIN = np.zeros(3)
FLEX = [JOINTS.index(f"{digit}_{joint}") for digit in FINGERS for joint in ("mcp_flex", "pip", "dip")]
PIP = [JOINTS.index(f"{digit}_pip") for digit in FINGERS]
DIP = [JOINTS.index(f"{digit}_dip") for digit in FINGERS]
MIDDLE_ABD, RING_ABD, LITTLE_ABD = (JOINTS.index(f"{digit}_mcp_abd") for digit in ("middle", "ring", "little"))


@pytest.fixture(scope="module")
def human():
    return load_hand("human")


@pytest.fixture(scope="module")
def santello(human):
    return select(human, None)


def random_posture(hand, seed):
    return np.random.default_rng(seed).uniform([j.lower for j in hand.joints], [j.upper for j in hand.joints])


def tips(q):
    return {digit: chain[-1][:3, 3] for digit, chain in hand_frames(q).items()}


@pytest.mark.parametrize("seed", range(20))
def test_the_frames_are_those_of_the_table(human, seed):
    q = random_posture(human, seed)
    for digit, chain in hand_frames(q).items():
        links = [joint.link for joint in human.joints if joint.name.startswith(digit)]
        found = human.kinematics.at(q, [(link, ORIGIN) for link in (*links, f"{digit}_tip")])
        # the frame of a link is turned by its joint: it shares origin and z axis with the frame before the row
        for motion, frame in zip(found, chain, strict=True):
            np.testing.assert_allclose(motion.position, frame[:3, 3], rtol=0, atol=1e-9)
            np.testing.assert_allclose(motion.rotation[:, 2], frame[:3, 2], rtol=0, atol=1e-9)
        np.testing.assert_allclose(found[-1].rotation, chain[-1][:3, :3], rtol=0, atol=1e-9)


def test_joints_and_torque_limits(human):
    assert human.joint_names == JOINTS
    root = ET.parse(bundled("models") / "hands" / "human" / "hand.urdf").getroot()
    efforts = {joint.get("name"): joint.find("limit") for joint in root.iter("joint")}
    for joint in human.joints:
        assert float(efforts[joint.name].get("effort")) == joint.torque_limit
    np.testing.assert_array_equal(human.C_q, 0.2 * np.eye(20))


def test_the_synergies_are_as_published(human, santello):
    S = santello.S
    assert list(human.synergy_sets) == ["santello", "joints"]
    assert santello.synergies == tuple(f"pc{k}" for k in range(1, 16))
    assert np.linalg.matrix_rank(S) == 15
    np.testing.assert_array_equal(S[MIDDLE_ABD], 0)
    for row, followed in ((S[DIP], S[PIP]), (santello.offset[DIP], santello.offset[PIP])):
        np.testing.assert_allclose(row, 2 / 3 * followed, rtol=1e-14)
    products = S.T @ S
    norms = np.sqrt(np.diag(products))
    assert norms.min() == pytest.approx(0.969, abs=1e-3)
    assert norms.max() == pytest.approx(1.274, abs=1e-3)
    assert np.abs(products - np.diag(np.diag(products))).max() == pytest.approx(0.541, abs=1e-3)


def test_the_mean_posture_is_as_published(santello):
    degrees = [-56.3, 100.8, -24.7, 5.2, 26.0, 26.7, 60.7, 40.5, 0.0, 28.4, 60.7, 40.5, -12.8, 33.9, 72.7, 48.4,
               -30.3, 48.1, 66.0, 44.0]  # fmt: skip
    np.testing.assert_allclose(np.degrees(santello.offset), degrees, atol=0.05)


def test_in_the_recorded_angles_the_synergies_are_orthonormal(santello):
    """The 15 angles of a glove: no DIP, no middle abduction, the little finger spread from the ring finger."""
    recorded = np.delete(santello.S, [MIDDLE_ABD, *DIP], axis=0)
    recorded[LITTLE_ABD - 4] -= santello.S[RING_ABD]
    assert recorded.shape == (15, 15)
    np.testing.assert_allclose(recorded.T @ recorded, np.eye(15), atol=2e-15)


def test_flexion_closes_and_abduction_spreads(santello):
    """The palm looks to -z and the thumb is on the side of -x: signs of the joints, then those of the mean posture."""
    for digit in FINGERS:
        flexed, spread = np.zeros(20), np.zeros(20)
        flexed[JOINTS.index(f"{digit}_mcp_flex")] = spread[JOINTS.index(f"{digit}_mcp_abd")] = 0.1
        assert (tips(flexed)[digit] - tips(np.zeros(20))[digit])[2] < -5e-3
        assert (tips(spread)[digit] - tips(np.zeros(20))[digit])[0] < -5e-3
    assert np.all(santello.offset[FLEX] > 0.4)
    index, ring, little = (santello.offset[JOINTS.index(f"{digit}_mcp_abd")] for digit in ("index", "ring", "little"))
    assert index > 0 > ring > little


def test_in_the_mean_posture_the_thumb_opposes_the_fingers(santello):
    chains = hand_frames(santello.offset)
    others = np.mean([chains[digit][-1][:3, 3] for digit in FINGERS], axis=0)
    thumb = chains["thumb"][-1]
    facing = (others - thumb[:3, 3]) / np.linalg.norm(others - thumb[:3, 3])
    assert thumb[:3, PALMAR["thumb"]] @ facing > np.cos(np.radians(30))
    turned = santello.offset * np.where(np.isin(np.arange(20), [1, 2, 3]), -1, 1)
    assert tips(turned)["thumb"][2] > 0.03 > -0.03 > thumb[2, 3]  # with the other signs it is behind the palm


def test_the_first_synergy_opens_the_hand(santello):
    """All fingers extend and spread, and all fingertips go away from their middle."""
    assert np.all(santello.S[FLEX, 0] < 0)
    steps = [np.array(list(tips(santello.offset + z * santello.S[:, 0]).values())) for z in (-0.5, 0.0, 0.5)]
    sizes = [np.linalg.norm(step - step.mean(axis=0), axis=1).mean() for step in steps]
    assert sizes[0] < sizes[1] < sizes[2]


def posture_and_problem(hand, name, problem):
    file = tomllib.loads((bundled("problems") / f"{problem}.toml").read_text(encoding="utf-8"))
    centre = np.array([float(text.split()[0]) for text in file["object"]["position"]]) * 1e-3
    return hand.postures[name], centre


GRASPS = [("ball", "human-ball", 33e-3, None), ("glass", "human-glass", 30e-3, (0.939693, -0.34202, 0.0))]


@pytest.mark.parametrize(("name", "problem", "radius", "axis"), GRASPS)
def test_grasp_postures_touch_with_five_round_pads(human, name, problem, radius, axis):
    q, centre = posture_and_problem(human, name, problem)
    across = np.eye(3) - (np.outer(axis, axis) if axis else 0)
    for digit, chain in hand_frames(q).items():
        away = across @ (chain[-1][:3, 3] - centre)
        distance = np.linalg.norm(away)
        assert distance - radius == pytest.approx(RADIUS, abs=0.02e-3)
        assert chain[-1][:3, PALMAR[digit]] @ -away / distance > np.cos(np.radians(40))
        for one, other in pairwise(chain[1:]):  # flesh of 7 mm around every bone
            for share in np.linspace(0, 1, 20):
                point = one[:3, 3] + share * (other[:3, 3] - one[:3, 3])
                assert np.linalg.norm(across @ (point - centre)) - radius > 6.9e-3
    assert centre[2] + radius <= -11.9e-3  # 12 mm of palm


@pytest.mark.parametrize("name", ["ball", "glass", "mean", "open"])
def test_the_synergies_reach_every_posture(human, santello, name):
    away = human.postures[name] - santello.offset
    z = np.linalg.lstsq(santello.S, away, rcond=None)[0]
    np.testing.assert_allclose(santello.S @ z, away, atol=1e-12)
    if name != "open":
        assert np.abs(away).max() < np.radians(15)


def test_pads_are_round_and_on_the_palmar_side(human):
    for digit in DIGITS:
        pad = human.pads[f"{digit}/tip"]
        assert pad.radius == RADIUS
        np.testing.assert_array_equal(pad.normal, np.eye(3)[PALMAR[digit]])
        np.testing.assert_array_equal(pad.point, ORIGIN)
    straight = np.zeros(20)
    for name, pad in human.pads.items():
        (motion,) = human.kinematics.at(straight, [(pad.link, pad.point)])
        if not name.startswith("thumb"):  # its own palmar side turns toward the fingers only when it is bent
            np.testing.assert_allclose(motion.rotation @ pad.normal, [0, 0, -1], atol=1e-12)
