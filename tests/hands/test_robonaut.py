"""Robonaut 1 hand against the numbers of GraspIt! (models/robots/Robonaut), carried over here in its units: mm, deg."""

import math

import numpy as np
import pytest
from denavit_hartenberg import frames, orthonormal, row
from pad_motion import pads_at, push, urdf_efforts
from published_hands import check_fingertip, check_frames

from synergrip.hands.folder import load_hand
from synergrip.hands.synergies.select import select
from synergrip.problems.problem import load_problem

DEG = math.pi / 180
ORIGIN = np.zeros(3)
FINGER = [(0, 0, 8.0518, 90), (-5.9, 0, 45.72, 0), (0, 0, 26.67, 0), (5.9, 0, 0, 0)]
# finger -> theta offset, d, a, alpha of each row
TABLES = {
    "thumb": [(0, 0, 6.35, 90), (8.9, 0, 46.8376, 0), (0, 0, 0, 0)],
    "index": FINGER,
    "middle": FINGER,
    "ring": [(0, 0, 10.287, -20.3269), (-86.3, -103.9876, 40.6908, 0), (0.71, 0, 26.67, 0), (5.95, 0, 0, 0)],
    "little": [(0, 0, 13.4874, -12.89), (-82.5, -200.2536, 40.6908, 0), (0.71, 0, 26.67, 0), (5.95, 0, 0, 0)],
}
# as printed: rotations with 6 digits, column by column
BASES = {
    "thumb": (
        (46.183982, -26.490473, 5.890768),
        (0.56107, -0.820276, -0.111118, 0.145778, 0.230056, -0.962197, 0.814831, 0.523661, 0.248656),
    ),
    "index": (
        (87.883873, -27.044726, -16.619068),
        (0.997205, -0.074709, 0, 0.074425, 0.993411, -0.087156, 0.006511, 0.086912, 0.996195),
    ),
    "middle": (
        (87.99289, -2.454097, -16.587521),
        (0.999943, -0.010702, 0, 0.010701, 0.99979, 0.017452, -0.000187, -0.017451, 0.999848),
    ),
    "ring": (
        (114.90731, -81.002175, -27.312264),
        (0.173619, 0.025764, 0.984476, -0.818652, -0.551893, 0.158818, 0.547417, -0.833517, -0.074727),
    ),
    "little": (
        (157.7787, -146.27967, -33.164526),
        (0.229772, 0.063839, 0.971148, -0.804698, -0.548793, 0.226466, 0.547417, -0.833517, -0.074727),
    ),
}
PARTS = {
    "thumb": ("cmc", "mcp", "ip"),
    **dict.fromkeys(("index", "middle"), ("abduction", "mcp", "pip", "dip")),
    **dict.fromkeys(("ring", "little"), ("metacarpal", "mcp", "pip", "dip")),
}
JOINTS = tuple(f"{finger}_{part}" for finger, parts in PARTS.items() for part in parts)
THREE = [(0, 85), (0, 85), (0, 85)]
RANGES = [
    *[(-60, 5), (-30, 85), (0, 75)],
    *(2 * [(-20, 10), (-10, 85), (0, 85), (0, 85)]),
    *(2 * [(0, 30), *THREE]),
]
# d0 to d13
FREE = (
    *("thumb_cmc", "thumb_mcp", "thumb_ip", "index_abduction", "index_mcp", "index_pip"),
    *("middle_abduction", "middle_mcp", "middle_pip", "little_metacarpal", "ring_mcp", "ring_pip"),
    *("little_mcp", "little_pip"),
)
EIGENGRASPS = [
    [0.75, 1.0, 0.0, -0.2, 0.8, -0.5, 0.0, 0.8, -0.5, 1.0, 0.8, -0.5, 0.8, -0.5],
    [1.0, 0.75, 0.4, 0.5, -0.5, -0.1, 0.0, -0.5, -0.1, 0.0, -0.5, -0.1, -0.5, -0.1],
]
ORIGIN_OF_EIGENGRASPS = [-0.7, 0.77, 0.5, 0.09, 0.83, 0.74, 0.09, 0.83, 0.74, 0.26, 0.74, 0.74, 0.74, 0.74]
# contacts on the fingertips, in the frame after the last row: place, normal
CONTACTS = {
    "thumb": ((19.787303, 4.012848, 0.163917), (0.287447, 0.957796, 0)),
    "index": ((15.472091, 4.266047, 0.150033), (0.300277, 0.953852, 0)),
    "middle": ((15.323967, 4.312677, 0.021788), (0.300277, 0.953852, 0)),
    "ring": ((15.253707, 4.334795, -0.281625), (0.300277, 0.953852, 0)),
    "little": ((16.465145, 3.953429, 0.309207), (0.300277, 0.953852, 0)),
}
# contacts on the other links, in the frame after the row that ends the link, and the length of that row
MIDDLE = ((-15.262109, 6.809919, -0.120936), (-0.013401, 0.999910, 0), 26.67)
PROXIMAL = {
    "thumb": ((-19.408739, 4.535237, 0.974020), (-0.081198, 0.996698, 0), 46.8376),
    **dict.fromkeys(("index", "middle"), ((-23.171091, 7.468795, 0.156179), (0.055376, 0.998466, 0), 45.72)),
    **dict.fromkeys(("ring", "little"), ((-21.887126, 7.530194, -0.260726), (0.064822, 0.997897, 0), 40.6908)),
}
PALM = ((44.642788, 5.236737, 8.223241), (0.569836, 0.245236, 0.784312), 0)
TIPS = [f"{finger}/tip" for finger in ("index", "middle", "ring", "little")]


@pytest.fixture(scope="module")
def hand():
    return load_hand("robonaut")


def printed(finger):
    place, columns = BASES[finger]
    frame = np.eye(4)
    frame[:3, :3] = np.reshape(columns, (3, 3)).T
    frame[:3, 3] = np.array(place) / 1e3
    return frame


def driven(values):
    """Return the joint values (19,) that 14 degrees of freedom stand for."""
    free = dict(zip(FREE, values, strict=True))
    follow = {f"{finger}_dip": free[f"{finger}_pip"] for finger in ("index", "middle", "ring", "little")}
    return np.array([{**free, **follow, "ring_metacarpal": 0.5 * free["little_metacarpal"]}[name] for name in JOINTS])


def chain(finger, angles):
    """Return the frames of the links of a finger and of its tip."""
    rows = [(offset * DEG, d / 1e3, a / 1e3, alpha * DEG) for offset, d, a, alpha in TABLES[finger]]
    before = [orthonormal(printed(finger)), *frames(orthonormal(printed(finger)), rows, angles)]
    slides = [each[1] for each in rows]
    if finger in ("ring", "little"):
        slides[0] = rows[1][1]  # the metacarpal frames stand in the palm, further along their own axes
    links = [
        frame @ row(each[0] + angle, slide, 0, 0)
        for frame, each, angle, slide in zip(before[:-1], rows, angles, slides, strict=True)
    ]
    return [*links, before[-1]]


@pytest.mark.parametrize("seed", range(10))
def test_the_frames_are_those_of_graspit(hand, seed):
    values = dict(zip(JOINTS, np.random.default_rng(seed).uniform(-1.5, 1.5, 19), strict=True))
    q = np.array([values[name] for name in hand.joint_names])
    for finger, parts in PARTS.items():
        links = [*(f"{finger}_{part}_link" for part in parts), f"{finger}_tip"]
        expected = chain(finger, [values[f"{finger}_{part}"] for part in parts])
        check_frames(hand, q, links, expected)


@pytest.mark.parametrize("finger", BASES)
def test_the_printed_rotations_are_nearly_orthonormal(finger):
    np.testing.assert_allclose(orthonormal(printed(finger)), printed(finger), rtol=0, atol=1e-6)


def test_the_metacarpals_start_in_the_palm(hand):
    for finger in ("ring", "little"):
        (motion,) = hand.kinematics.at(np.zeros(19), [(f"{finger}_metacarpal_link", ORIGIN)])
        assert 0.04 < motion.position[0] < 0.07
        assert abs(motion.position[1]) < 0.03


def test_joints_ranges_and_couplings_are_those_of_graspit(hand):
    assert hand.joint_names == JOINTS
    np.testing.assert_allclose([(j.lower / DEG, j.upper / DEG) for j in hand.joints], RANGES, rtol=1e-12, atol=1e-12)
    expected = {f"{finger}_dip": {f"{finger}_pip": 1.0} for finger in ("index", "middle", "ring", "little")}
    expected["ring_metacarpal"] = {"little_metacarpal": 0.5}
    assert {name: dict(coupling.ratios) for name, coupling in hand.couplings.items()} == expected
    assert all(coupling.offset == 0 for coupling in hand.couplings.values())


def test_the_eigengrasps_are_those_of_graspit(hand):
    eigengrasps = select(hand, None)
    assert eigengrasps.name == "eigengrasps"
    np.testing.assert_allclose(eigengrasps.S, np.column_stack([driven(e) for e in EIGENGRASPS]), atol=1e-15)
    np.testing.assert_allclose(eigengrasps.offset, driven(ORIGIN_OF_EIGENGRASPS), atol=1e-15)
    np.testing.assert_allclose(hand.postures["origin"], driven(ORIGIN_OF_EIGENGRASPS), atol=1e-15)


def test_fourteen_degrees_of_freedom_move_nineteen_joints(hand):
    free = select(hand, "free")
    assert free.synergies == FREE
    np.testing.assert_array_equal(free.S, np.column_stack([driven(e) for e in np.eye(14)]))


def test_torque_limits_share_89_newtons_among_four_straight_fingers(hand):
    force = 20 * 4.4482216 / 4
    finger = {"mcp": 45.72 + 26.67 + 14.05, "pip": 26.67 + 14.05, "dip": 14.05}
    thumb = {"cmc": 46.8376 + 18.58, "mcp": 46.8376 + 18.58, "ip": 18.58}
    for joint in hand.joints:
        digit, part = joint.name.split("_")
        lever = thumb[part] if digit == "thumb" else finger.get(part, finger["mcp"])
        assert joint.torque_limit == pytest.approx(force * lever / 1e3, abs=0.05)
    assert urdf_efforts("robonaut") == {joint.name: joint.torque_limit for joint in hand.joints}
    np.testing.assert_array_equal(hand.C_q, 0.025 * np.eye(19))


@pytest.mark.parametrize("finger", CONTACTS)
def test_fingertips_pass_through_the_contacts_of_graspit(hand, finger):
    pad = hand.pads[f"{finger}/tip"]
    place, normal = np.array(CONTACTS[finger][0]) / 1e3, np.array(CONTACTS[finger][1])
    check_fingertip(pad, place, normal)
    np.testing.assert_allclose(pad.normal, normal, rtol=0, atol=2e-4)
    assert pad.point[1] == pad.point[2] == 0


def test_the_other_pads_are_those_of_graspit(hand):
    expected = {f"{finger}/proximal": PROXIMAL[finger] for finger in PARTS}
    expected |= {f"{finger}/middle": MIDDLE for finger in PARTS if finger != "thumb"}
    for name, (place, normal, length) in {**expected, "palm": PALM}.items():
        pad = hand.pads[name]
        np.testing.assert_allclose(1e3 * pad.point, place + np.array([length, 0, 0]), rtol=0, atol=0.006)
        np.testing.assert_allclose(pad.normal, normal, rtol=0, atol=2e-4)


@pytest.mark.parametrize("finger", PARTS)
def test_pads_push_the_closing_way(hand, finger):
    q = hand.postures["origin"]
    last, first = PARTS[finger][-1], "mcp"
    assert push(hand, q, f"{finger}/tip", f"{finger}_{last}") > 0.9
    assert push(hand, q, f"{finger}/proximal", f"{finger}_{first}") > 0.9
    if finger != "thumb":
        assert push(hand, q, f"{finger}/middle", f"{finger}_pip") > 0.8


def test_fingers_side_by_side_above_a_palm_that_faces_up(hand):
    points, normals, _ = pads_at(hand, hand.postures["open"], ["palm", "thumb/tip", *TIPS])
    assert normals[0, 2] > 0.75
    assert np.all(normals[2:, 2] > 0.9)
    assert np.all(np.diff(points[1:, 1]) > 0.01)  # thumb, index, ... little toward +y
    assert np.all(points[2:, 0] > 0.16)


@pytest.mark.parametrize("problem", ["robonaut-handle", "robonaut-handle-eigengrasps"])
def test_palm_and_fingertips_touch_the_handle_and_nothing_else_does(problem):
    held = load_problem(problem).held
    names = ["palm", *TIPS, *(name for name in held.hand.pads if name not in ("palm", *TIPS))]
    points, normals, radii = pads_at(held.hand, held.q, names)
    axis = np.array([1, -2, 0]) / math.sqrt(5)
    arm = points - np.array([0.0701, -0.010, 0.0234])
    along = arm @ axis
    across = arm - along[:, None] * axis
    distance = np.linalg.norm(across, axis=1)
    gaps = distance - radii - 0.022
    assert np.abs(gaps[:5]).max() < 5e-5
    assert np.abs(along[:5]).max() < 0.05
    facing = -np.sum(normals[:5] * across[:5], axis=1) / distance[:5]
    assert np.all(facing > math.cos(32 * DEG))
    assert np.all((gaps[5:] > 5e-3) | (np.abs(along[5:]) > 0.06 + radii[5:]))
    # the palm pushes against the fingertips
    assert normals[0] @ normals[1:5].sum(axis=0) < 0
