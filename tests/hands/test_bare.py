import math
from pathlib import Path

import numpy as np
import pytest
from mjcf_texts import fingers, plain

from synergrip.errors import InputError
from synergrip.hands.bare import bare_hand
from synergrip.hands.folder import load_hand
from synergrip.hands.hand import Coupling
from synergrip.hands.models.tree import LinkTree, TreeJoint
from synergrip.hands.synergies.matrix import LIMIT_SLACK, outside_limits, posture
from synergrip.hands.synergies.select import select

URDF = """<robot name="two fingers">
  <link name="palm"/><link name="one"/><link name="two"/><link name="three"/><link name="tip"/>
  <joint name="lead" type="revolute"><parent link="palm"/><child link="one"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="2" effort="3"/></joint>
  <joint name="end" type="fixed"><parent link="one"/><child link="tip"/><origin xyz="1 0 0"/></joint>
  <joint name="follow" type="revolute"><parent link="one"/><child link="two"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="1"/><mimic joint="lead" multiplier="0.5" offset="-0.1"/></joint>
  <joint name="push" type="prismatic"><parent link="palm"/><child link="three"/>
    <limit lower="0.01" upper="0.02"/></joint>
</robot>"""


def write(folder, text=URDF, name="pincer.urdf"):
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def tree(ranges, couplings):
    """Return a palm with hinges of these ranges."""
    joints = {
        name: TreeJoint(name, "hinge", "palm", f"link {name}", lower=low, upper=high)
        for name, (low, high) in ranges.items()
    }
    links = ("palm", *(joint.child for joint in joints.values()))
    return LinkTree("", "palm", links, joints, couplings)


def test_a_urdf_alone_is_a_hand(tmp_path):
    hand = load_hand(write(tmp_path))
    assert (hand.name, hand.title) == ("pincer", "two fingers")
    assert hand.joint_names == ("lead", "follow", "push")
    assert [joint.kind for joint in hand.joints] == ["hinge", "hinge", "slide"]
    assert [joint.link for joint in hand.joints] == ["one", "two", "three"]
    assert [(joint.lower, joint.upper) for joint in hand.joints] == [(-1, 2), (0, 1), (0.01, 0.02)]
    assert [joint.torque_limit for joint in hand.joints] == [3, math.inf, math.inf]
    np.testing.assert_array_equal(hand.C_q, np.zeros((3, 3)))
    assert hand.pads == {}
    assert hand.parents == {"one": "palm", "tip": "one", "two": "one", "three": "palm"}
    assert hand.couplings == {"follow": Coupling({"lead": 0.5}, -0.1)}


def test_free_joints_take_their_followers_with_them(tmp_path):
    hand = load_hand(write(tmp_path))
    assert list(hand.synergy_sets) == ["free", "joints"]
    free = select(hand, None)
    assert free.synergies == ("lead", "push")
    assert free.title == "each joint that follows no other one; 'follow' follows 'lead'"
    np.testing.assert_array_equal(free.S, [[1, 0], [0.5, 0], [0, 1]])
    np.testing.assert_array_equal(free.offset, [0, -0.1, 0])
    np.testing.assert_array_equal(hand.synergy_sets["joints"].S, np.eye(3))
    np.testing.assert_allclose(posture(hand, free, {"lead": 1.0, "push": 0.015}), [1, 0.4, 0.015])


def test_without_couplings_there_is_only_the_set_of_all_joints(tmp_path):
    hand = load_hand(write(tmp_path, plain("a", "b"), "claw.xml"))
    assert (hand.name, hand.title) == ("claw", "claw")
    assert list(hand.synergy_sets) == ["joints"]
    assert hand.couplings == {}


@pytest.mark.parametrize(
    ("ranges", "couplings", "expected"),
    [
        ({"a": (-1, 1), "b": (0.2, 1), "c": (-1, -0.3)}, {}, [0, 0.2, -0.3]),
        ({"a": (-math.inf, math.inf)}, {}, [0]),
        ({"a": (0, 1), "b": (0.5, 1)}, {"b": Coupling({"a": 2})}, [0.25, 0.5]),
        ({"a": (-1, 1), "b": (0.5, 1)}, {"b": Coupling({"a": -2}, 0.1)}, [-0.2, 0.5]),
        ({"a": (-1, 0.1), "b": (5, 6)}, {"b": Coupling({"a": 1})}, [0, 0]),
        ({"a": (0, 1), "b": (0, 1), "c": (0, 1)}, {"c": Coupling({"a": 1, "b": 1}, 0.1)}, [0, 0, 0.1]),
        ({"a": (0, 1), "b": (0, 1)}, {"b": Coupling({}, 0.7)}, [0, 0.7]),
    ],
)
def test_the_posture_zero_is_as_near_to_0_as_the_ranges_allow(ranges, couplings, expected):
    hand = bare_hand("h", tree(ranges, couplings), couplings)
    np.testing.assert_allclose(hand.postures["zero"], expected, atol=1e-15)


@pytest.mark.parametrize("seed", range(20))
def test_rounding_does_not_put_a_follower_out_of_its_range(seed):
    """The driver goes to the end of what its followers allow, where they stand at the ends of their ranges."""
    rng = np.random.default_rng(seed)
    ratios = rng.uniform(0.1, 9, 6)
    chain = {chr(98 + k): Coupling({chr(97 + k): ratio}, rng.normal()) for k, ratio in enumerate(ratios)}
    ranges = {name: (-100.0, 100.0) for name in "abcdefg"}
    hand = bare_hand("h", tree(ranges, chain), chain)
    assert not outside_limits(hand.joints, hand.postures["zero"], "")
    free = hand.synergy_sets["free"]
    last = hand.joint_names.index("g")
    z = (3.0 - free.offset[last]) / free.S[last, 0]
    ranges["g"] = (3.0, 100.0)
    hand = bare_hand("h", tree(ranges, chain), chain)
    q = free.S[:, 0] * z + free.offset
    if abs(z) < 100 and np.all(np.abs(q) < 100):
        assert abs(q[last] - 3.0) < LIMIT_SLACK
        assert posture(hand, free, {"a": z})[last] == pytest.approx(3.0)


def test_couplings_that_leave_nothing_to_move_are_refused_at_the_key(tmp_path):
    equalities = '<joint joint1="a" polycoef="0.1"/><joint joint1="b" joint2="a"/>'
    path = write(tmp_path, plain("a", "b", after=f"<equality>{equalities}</equality>"), "h.xml")
    with pytest.raises(InputError, match="nothing is left to move") as caught:
        load_hand(path)
    assert caught.value.issues[0].key == "name_or_path"


def test_couplings_whose_ratios_multiply_beyond_reason_are_refused():
    chain = {"b": Coupling({"a": 9e5}), "c": Coupling({"b": 9e5})}
    with pytest.raises(InputError, match="ratios that no hand has"):
        bare_hand("h", tree(dict.fromkeys("abcd", (-1, 1)), chain), chain)


def test_paths_are_relative_to_the_problem(tmp_path):
    write(tmp_path)
    assert load_hand("pincer.urdf", relative_to=tmp_path).name == "pincer"
    with pytest.raises(InputError, match=r"not found; did you mean 'pincer\.urdf'") as caught:
        load_hand("pincr.urdf", relative_to=tmp_path)
    assert (caught.value.issues[0].key, caught.value.issues[0].file) == ("name_or_path", "")
    with pytest.raises(InputError, match=r"nor a folder with hand\.toml nor a \.urdf, \.xml or \.mjcf file"):
        load_hand("pincer", relative_to=tmp_path)
    (tmp_path / "odd.urdf").mkdir()
    with pytest.raises(InputError, match="neither a bundled hand"):
        load_hand("odd.urdf", relative_to=tmp_path)


@pytest.mark.parametrize("name", ["x" * 5000, "x" * 5000 + ".urdf", "a\0.xml", ".xml"])
def test_what_cannot_be_the_name_of_a_file_is_refused(tmp_path, name):
    with pytest.raises(InputError) as caught:
        load_hand(name, relative_to=tmp_path)
    assert caught.value.issues[0].key == "name_or_path"


def test_the_coupling_of_a_problem_replaces_that_of_the_file(tmp_path):
    path = write(tmp_path)
    np.testing.assert_array_equal(load_hand(path, coupling=0.25).synergy_sets["free"].S[1], [0.25, 0])
    assert load_hand(path, coupling={"follow": 0.75}).couplings["follow"] == Coupling({"lead": 0.75}, -0.1)
    with pytest.raises(InputError, match="'push' follows no other joint") as caught:
        load_hand(path, coupling={"push": 1.0})
    assert caught.value.issues[0].key == "coupling.push"
    locked = fingers(("a", ""), ("b", ""), after='<equality><joint joint1="b" polycoef="0.1"/></equality>')
    hand = load_hand(write(tmp_path, locked, "locked.xml"))
    assert hand.synergy_sets["free"].title == "each joint that follows no other one; 'b' is locked"
    with pytest.raises(InputError, match="'b' follows no joint"):
        load_hand(tmp_path / "locked.xml", coupling=1.0)


def test_what_is_wrong_in_the_file_is_told_there(tmp_path):
    path = write(tmp_path, URDF.replace('joint="lead"', 'joint="laed"'))
    with pytest.raises(InputError, match="did you mean 'lead'") as caught:
        load_hand(path)
    (issue,) = caught.value.issues
    assert (Path(issue.file), issue.line, issue.key) == (path, 7, "")
