"""What the first K Santello synergies control, computed from the published tables alone, against the library.

Nothing here comes from the statics of the library: kinematics from Denavit-Hartenberg rows, Jacobians from the joint
axes, contacts from the shape of the object, ranks from singular values. The problem and hand files are read as plain
TOML for the posture, the place of the object and S.
"""

from __future__ import annotations

import tomllib
from functools import cache

import numpy as np
import pytest
from paradigmatic_hand import DIGITS, JOINTS, RADIUS, hand_frames
from scipy.spatial.transform import Rotation

from synergrip.files import bundled
from synergrip.problems.problem import load_problem
from synergrip.statics.analysis import analyse

PROBLEMS = ("human-ball", "human-glass")
KINDS = ("hard", "soft")
NUMBERS = range(1, 16)

# Five hard fingers have 15 force components, 9 of them internal; S moves the thumb by 4 joints, the middle finger by 2
# and the others by 3, so J S reaches rank 3 + 2 + 3 * 3 = 14, and the thumb can turn about its contact.
HARD = [(k, 0, 0) for k in range(1, 10)] + [(9, k - 9, 0) for k in range(10, 15)] + [(9, 5, 1)]
# Five soft fingers have 20, 14 of them internal; J S reaches rank 4 + 2 + 3 * 3 = 15.
SOFT = [(k, 0, 0) for k in range(1, 15)] + [(14, 1, 0)]
TABLE = {"hard": HARD, "soft": SOFT}

LEAST_COUNTED, LARGEST_ZERO = 1e-3, 1e-14


@cache
def read(path: str):
    return tomllib.loads((bundled(path.split("/")[0]) / path.partition("/")[2]).read_text(encoding="utf-8"))


def degrees(text: str) -> float:
    number, unit = text.split()
    assert unit == "deg"
    return np.radians(float(number))


def metres(text: str) -> float:
    number, unit = text.split()
    assert unit == "mm"
    return float(number) * 1e-3


def posture(problem):
    joints = read("models/hands/human/hand.toml")["postures"][problem["hand"]["posture"]]["joints"]
    return np.array([degrees(joints[name]) for name in JOINTS])


def synergy_matrix():
    file = read("models/hands/human/santello.toml")
    assert tuple(file["joints"]) == JOINTS
    return np.array(file["S"])


def nearest(body, point):
    """Return the point of the object's surface nearest to a point outside, and the inward normal there."""
    centre = np.array([metres(text) for text in body["position"]])
    away = point - centre
    shape = body["shape"]
    if "cylinder" in shape:  # the side; its axis is the z axis, turned
        vector = np.array(body["orientation"]["axis"])
        turn = Rotation.from_rotvec(vector / np.linalg.norm(vector) * degrees(body["orientation"]["angle"]))
        axis = turn.apply([0.0, 0.0, 1.0])
        along = away @ axis
        assert abs(along) < metres(shape["cylinder"]["height"]) / 2
        centre = centre + along * axis
        away = point - centre
    radius = metres(next(iter(shape.values()))["radius"])
    outward = away / np.linalg.norm(away)
    assert np.linalg.norm(away) - radius == pytest.approx(RADIUS, abs=0.05e-3)
    return centre + radius * outward, -outward


def contacts(name):
    """Return, for each digit, the contact point, the inward normal and the frames of its chain."""
    problem = read(f"problems/{name}.toml")
    assert problem["contacts"]["at"] == [f"{digit}/tip" for digit in DIGITS]
    chains = hand_frames(posture(problem))
    # a round pad touches with its own surface, which is that of the object up to the rounding of the posture
    found = {}
    for digit, chain in chains.items():
        point, normal = nearest(problem["object"], chain[-1][:3, 3])
        found[digit] = (chain[-1][:3, 3] + RADIUS * normal, normal, chain, point)
    return found


def system(name, kind):
    """Return J S and G', rotations times the mean distance of the contacts from their centroid."""
    found = contacts(name)
    middle = np.mean([point for point, *_ in found.values()], axis=0)
    length = np.mean([np.linalg.norm(point - middle) for point, *_ in found.values()])
    J, Gt = [], []
    for index, (point, normal, chain, _) in enumerate(found.values()):
        tangents = np.linalg.svd(normal[None, :])[2][1:]
        for direction in (normal, *tangents):
            row = np.zeros(20)
            row[4 * index : 4 * index + 4] = [direction @ np.cross(f[:3, 2], point - f[:3, 3]) for f in chain[:-1]]
            J.append(row)
            Gt.append(np.concatenate([direction, np.cross(point - middle, direction) / length]))
        if kind == "soft":
            row = np.zeros(20)
            row[4 * index : 4 * index + 4] = [length * normal @ frame[:3, 2] for frame in chain[:-1]]
            J.append(row)
            Gt.append(np.concatenate([np.zeros(3), normal]))
    return np.array(J) @ synergy_matrix(), np.array(Gt)


def rank(matrix, size):
    """Return the rank; every singular value must be far from a doubt."""
    values = np.linalg.svd(matrix, compute_uv=False) / size
    assert not np.any((values > LARGEST_ZERO) & (values < LEAST_COUNTED)), values
    return int(np.sum(values > LEAST_COUNTED))


def dimensions(name, kind, number):
    """Return dim E_s, dim Gamma_ucs, dim Gamma_zr of the first `number` synergies, from ranks alone."""
    JS, Gt = system(name, kind)
    JS = JS[:, :number]
    size = np.linalg.norm(JS, 2)
    assert rank(Gt, np.linalg.norm(Gt, 2)) == 6
    held = np.linalg.qr(Gt)[0]
    moving = rank(JS, size)
    internal = rank(JS - held @ (held.T @ JS), size)
    return internal, moving - internal, number - moving


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", PROBLEMS)
def test_dimensions_of_the_first_synergies(name, kind):
    """(34) in every row; the library agrees with the computation above and with the count of forces and joints."""
    for number, expected in zip(NUMBERS, TABLE[kind], strict=True):
        assert sum(expected) == number
        assert dimensions(name, kind, number) == expected
        problem = load_problem(name, [f"hand.synergies={number}", f"contacts.model={kind}"])
        spaces = analyse(problem.grasp).spaces
        assert spaces.dimensions == expected
        assert not spaces.ambiguous


@pytest.mark.parametrize("name", PROBLEMS)
def test_the_jacobians_are_difference_quotients(name):
    """The axes above against the motion of the material point of the link that is at the contact."""
    q = posture(read(f"problems/{name}.toml"))
    step = 1e-6
    for index, (digit, (point, _, chain, _)) in enumerate(contacts(name).items()):
        local = np.linalg.solve(chain[-1], [*point, 1])
        for joint in range(4):
            move = np.zeros(20)
            move[4 * index + joint] = step
            ends = [hand_frames(q + sign * move)[digit][-1] @ local for sign in (1, -1)]
            axis = np.cross(chain[joint][:3, 2], point - chain[joint][:3, 3])
            np.testing.assert_allclose((ends[0] - ends[1])[:3] / (2 * step), axis, atol=1e-9)


@pytest.mark.parametrize("name", PROBLEMS)
def test_contacts_are_where_the_library_has_them(name):
    grasp = load_problem(name).grasp
    centre = np.array([metres(text) for text in read(f"problems/{name}.toml")["object"]["position"]])
    for contact, (point, normal, _, surface) in zip(grasp.contacts, contacts(name).values(), strict=True):
        np.testing.assert_allclose(contact.point + centre, point, atol=1e-12)
        np.testing.assert_allclose(contact.frame[:, 0], normal, atol=1e-12)
        np.testing.assert_allclose(point, surface, atol=0.02e-3)


@pytest.mark.parametrize("name", PROBLEMS)
def test_all_synergies_move_the_object_as_the_middle_finger_lets_them(name):
    """No synergy moves the middle finger sideways, so its contact stays in its plane: 5 of 6 motions are left."""
    spaces = analyse(load_problem(name, ["hand.synergies=15", "contacts.model=hard"]).grasp).spaces
    centre = np.array([metres(text) for text in read(f"problems/{name}.toml")["object"]["position"]])
    point = contacts(name)["middle"][0] - centre
    sideways = np.concatenate([[1.0, 0, 0], np.cross(point, [1.0, 0, 0])])  # x velocity of the contact, per twist
    assert spaces.Gamma_ucs.shape == (6, 5)
    np.testing.assert_allclose(sideways @ spaces.Gamma_ucs, 0, atol=1e-12)


@pytest.mark.parametrize("name", PROBLEMS)
def test_the_redundant_synergy_turns_the_thumb_about_its_contact(name):
    spaces = analyse(load_problem(name, ["hand.synergies=15", "contacts.model=hard"]).grasp).spaces
    joints = (synergy_matrix() @ spaces.Gamma_zr)[:, 0]
    np.testing.assert_allclose(joints[4:], 0, atol=1e-12)
    assert np.abs(joints[:4]).max() > 0.1
