"""The Brown-Asada-like hand: the geometry of the human hand, two principal components, declared compliance."""

from __future__ import annotations

import numpy as np
import pytest
from paradigmatic_hand import JOINTS, hand_frames

from synergrip.hands.folder import load_hand
from synergrip.hands.synergies.select import select

ORIGIN = np.zeros(3)


@pytest.fixture(scope="module")
def hand():
    return load_hand("brown-asada-like")


@pytest.mark.parametrize("seed", range(5))
def test_the_geometry_is_that_of_the_human_hand(hand, seed):
    q = np.random.default_rng(seed).uniform([j.lower for j in hand.joints], [j.upper for j in hand.joints])
    for digit, chain in hand_frames(q).items():
        (tip,) = hand.kinematics.at(q, [(f"{digit}_tip", ORIGIN)])
        np.testing.assert_allclose(tip.position, chain[-1][:3, 3], rtol=0, atol=1e-9)
        np.testing.assert_allclose(tip.rotation, chain[-1][:3, :3], rtol=0, atol=1e-9)


def test_joints_pads_and_postures_are_those_of_the_human_hand(hand):
    human = load_hand("human")
    assert hand.joints == human.joints
    assert hand.pads.keys() == human.pads.keys()
    for name, pad in hand.pads.items():
        assert (pad.link, pad.radius, *pad.point) == (
            human.pads[name].link, human.pads[name].radius, *human.pads[name].point)  # fmt: skip
    for name in ("mean", "open", "ball"):
        np.testing.assert_array_equal(hand.postures[name], human.postures[name])


def test_the_columns_are_the_first_two_principal_components(hand):
    """Made orthonormal one after the other, the first first."""
    motors = select(hand, None)
    assert motors.synergies == ("motor1", "motor2")
    published = select(load_hand("human"), 2)
    first, second = published.S.T
    cosine = first @ second / np.linalg.norm(first) / np.linalg.norm(second)
    assert np.degrees(np.arccos(cosine)) == pytest.approx(99.2, abs=0.1)  # in the 20 joints they are not orthogonal
    first = first / np.linalg.norm(first)
    second = second - (first @ second) * first
    second = second / np.linalg.norm(second)
    np.testing.assert_allclose(motors.S, np.column_stack([first, second]), rtol=0, atol=1e-15)
    np.testing.assert_array_equal(motors.offset, published.offset)


def test_principal_components_of_postures_that_the_two_columns_make(hand):
    """Recorded in the 20 joints, with the first synergy used more than the second: the same two columns come out."""
    motors = select(hand, None)
    z = np.random.default_rng(0).normal(size=(50, 2))
    z = np.linalg.qr(z - z.mean(axis=0))[0] * [3.0, 1.0]  # centred, uncorrelated, of unequal size
    postures = motors.offset + z @ motors.S.T
    components = np.linalg.svd(postures - postures.mean(axis=0))[2][:2].T
    np.testing.assert_allclose(np.abs(np.sum(components * motors.S, axis=0)), 1, atol=1e-12)


def test_the_passive_joints_yield_most(hand):
    """Ab/adduction and fingertips ten times more than the joints that the tendons bend."""
    compliance = dict(zip(JOINTS, np.diag(hand.C_q), strict=True))
    for joint, value in compliance.items():
        passive = not joint.startswith("thumb") and joint.endswith(("_abd", "_dip"))
        assert value == (2.0 if passive else 0.2), joint
    np.testing.assert_array_equal(hand.C_q, np.diag(np.diag(hand.C_q)))
    np.testing.assert_array_equal(select(hand, None).effort_limits, [0.5, 0.5])
