"""GraspIt's human hand against its published numbers, computed here without the library."""

from __future__ import annotations

import tomllib
from itertools import pairwise

import numpy as np
import pytest
from denavit_hartenberg import frames, orthonormal

from synergrip.files import bundled
from synergrip.hands.folder import load_hand
from synergrip.hands.synergies.select import select

DIGITS = ("index", "middle", "ring", "little", "thumb")
FINGER = ("mcp_abd", "mcp_flex", "pip", "dip")
JOINTS = (*(f"{digit}_{joint}" for digit in DIGITS[:4] for joint in FINGER),
          *(f"thumb_{joint}" for joint in ("tmc_1", "tmc_2", "mcp", "ip")))  # fmt: skip
ORIGIN = np.zeros(3)
RADIUS = 8e-3

# models/robots/HumanHand/HumanHand20DOF.xml: mm and degrees
PLACES = [(-140.0599, 11.2048, 36.4156), (-145.6623, 11.2048, 8.4036), (-145.6623, 5.6025, -19.6084),
          (-134.4575, -8.4035, -42.0180), (-50.6241, -11.5082, 18.9317)]  # fmt: skip
FINGER_ROTATION = np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]])  # -90 deg about x
THUMB_ROTATION = np.array([-0.1486, -0.9003, 0.4089, 0.2665, 0.3618, 0.8933, -0.9522, 0.2418, 0.1862])
FINGER_LENGTHS = [(43.19, 29.56, 25.35), (46.20, 30.99, 29.20), (39.12, 28.31, 24.48), (29.91, 21.10, 23.16)]
THUMB_ROWS = [(0.0, 0.0, 90.0), (49.5, 52.1193, 44.0), (5.0, 40.7638, 0.0), (85.0, 0.0, 90.0)]  # theta, a, alpha
LIMITS = [(-20, 20), *[(-10, 90)] * 3, (-10, 10), *[(-10, 90)] * 3, (-20, 20), *[(-10, 90)] * 3,
          (-30, 30), *[(-10, 90)] * 3, (-10, 70), (-50, 25), (0, 90), (0, 100)]  # fmt: skip

# virtual/all_18_contacts_20DOF.xml: location (mm) and normal in the frame after the row of the link
CONTACTS = {
    ("index", "proximal"): ((12.498827, -14.702180, 0.223169), (-0.224224, -0.953396, -0.201892)),
    ("index", "middle"): ((12.393588, -10.750588, 1.778760), (0.0, -0.993431, -0.114433)),
    ("index", "tip"): ((7.673563, -8.898114, -1.846830), (-0.174234, -0.981289, -0.081939)),
    ("middle", "proximal"): ((15.466266, -11.878997, -0.408026), (-0.028005, -0.998919, 0.037106)),
    ("middle", "middle"): ((9.920573, -9.043736, 0.344870), (0.003113, -0.999046, 0.043552)),
    ("middle", "tip"): ((10.883502, -8.161409, -2.397825), (-0.093927, -0.992601, -0.076947)),
    ("ring", "proximal"): ((9.889092, -9.275124, 4.166492), (0.023792, -0.993431, 0.111933)),
    ("ring", "middle"): ((12.607641, -9.717265, -1.126643), (0.067262, -0.993431, 0.092579)),
    ("ring", "tip"): ((5.681996, -9.588638, -0.965293), (-0.259259, -0.878924, 0.400348)),
    ("little", "proximal"): ((10.073174, -8.178876, 4.820212), (0.079469, -0.942194, 0.325507)),
    ("little", "middle"): ((11.752750, -8.997961, 1.307965), (-0.110394, -0.993604, -0.023741)),
    ("little", "tip"): ((8.162394, -9.657296, 4.372953), (-0.084421, -0.912466, 0.400348)),
    ("thumb", "proximal"): ((-4.307915, 8.952741, 2.748010), (0.058300, 0.957420, 0.282749)),
    ("thumb", "tip"): ((7.997736, 4.978417, 26.406963), (0.923429, 0.145658, 0.355052)),
}
ROW = {"proximal": 1, "middle": 2, "tip": 3}
PALM = {
    "heel": ((-118.937367, -8.107899, 0.186058), (-0.191632, -0.981466, 0.000909)),
    "hypothenar": ((-119.188783, -19.162138, -22.127575), (-0.282323, -0.855461, 0.434143)),
    "ulnar": ((-144.888734, -12.750508, -20.230721), (-0.293189, -0.861029, 0.415534)),
    "radial": ((-145.854579, -7.149010, 9.061656), (-0.080172, -0.993555, -0.080126)),
}


@pytest.fixture(scope="module")
def hand():
    return load_hand("human-graspit")


def base(k, exact=True):
    placed = np.eye(4)
    placed[:3, :3] = FINGER_ROTATION if k < 4 else THUMB_ROTATION.reshape(3, 3).T  # nine numbers, column by column
    placed[:3, 3] = np.array(PLACES[k]) * 1e-3
    return orthonormal(placed) if exact else placed


def rows(k):
    table = [(0.0, 0.0, 90.0), *((0.0, -a, 0.0) for a in FINGER_LENGTHS[k])] if k < 4 else THUMB_ROWS
    return [(np.radians(theta), 0.0, a * 1e-3, np.radians(alpha)) for theta, a, alpha in table]


def hand_frames(q, exact=True):
    angles = np.asarray(q).reshape(5, 4)
    return {digit: frames(base(k, exact), rows(k), angles[k]) for k, digit in enumerate(DIGITS)}


def random_posture(seed):
    return np.random.default_rng(seed).uniform(*np.radians(LIMITS).T)


@pytest.mark.parametrize("seed", range(20))
def test_the_frames_are_those_of_the_table(hand, seed):
    q = random_posture(seed)
    for k, (digit, chain) in enumerate(hand_frames(q).items()):
        links = [joint.link for joint in hand.joints if joint.name.startswith(digit)]
        found = hand.kinematics.at(q, [(link, ORIGIN) for link in (*links, f"{digit}_tip")])
        for motion, frame in zip(found, [base(k), *chain], strict=True):
            np.testing.assert_allclose(motion.position, frame[:3, 3], rtol=0, atol=1e-9)
            np.testing.assert_allclose(motion.rotation[:, 2], frame[:3, 2], rtol=0, atol=1e-9)
        np.testing.assert_allclose(found[-1].rotation, chain[-1][:3, :3], rtol=0, atol=1e-9)


def test_four_digits_of_the_thumb_rotation_are_a_hundredth_of_a_millimetre():
    printed = base(4, exact=False)[:3, :3]
    np.testing.assert_allclose(printed @ printed.T, np.eye(3), atol=2.2e-4)
    for seed in range(50):
        q = random_posture(seed)
        given, repaired = (hand_frames(q, exact)["thumb"][-1][:3, 3] for exact in (False, True))
        assert np.linalg.norm(given - repaired) < 0.012e-3


def test_joints_and_limits_are_as_published(hand):
    assert hand.joint_names == JOINTS
    np.testing.assert_allclose([(j.lower, j.upper) for j in hand.joints], np.radians(LIMITS), atol=1e-15)


@pytest.mark.parametrize("spot", CONTACTS, ids="/".join)
def test_pads_touch_where_the_published_contacts_are(hand, spot):
    digit, part = spot
    q = random_posture(3)
    frame = hand_frames(q)[digit][ROW[part]] if digit != "thumb" or part == "tip" else hand_frames(q)[digit][2]
    location, normal = (np.array(values) for values in CONTACTS[spot])
    normal = normal / np.linalg.norm(normal)
    pad = hand.pads["/".join(spot)]
    (motion,) = hand.kinematics.at(q, [(pad.link, pad.point)])
    pushing = motion.rotation @ pad.normal
    assert pad.radius == RADIUS
    np.testing.assert_allclose(pushing, frame[:3, :3] @ normal, atol=1e-4)
    surface = motion.position + RADIUS * pushing
    np.testing.assert_allclose(surface, frame[:3, :3] @ location * 1e-3 + frame[:3, 3], atol=2e-6)


def test_palm_pads_are_the_published_contacts(hand):
    for name, (location, normal) in PALM.items():
        pad = hand.pads[f"palm/{name}"]
        assert (pad.link, pad.radius) == ("palm", 0.0)
        np.testing.assert_allclose(pad.point, np.array(location) * 1e-3, atol=1e-6)
        np.testing.assert_allclose(pad.normal, normal, atol=1e-4)


@pytest.mark.parametrize(("name", "count"), [("cgdb", 6), ("cgdb_refined", 6), ("hand_made", 2)])
def test_synergy_sets_have_their_origin_within_the_limits(hand, name, count):
    chosen = select(hand, name)
    assert chosen.S.shape == (20, count)
    for joint, value in zip(hand.joints, chosen.offset, strict=True):
        assert joint.lower < value < joint.upper
    np.testing.assert_allclose(chosen.S[JOINTS.index("middle_mcp_abd")], 0, atol=1e-16)
    products = chosen.S.T @ chosen.S
    if name == "hand_made":
        np.testing.assert_allclose(products, [[10.495, -0.02], [-0.02, 10.36]], atol=1e-9)
    else:
        np.testing.assert_allclose(products, np.eye(count), atol=2e-5)


def test_sets_in_their_order_with_the_published_corners(hand):
    assert list(hand.synergy_sets) == ["cgdb", "cgdb_refined", "hand_made", "joints"]
    corners = {"cgdb": (0.034087, -0.087935, 0.034786), "cgdb_refined": (0.050409, -0.01094, -0.19021)}
    for name, (first, last, end) in corners.items():
        S = select(hand, name).S
        assert (S[0, 0], S[-1, 0], S[-1, -1]) == (first, last, end)


def test_the_origin_of_the_default_set_is_as_published(hand):
    radians = [0.19197, 0.47323, 0.67992, 0.27881, 0.0, 0.49347, 0.82186, 0.25013, -0.2005, 0.5056, 0.72864, 0.39479,
               -0.29755, 0.42906, 0.35904, 0.19415, 0.10917, -0.74088, 0.73897, 0.046224]  # fmt: skip
    np.testing.assert_array_equal(select(hand, None).offset, radians)


def test_flexion_closes_toward_the_palm_and_the_thumb_opposes(hand):
    """The palm looks to -y, as the normals of its contacts do; fingers point to -x, the thumb is on the side of +z."""
    mean = hand.postures["mean"]
    start = hand_frames(mean)
    for k, digit in enumerate(DIGITS[:4]):
        flexed = mean.copy()
        flexed[4 * k + 1] += 0.1
        motion = hand_frames(flexed)[digit][-1][:3, 3] - start[digit][-1][:3, 3]
        assert motion @ [0.5, -1, 0] > 1e-3
    points = {digit: _round_pad(hand, mean, digit) for digit in DIGITS}
    others = np.mean([points[digit][0] for digit in DIGITS[:4]], axis=0)
    facing = others - points["thumb"][0]
    assert points["thumb"][1] @ facing / np.linalg.norm(facing) > np.cos(np.radians(35))
    # the first eigengrasp extends all fingers
    assert np.all(select(hand, None).S[[1, 5, 9, 13], 0] < -0.3)


def _round_pad(hand, q, digit):
    pad = hand.pads[f"{digit}/tip"]
    (motion,) = hand.kinematics.at(q, [(pad.link, pad.point)])
    return motion.position, motion.rotation @ pad.normal


def test_the_ball_posture_touches_with_five_round_pads(hand):
    file = tomllib.loads((bundled("problems") / "human-graspit-ball.toml").read_text(encoding="utf-8"))
    centre = np.array([float(text.split()[0]) for text in file["object"]["position"]]) * 1e-3
    q, radius = hand.postures["ball"], 45e-3
    for digit in DIGITS:
        point, pushing = _round_pad(hand, q, digit)
        away = point - centre
        assert np.linalg.norm(away) - radius == pytest.approx(RADIUS, abs=0.02e-3)
        assert -away @ pushing / np.linalg.norm(away) > np.cos(np.radians(40))
        chain = hand_frames(q)[digit]
        for one, other in pairwise(chain):
            for share in np.linspace(0, 1, 20):
                assert np.linalg.norm(one[:3, 3] + share * (other - one)[:3, 3] - centre) - radius > 7e-3
    for location, _ in PALM.values():
        assert np.linalg.norm(np.array(location) * 1e-3 - centre) - radius > 10e-3
    assert np.abs(q - hand.postures["mean"]).max() < np.radians(11)
