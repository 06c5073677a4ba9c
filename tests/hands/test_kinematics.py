import pickle
import re
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from synergrip.errors import InputError
from synergrip.files import bundled
from synergrip.hands.kinematics import kinematics
from synergrip.hands.models.urdf import read_urdf

BARRETT = bundled("models") / "hands" / "barrett" / "hand.urdf"
POINT = np.array([0.01, -0.02, 0.03])
TIPS = [(f"finger{k}_tip", POINT) for k in (1, 2, 3)]

SLIDER = """<robot name="r">
  <link name="world"/>
  <link name="rail"><inertial><mass value="0"/></inertial></link>
  <link name="crank">
    <visual><geometry><mesh filename="package://nowhere/crank.stl"/></geometry></visual>
    <collision><geometry><mesh filename="/not/here.dae"/></geometry></collision>
  </link>
  <link name="tip"/>
  <joint name="slide" type="prismatic">
    <parent link="world"/><child link="rail"/><axis xyz="0 3 0"/><limit lower="0" upper="1"/>
  </joint>
  <joint name="turn" type="continuous">
    <parent link="rail"/><child link="crank"/><origin xyz="1 0 0" rpy="0.3 -0.4 0.5"/><axis xyz="0 0 1"/>
  </joint>
  <joint name="end" type="fixed"><parent link="crank"/><child link="tip"/><origin xyz="0 0 0.5" rpy="0 1 0"/></joint>
</robot>
"""


def barrett(order=None):
    urdf = read_urdf(BARRETT)
    return kinematics(urdf, order or urdf.moving)


def slider(tmp_path):
    path = tmp_path / "slider.urdf"
    path.write_text(SLIDER, encoding="utf-8")
    return kinematics(read_urdf(path), ("slide", "turn"))


def turn(axis, angle):
    K = np.cross(np.eye(3), np.asarray(axis, float))
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K


def differences(hand, q, points, step=1e-6):
    """Return the Jacobians (6, n_q) by central finite differences."""
    result = [np.zeros((6, len(q))) for _ in points]
    now = hand.at(q, points)
    for j in range(len(q)):
        change = np.eye(len(q))[j] * step
        for after, before, middle, jacobian in zip(
            hand.at(q + change, points), hand.at(q - change, points), now, result, strict=True
        ):
            jacobian[:3, j] = (after.position - before.position) / (2 * step)
            spin = (after.rotation - before.rotation) / (2 * step) @ middle.rotation.T
            jacobian[3:, j] = spin[2, 1], spin[0, 2], spin[1, 0]
    return result


@pytest.mark.parametrize("seed", range(10))
def test_jacobians_are_derivatives(seed):
    hand = barrett()
    q = np.random.default_rng(seed).uniform(-2, 2, 8)
    for motion, jacobian in zip(hand.at(q, TIPS), differences(hand, q, TIPS), strict=True):
        np.testing.assert_allclose(motion.jacobian, jacobian, atol=1e-8)


def test_a_sliding_joint_has_a_jacobian_too(tmp_path):
    hand, q, points = slider(tmp_path), np.array([0.2, 1.1]), [("tip", POINT), ("rail", POINT)]
    for motion, jacobian in zip(hand.at(q, points), differences(hand, q, points), strict=True):
        np.testing.assert_allclose(motion.jacobian, jacobian, atol=1e-8)
    np.testing.assert_allclose(hand.at(q, points)[0].jacobian[:, 0], [0, 1, 0, 0, 0, 0], atol=1e-15)


def test_frames_follow_roll_pitch_yaw_and_missing_meshes_do_not_matter(tmp_path):
    (tip,) = slider(tmp_path).at(np.array([0.2, 1.1]), [("tip", POINT)])
    placed = turn([0, 0, 1], 0.5) @ turn([0, 1, 0], -0.4) @ turn([1, 0, 0], 0.3) @ turn([0, 0, 1], 1.1)
    rotation = placed @ turn([0, 1, 0], 1)
    np.testing.assert_allclose(tip.rotation, rotation, atol=1e-14)
    expected = np.array([1, 0.2, 0]) + placed @ [0, 0, 0.5] + rotation @ POINT
    np.testing.assert_allclose(tip.position, expected, atol=1e-14)


def test_joints_are_mapped_by_name():
    hand, order = barrett(), np.random.default_rng(3).permutation(8)
    other = barrett([hand.joints[i] for i in order])
    q = np.linspace(0.1, 0.8, 8)
    for a, b in zip(hand.at(q, TIPS), other.at(q[order], TIPS), strict=True):
        np.testing.assert_array_equal(a.position, b.position)
        np.testing.assert_array_equal(a.jacobian[:, order], b.jacobian)


def test_the_order_of_the_file_does_not_matter(tmp_path):
    text = BARRETT.read_text(encoding="utf-8")
    blocks = re.findall(r"(?s)<joint.*?</joint>|<link[^>]*/>", text)
    np.random.default_rng(4).shuffle(blocks)
    path = tmp_path / "shuffled.urdf"
    path.write_text(f"<robot name='r'>{''.join(blocks)}</robot>", encoding="utf-8")
    hand, urdf = barrett(), read_urdf(path)
    assert urdf.moving != hand.joints
    q = np.linspace(0.1, 0.8, 8)
    for a, b in zip(hand.at(q, TIPS), kinematics(urdf, hand.joints).at(q, TIPS), strict=True):
        np.testing.assert_allclose(a.position, b.position, atol=1e-15)
        np.testing.assert_allclose(a.jacobian, b.jacobian, atol=1e-15)


def test_calls_leave_nothing_behind():
    hand, q = barrett(), np.linspace(0.1, 0.8, 8)
    before = hand.at(q, TIPS)
    hand.at(-q, TIPS)
    for a, b in zip(before, hand.at(q, TIPS), strict=True):
        np.testing.assert_array_equal(a.position, b.position)
        np.testing.assert_array_equal(a.jacobian, b.jacobian)
    with pytest.raises(ValueError, match="read-only"):
        before[0].jacobian[0, 0] = 1


def test_threads_do_not_disturb_each_other():
    hand, asked = barrett(), np.random.default_rng(7).uniform(-2, 2, (2000, 8))
    alone = [hand.at(q, TIPS) for q in asked]
    with ThreadPoolExecutor(4) as threads:
        together = list(threads.map(lambda q: hand.at(q, TIPS), asked))
    for a, b in zip(alone, together, strict=True):
        for one, other in zip(a, b, strict=True):
            np.testing.assert_array_equal(one.position, other.position)
            np.testing.assert_array_equal(one.jacobian, other.jacobian)


def test_it_can_be_sent_to_another_process():
    hand, q = barrett(), np.linspace(0.1, 0.8, 8)
    copy = pickle.loads(pickle.dumps(hand))
    np.testing.assert_array_equal(copy.at(q, TIPS)[2].jacobian, hand.at(q, TIPS)[2].jacobian)


def test_the_palm_stands_still():
    (palm,) = barrett().at(np.ones(8), [("palm", POINT)])
    np.testing.assert_array_equal(palm.position, POINT)
    np.testing.assert_array_equal(palm.rotation, np.eye(3))
    np.testing.assert_array_equal(palm.jacobian, np.zeros((6, 8)))


@pytest.mark.parametrize(
    ("q", "points", "key", "fragment"),
    [
        (np.zeros(7), TIPS, "q", "expected 8 finite numbers"),
        (np.full(8, np.nan), TIPS, "q", "expected 8 finite numbers"),
        (np.zeros(8), [("finger4_tip", POINT)], "link", "did you mean 'finger"),
        (np.zeros(8), [("palm", np.zeros(2))], "point", "expected 3 finite numbers"),
    ],
)
def test_bad_arguments_are_refused(q, points, key, fragment):
    with pytest.raises(InputError, match=re.escape(fragment)) as caught:
        barrett().at(q, points)
    assert caught.value.issues[0].key == key


def test_the_order_of_q_names_every_moving_joint_once():
    urdf = read_urdf(BARRETT)
    with pytest.raises(InputError, match="did you mean 'finger1_inner'"):
        kinematics(urdf, ["finger1_inn", *urdf.moving[1:]])
    with pytest.raises(InputError, match="once"):
        kinematics(urdf, urdf.moving[1:])
    with pytest.raises(InputError, match="once"):
        kinematics(urdf, [*urdf.moving, "finger1_inner"])


def test_many_postures_at_once_are_each_as_it_is_alone(tmp_path):
    rng = np.random.default_rng(4)
    for hand, points in (
        (barrett(), [*TIPS, ("finger1_tip", np.zeros(3))]),
        (slider(tmp_path), [("tip", POINT), ("rail", POINT)]),
    ):
        q = rng.uniform(-2, 2, (7, len(hand.joints)))
        found = hand.along(q, points)
        for k, posture in enumerate(q):
            for i, alone in enumerate(hand.at(posture, points)):
                assert found.position[k, i] == pytest.approx(alone.position, abs=1e-14)
                assert found.rotation[k, i] == pytest.approx(alone.rotation, abs=1e-14)
                assert found.jacobian[k, i].reshape(6, -1) == pytest.approx(alone.jacobian, abs=1e-14)


def test_postures_that_are_none_and_links_that_are_not_there_are_refused():
    hand = barrett()
    with pytest.raises(InputError, match="expected postures"):
        hand.along(np.zeros(len(hand.joints)), TIPS)
    with pytest.raises(InputError, match="is not one of"):
        hand.along(np.zeros((2, len(hand.joints))), [("nowhere", POINT)])
