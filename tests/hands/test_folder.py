import math
from pathlib import Path

import numpy as np
import pytest

from synergrip.errors import InputError
from synergrip.hands.folder import bundled_hands, load_hand
from synergrip.hands.hand import Coupling

URDF = """<robot name="r">
  <link name="palm"/><link name="one"/><link name="two"/><link name="rail"/>
  <joint name="near" type="revolute">
    <parent link="palm"/><child link="one"/><axis xyz="0 0 1"/><limit lower="-1" upper="2"/>
  </joint>
  <joint name="far" type="revolute">
    <parent link="one"/><child link="two"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/><limit lower="-1" upper="1"/>
  </joint>
  <joint name="push" type="prismatic">
    <parent link="palm"/><child link="rail"/><axis xyz="0 0 1"/><limit lower="0" upper="0.1"/>
  </joint>
</robot>
"""

TOML = """schema = 1
title = "A test hand"
model = "test.urdf"

[[joint]]
name = "push"
torque_limit = "5 N"
compliance = "0.2 mm/N"

[[joint]]
name = "far"

[[joint]]
name = "near"
torque_limit = "1500 N mm"
compliance = "0.1 rad/(N m)"

[pads."one/tip"]
link = "two"
point = ["10 mm", "0 mm", "-1 cm"]
normal = [0, 3, 4]

[couplings]
far = { joint = "near", ratio = "1/4", offset = "0.1 rad" }

[synergies.motors]
title = "two motors"
columns.bend = { near = 2 }
columns.push = { push = 0.5 }
offset = { near = "0.2 rad" }
effort_limits = { push = "3 N" }

[postures.half]
synergies = { bend = "0.3 rad" }

[postures.flat]
joints = { near = "0 rad", far = "0 rad" }
"""


def folder(tmp_path, toml=TOML, urdf=URDF):
    place = tmp_path / "test-hand"
    place.mkdir()
    (place / "hand.toml").write_text(toml, encoding="utf-8")
    (place / "test.urdf").write_text(urdf, encoding="utf-8")
    return place


def test_a_folder_becomes_a_hand(tmp_path):
    hand = load_hand(folder(tmp_path))
    assert (hand.name, hand.title) == ("test-hand", "A test hand")
    assert hand.joint_names == ("push", "far", "near")
    assert [joint.kind for joint in hand.joints] == ["slide", "hinge", "hinge"]
    assert [(joint.lower, joint.upper) for joint in hand.joints] == [(0, 0.1), (-1, 1), (-1, 2)]
    assert [joint.torque_limit for joint in hand.joints] == [5, math.inf, 1.5]
    np.testing.assert_allclose(hand.C_q, np.diag([2e-4, 0, 0.1]))
    pad = hand.pad("one/tip")
    assert pad.link == "two"
    np.testing.assert_allclose(pad.point, [0.01, 0, -0.01])
    np.testing.assert_allclose(pad.normal, [0, 0.6, 0.8])
    assert hand.couplings == {"far": Coupling({"near": 0.25}, 0.1)}


def test_followers_are_put_into_the_synergies(tmp_path):
    hand = load_hand(folder(tmp_path))
    assert list(hand.synergy_sets) == ["motors", "joints"]
    motors = hand.synergy_sets["motors"]
    assert (motors.title, motors.synergies) == ("two motors", ("bend", "push"))
    np.testing.assert_allclose(motors.S, [[0, 0.5], [0.5, 0], [2, 0]])
    np.testing.assert_allclose(motors.offset, [0, 0.25 * 0.2 + 0.1, 0.2])
    np.testing.assert_array_equal(motors.effort_limits, [math.inf, 3])
    np.testing.assert_array_equal(hand.synergy_sets["joints"].S, np.eye(3))


def test_postures_are_values_of_synergies_or_of_joints(tmp_path):
    hand = load_hand(folder(tmp_path))
    np.testing.assert_allclose(hand.postures["half"], [0, 0.3 * 0.5 + 0.15, 0.3 * 2 + 0.2])
    np.testing.assert_array_equal(hand.postures["flat"], np.zeros(3))


def test_q_is_in_the_order_of_hand_toml(tmp_path):
    (motion,) = load_hand(folder(tmp_path)).kinematics.at(np.array([0.05, 0.0, math.pi / 2]), [("two", np.zeros(3))])
    np.testing.assert_allclose(motion.position, [0, 1, 0], atol=1e-15)
    np.testing.assert_allclose(motion.jacobian[:3], [[0, 0, -1], [0, 0, 0], [0, 0, 0]], atol=1e-15)


def test_arrays_cannot_be_changed(tmp_path):
    hand = load_hand(folder(tmp_path))
    motors = hand.synergy_sets["motors"]
    pad = hand.pads["one/tip"]
    for array in (
        hand.C_q,
        motors.S,
        motors.offset,
        motors.effort_limits,
        pad.point,
        pad.normal,
        *hand.postures.values(),
    ):
        assert not array.flags.writeable


@pytest.mark.parametrize("coupling", [0.5, {"far": 0.5}])
def test_the_coupling_can_be_replaced(tmp_path, coupling):
    hand = load_hand(folder(tmp_path), coupling=coupling)
    np.testing.assert_allclose(hand.synergy_sets["motors"].S[1], [1, 0])
    assert hand.couplings["far"] == Coupling({"near": 0.5}, 0.1)


def test_one_follower_of_three_can_be_replaced():
    S = load_hand("barrett", coupling={"finger2_outer": 0}).synergy_sets["motors"].S
    np.testing.assert_array_equal([S[1, 1], S[4, 2], S[7, 3]], [1 / 3, 0, 1 / 3])


def test_with_another_coupling_only_the_posture_that_is_used_has_to_fit():
    hand = load_hand("barrett", coupling=1)  # "ball" would turn outer links to 74 deg, past their range
    assert hand.postures["ball"][1] == hand.postures["ball"][0]


def test_bundled_names_and_paths_both_work(tmp_path):
    place = folder(tmp_path)
    assert {"barrett", "barrett-table2"} <= set(bundled_hands())
    assert load_hand("barrett").name == "barrett"
    for path, start in [(place, None), ("test-hand", tmp_path), (place / "hand.toml", None), ("./test-hand", tmp_path)]:
        assert load_hand(path, relative_to=start).name == "test-hand"


@pytest.mark.parametrize("wish", ["baret", "", "/no/such/place", "."])
def test_an_unknown_hand_is_refused_with_the_bundled_names(tmp_path, wish):
    with pytest.raises(InputError) as caught:
        load_hand(wish, relative_to=tmp_path)
    (issue,) = caught.value.issues
    assert issue.key == "name_or_path"
    assert "(barrett, barrett-table2" in issue.message
    assert ("did you mean 'barrett'?" in issue.message) == (wish == "baret")


@pytest.mark.parametrize(
    ("name", "coupling", "key", "fragment"),
    [
        ("barrett", {"finger1_outr": 1.0}, "coupling.finger1_outr", "did you mean 'finger1_outer'?"),
        ("barrett", {"finger1_inner": 1.0}, "coupling.finger1_inner", "follows no other joint"),
        ("bare", 0.5, "coupling", "no joint of this hand follows another one"),
    ],
)
def test_a_coupling_the_hand_does_not_have_is_refused(tmp_path, name, coupling, key, fragment):
    if name == "bare":
        name = str(folder(tmp_path, without("couplings", "synergies", "postures")))
    with pytest.raises(InputError) as caught:
        load_hand(name, coupling=coupling)
    (issue,) = caught.value.issues
    assert (issue.key, issue.file) == (key, "")
    assert fragment in issue.message


def without(*tables):
    blocks = TOML.split("\n\n")
    return "\n\n".join(block for block in blocks if not block.startswith(tuple(f"[{table}" for table in tables)))


BAD = [
    ("schema = 1", "schema = 2", "schema", "upgrade synergrip"),
    ('title = "A test hand"\n', "", "title", "missing key 'title'"),
    ('title = "A test hand"', 'titel = "A test hand"', "titel", "did you mean 'title'?"),
    ("test.urdf", "nothing.urdf", "model", "not found"),
    ('name = "far"', 'name = "fra"', "joint[1].name", "'fra' is not one of 'near', 'far' or 'push'; did you mean"),
    ('name = "far"', 'name = "near"', "joint[2].name", "'near' is listed twice"),
    ('[[joint]]\nname = "far"\n\n', "", "joint", "the model also moves 'far'"),
    ('"5 N"', '"5 N m"', "joint[0].torque_limit", "'N m' is a unit of torque; expected a force"),
    ('"5 N"', '"0 N"', "joint[0].torque_limit", "must be greater than 0"),
    ('"1500 N mm"', "1.5", "joint[2].torque_limit", "expected a string"),
    ('"0.2 mm/N"', '"-0.2 mm/N"', "joint[0].compliance", "must be at least 0"),
    ('"0.1 rad/(N m)"', '"0.1 mm/N"', "joint[2].compliance", "expected a joint compliance"),
    ('link = "two"', 'link = "tow"', "pads.one/tip.link", "did you mean 'two'?"),
    ('"10 mm", ', "", "pads.one/tip.point", "expected 3"),
    ("[0, 3, 4]", "[0, 0, 0]", "pads.one/tip.normal", "needs a direction"),
    ('joint = "near"', 'joint = "nera"', "couplings.far.joint", "did you mean 'near'?"),
    ('joint = "near"', 'joint = "far"', "couplings.far.joint", "'far' would follow itself"),
    ('ratio = "1/4"', 'ratio = "1/0"', "couplings.far.ratio", "is not a number or a fraction"),
    ("far = {", "fra = {", "couplings.fra", "did you mean 'far'?"),
    ("{ near = 2 }", "{ naer = 2 }", "synergies.motors.columns.bend.naer", "did you mean 'near'?"),
    ("{ near = 2 }", "{ far = 2 }", "synergies.motors.columns.bend.far", "'far' follows 'near'"),
    ("{ near = 2 }", "{ near = 0 }", "synergies.motors.columns.bend", "moves at least one joint"),
    ("{ near = 2 }", "{}", "synergies.motors.columns.bend", "moves at least one joint"),
    ("offset = { near", "offset = { naer", "synergies.motors.offset.naer", "did you mean 'near'?"),
    ('{ push = "3 N" }', '{ pull = "3 N" }', "synergies.motors.effort_limits.pull", "'bend' or 'push'"),
    ('"3 N"', '"-3 N"', "synergies.motors.effort_limits.push", "must be greater than 0"),
    ("[synergies.motors]", "[synergies.joints]", "synergies.joints", "choose another name"),
    ("[synergies.motors]", "[synergies.all]", "synergies.all", "choose another name"),
    ("{ bend =", "{ bned =", "postures.half.synergies.bned", "did you mean 'bend'?"),
    ('"0.3 rad" }', '"0.3 rad" }\nset = "motor"', "postures.half.set", "did you mean 'motors'?"),
    ('"0.3 rad" }', '"0.3 rad" }\njoints = {}', "postures.half", "either 'synergies' or 'joints'"),
    ('far = "0 rad" }', 'far = "0 rad" }\nset = "motors"', "postures.flat.set", "'set' goes with 'synergies'"),
    ('far = "0 rad" }', 'afr = "0 rad" }', "postures.flat.joints.afr", "did you mean 'far'?"),
    ('far = "0 rad" }', 'far = "1.1 rad" }', "postures.flat", "'far' would be at 63.03 deg, outside -57.3 to 57.3"),
]


@pytest.mark.parametrize(("old", "new", "key", "fragment"), BAD, ids=[f"{case[2]}-{case[1][:20]}" for case in BAD])
def test_what_is_wrong_is_told_where_it_stands(tmp_path, old, new, key, fragment):
    assert old in TOML
    place = folder(tmp_path, TOML.replace(old, new, 1))
    with pytest.raises(InputError) as caught:
        load_hand(place)
    (issue,) = caught.value.issues
    assert issue.key == key
    assert fragment in issue.message
    assert Path(issue.file) == place / "hand.toml"
    assert issue.line > 0


def test_a_bad_urdf_is_told_in_the_urdf(tmp_path):
    place = folder(tmp_path, urdf=URDF.replace("<robot", "<!DOCTYPE robot>\n<robot"))
    with pytest.raises(InputError, match="DOCTYPE") as caught:
        load_hand(place)
    assert Path(caught.value.issues[0].file) == place / "test.urdf"


def test_all_issues_are_told_at_once(tmp_path):
    toml = TOML.replace('"5 N"', '"5 kg"').replace('"1500 N mm"', '"-1 N m"')
    with pytest.raises(InputError) as caught:
        load_hand(folder(tmp_path, toml))
    assert [issue.key for issue in caught.value.issues] == ["joint[0].torque_limit", "joint[2].torque_limit"]


MIMIC = URDF.replace('upper="1"/>', 'upper="1"/><mimic joint="near" multiplier="0.5" offset="0.2"/>')


def test_mimic_tags_hold_unless_hand_toml_says_otherwise(tmp_path):
    hand = load_hand(folder(tmp_path, urdf=MIMIC))
    assert hand.couplings == {"far": Coupling({"near": 0.25}, 0.1)}
    (tmp_path / "test-hand" / "hand.toml").write_text(without("couplings"), encoding="utf-8")
    hand = load_hand(tmp_path / "test-hand")
    assert hand.couplings == {"far": Coupling({"near": 0.5}, 0.2)}
    np.testing.assert_allclose(hand.synergy_sets["motors"].S, [[0, 0.5], [1, 0], [2, 0]])
    assert load_hand(tmp_path / "test-hand", coupling={"far": 0.75}).couplings == {"far": Coupling({"near": 0.75}, 0.2)}


def test_a_broken_mimic_matters_only_when_hand_toml_is_silent(tmp_path):
    place = folder(tmp_path, urdf=MIMIC.replace('mimic joint="near"', 'mimic joint="nobody"'))
    assert load_hand(place).couplings == {"far": Coupling({"near": 0.25}, 0.1)}
    (place / "hand.toml").write_text(without("couplings"), encoding="utf-8")
    with pytest.raises(InputError, match="mimics a joint that is not there") as caught:
        load_hand(place)
    assert (Path(caught.value.issues[0].file), caught.value.issues[0].line) == (place / "test.urdf", 7)


def test_hand_toml_may_name_an_mjcf_file(tmp_path):
    place = folder(tmp_path)
    mjcf = """<mujoco><worldbody><body name="palm">
      <body name="one"><joint name="near" range="-57 114"/>
        <body name="two" pos="1 0 0"><joint name="far"/></body>
      </body>
      <body name="rail"><joint name="push" type="slide" range="0 0.1"/></body>
    </body></worldbody><equality><joint joint1="far" joint2="near" polycoef="0.2 3"/></equality></mujoco>"""
    (place / "test.xml").write_text(mjcf, encoding="utf-8")
    other = tmp_path / "other"
    other.mkdir()
    (other / "hand.toml").write_text(TOML.replace("test.urdf", "../test-hand/test.xml"), encoding="utf-8")
    q, point = np.array([0.02, 0.3, -0.4]), [("two", np.array([0.1, 0.2, 0.3]))]
    ours, theirs = (load_hand(path).kinematics.at(q, point)[0] for path in (place, other))
    np.testing.assert_allclose(ours.position, theirs.position, atol=1e-15)
    np.testing.assert_allclose(ours.jacobian, theirs.jacobian, atol=1e-15)
    assert load_hand(other).couplings == {"far": Coupling({"near": 0.25}, 0.1)}
