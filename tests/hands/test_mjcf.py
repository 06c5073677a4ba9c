import math
from pathlib import Path

import mujoco
import numpy as np
import pytest
from mjcf_texts import NEEDED_BY_MUJOCO, fingers, plain, with_masses

from synergrip.errors import InputError
from synergrip.hands.kinematics import kinematics
from synergrip.hands.models.model_file import read_model

WHOLE = """<mujoco model="a hand of all sorts">
  <compiler angle="degree" eulerseq="ZYX" autolimits="true" fusestatic="true" boundmass="0.1"/>
  <default>
    <joint axis="0 0 2"/>
    <default class="bend"><joint axis="0 1 0" range="-20 80" ref="10"/></default>
  </default>
  <worldbody>
    <body name="palm" pos="5 6 7" euler="10 20 30" childclass="bend">
      <freejoint/>
      <body name="mount" pos="0.01 0 0" axisangle="0 1 1 40">
        <frame euler="0 0 90" pos="0 0 0.02">
          <body name="finger" pos="0.03 0 0" xyaxes="0 1 0 -1 0.1 0">
            <joint name="side" class="main" pos="0.01 0.02 0.03"/>
            <joint name="push" type="slide" axis="1 1 0" ref="0.005" range="0 0.02"/>
            <joint name="bend" pos="0 0 -0.04"/>
            <body name="tip" pos="0 0.02 0.05" zaxis="1 1 1"><joint name="far"/><site name="s" pos="0 0 0.01"/></body>
          </body>
        </frame>
      </body>
      <replicate count="2" euler="0 0 60">
        <body name="claw" pos="0.1 0 0"><joint name="claw" class="main" ref="-30"/></body>
      </replicate>
    </body>
  </worldbody>
</mujoco>"""


def write(folder, text, name="hand.xml"):
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def read(folder, text):
    return read_model(write(folder, text))


def refused(folder, text):
    with pytest.raises(InputError) as caught:
        read(folder, text)
    (issue,) = caught.value.issues
    assert Path(issue.file) == folder / "hand.xml"
    return issue


@pytest.mark.parametrize("seed", range(5))
def test_links_move_as_in_mujoco(tmp_path, seed):
    tree = read(tmp_path, WHOLE)
    assert tree.moving == ("side", "push", "bend", "far", "claw0", "claw1")
    hand = kinematics(tree, tree.moving)
    model = with_masses(WHOLE.replace('fusestatic="true"', ""))
    data = mujoco.MjData(model)
    q = np.random.default_rng(seed).uniform(-1, 1, 6)
    for name, value in zip(tree.moving, q, strict=True):
        data.joint(name).qpos = value
    mujoco.mj_forward(model, data)
    palm, at = data.body("palm").xmat.reshape(3, 3), data.body("palm").xpos
    names = [name for name in tree.links if "/" not in name]
    assert names == ["palm", "mount", "finger", "tip", "claw0", "claw1"]
    for name, motion in zip(names, hand.at(q, [(name, np.zeros(3)) for name in names]), strict=True):
        np.testing.assert_allclose(motion.position, palm.T @ (data.body(name).xpos - at), atol=1e-14)
        np.testing.assert_allclose(motion.rotation, palm.T @ data.body(name).xmat.reshape(3, 3), atol=1e-14)
        jacobian = np.zeros((6, model.nv))
        mujoco.mj_jacBody(model, data, jacobian[:3], jacobian[3:], data.body(name).id)
        columns = [model.joint(joint).dofadr[0] for joint in tree.moving]
        np.testing.assert_allclose(motion.jacobian[:3], palm.T @ jacobian[:3, columns], atol=1e-14)
        np.testing.assert_allclose(motion.jacobian[3:], palm.T @ jacobian[3:, columns], atol=1e-14)


def test_joints_keep_their_names_ranges_and_links(tmp_path):
    tree = read(tmp_path, WHOLE)
    assert (tree.title, tree.root) == ("a hand of all sorts", "palm")
    assert tree.links == ("palm", "mount", "finger/side", "finger/push", "finger", "tip", "claw0", "claw1")
    assert tree.parents["finger/side"] == "mount"
    assert tree.parents["tip"] == "finger"
    side, push, bend = (tree.joints[name] for name in ("side", "push", "bend"))
    assert (side.kind, side.lower, side.upper) == ("hinge", -math.inf, math.inf)
    assert (push.kind, push.lower, push.upper) == ("slide", 0, 0.02)
    np.testing.assert_allclose([bend.lower, bend.upper], np.radians([-20, 80]))
    assert bend.torque_limit == math.inf


def test_what_does_not_bear_on_kinematics_need_not_exist(tmp_path):
    text = """<mujoco>
      <compiler meshdir="nowhere" texturedir="nowhere" inertiafromgeom="true" settotalmass="3"/>
      <extension><plugin plugin="no.such.plugin"><instance name="p"/></plugin></extension>
      <size njmax="500"/><option integrator="implicitfast"/><visual><global fovy="3"/></visual>
      <asset>
        <mesh name="m" file="m.stl"/><hfield name="h" file="h.png"/><texture name="t" type="2d" file="t.png"/>
        <material name="a" texture="t"/><skin file="s.skn"/>
      </asset>
      <default><geom type="mesh" mesh="m" material="a"/><mesh scale="1 1 1"/><material/><site material="a"/></default>
      <worldbody>
        <light pos="0 0 1"/><camera name="c" mode="targetbody" target="palm"/><geom type="hfield" hfield="h"/>
        <body name="palm"><geom mesh="m"/>
          <body name="finger"><joint name="j" springdamper="0.1 1"/><geom name="g" type="sphere" size="0.01"/>
            <site name="s" material="a"/>
            <plugin instance="p"/><camera name="d"/></body>
        </body>
      </worldbody>
      <contact><exclude body1="palm" body2="finger"/><pair geom1="g" geom2="g"/></contact>
      <tendon><spatial name="rope" material="a"><site site="s"/><geom geom="g"/><site site="s"/></spatial></tendon>
      <equality><tendon tendon1="rope" active="false"/></equality>
      <actuator>
        <motor tendon="rope"/><adhesion body="finger"/><muscle joint="j"/>
        <plugin joint="j" plugin="no.such.plugin" instance="p"><config key="k" value="1"/></plugin>
      </actuator>
      <sensor><touch site="s"/><plugin plugin="no.such.plugin"/></sensor>
      <keyframe><key qpos="1 2 3 4 5"/></keyframe>
      <custom><tuple name="u"><element objtype="geom" objname="g"/></tuple></custom>
    </mujoco>"""
    tree = read(tmp_path, text)
    assert (tree.root, tree.links, tree.moving) == ("palm", ("palm", "finger"), ("j",))


def test_mujoco_writes_no_log_about_joints_that_do_the_same(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text = '<mujoco><worldbody><body name="p"><body name="f"><joint/><joint/></body></body></worldbody></mujoco>'
    tree = read(tmp_path, text)
    kinematics(tree, tree.moving)
    assert [entry.name for entry in tmp_path.iterdir()] == ["hand.xml"]


ROOTS = {
    "one body": ('<body name="p"><body name="f"><joint/></body></body>', "p"),
    "it floats": ('<body name="p"><freejoint/><body name="f"><joint/></body></body><geom size="1"/>', "p"),
    "it moves": ('<body name="f"><joint/></body>', "world"),
    "two bodies": ('<body name="p"><body name="f"><joint/></body></body><body name="table"/>', "world"),
    "an object": ('<body name="p"><body name="f"><joint/></body></body><body name="ball"><freejoint/></body>', "p"),
    "a tracker": ('<body name="m" mocap="true"/><body name="p"><freejoint/><body name="f"><joint/></body></body>', "p"),
}


@pytest.mark.parametrize(("bodies", "root"), ROOTS.values(), ids=ROOTS)
def test_the_palm_is_the_one_body_that_stands_still(tmp_path, bodies, root):
    tree = read(tmp_path, f"<mujoco><worldbody>{bodies}</worldbody></mujoco>")
    assert tree.root == root
    assert tree.moving == ("f",)  # a joint without a name has that of its body
    assert "ball" not in tree.links


def test_nameless_and_clashing_things_get_names_of_their_own(tmp_path):
    tree = read(tmp_path, """<mujoco><worldbody><body><body name="a"><joint name="b"/><joint/><joint name="c"/></body>
        <body name="a/b"/><body/></body></worldbody></mujoco>""")  # fmt: skip
    assert tree.links == ("body1", "a/b'", "a/a", "a", "a/b", "body4")
    assert tree.moving == ("b", "a", "c")
    assert set(tree.joints) == {"b", "a", "c", "a/b/fixed", "body4/fixed"}
    kinematics(tree, tree.moving)


def test_included_files_are_read_from_the_folder_of_the_first(tmp_path):
    (tmp_path / "parts").mkdir()
    write(
        tmp_path, "<mujocoinclude><joint name='j' axis='1 0 0'/><include file='parts/b.xml'/></mujocoinclude>", "a.xml"
    )
    write(tmp_path / "parts", "<mujoco>\n<body name='f'>\n<include file='c.xml'/></body></mujoco>", "b.xml")
    write(tmp_path / "parts", "<mujoco>\n<joint name='k'/></mujoco>", "c.xml")
    text = '<mujoco><worldbody><body name="p"><body name="g"><include file="a.xml"/></body></body></worldbody></mujoco>'
    assert read(tmp_path, text).moving == ("j", "k")
    write(tmp_path / "parts", "<mujoco>\n\n<joint name='k' sort='hinge'/></mujoco>", "c.xml")
    with pytest.raises(InputError, match="unrecognized attribute: 'sort'") as caught:
        read(tmp_path, text)
    (issue,) = caught.value.issues
    assert (Path(issue.file), issue.line) == (tmp_path / "parts" / "c.xml", 3)


def test_an_attached_model_is_read_too(tmp_path):
    finger = f"<mujoco><worldbody><body name='f'><joint name='j'/>{NEEDED_BY_MUJOCO}</body></worldbody></mujoco>"
    write(tmp_path, finger, "finger.xml")
    tree = read(
        tmp_path,
        """<mujoco><asset><model name="m" file="finger.xml"/></asset><worldbody><body name="p">
        <attach model="m" body="f" prefix="left "/><attach model="m" body="f" prefix="right "/>
        </body></worldbody></mujoco>""",
    )
    assert tree.moving == ("left j", "right j")


LIMITS = """<actuator>
  <motor joint="a" gear="-3" forcerange="-2 5"/><position joint="a" kp="1" forcerange="-1 1"/>
  <motor joint="b" forcerange="-2 2"/><motor joint="b"/>
  <motor tendon="t" gear="2" forcerange="0 4"/>
  <motor jointinparent="d" forcerange="-7 7"/>
</actuator>
<tendon><fixed name="t"><joint joint="c" coef="0.5"/><joint joint="e" coef="-1"/></fixed></tendon>"""


def test_torque_limits_are_those_of_the_joint_or_of_its_actuators(tmp_path):
    limited = ("f", 'axis="0 0 1" actuatorfrcrange="-3 2"')
    joints = [(name, 'axis="0 0 1"') for name in "abcde"]
    tree = read(tmp_path, fingers(*joints, limited, ("g", ""), after=LIMITS))
    assert [joint.torque_limit for name, joint in tree.joints.items() if name in tree.moving] == [
        3 * 5 + 1, math.inf, 2 * 0.5 * 4, 7, 2 * 1 * 4, 3, math.inf
    ]  # fmt: skip


BAD = [
    ('<joint name="b" axis="0 0 1"/>', '<joint name="b" type="ball"/>', "joint 'b' is a ball joint", 1),
    ('<joint name="b" axis="0 0 1"/>', '<joint name="b" axis="0 0 0"/>', "axis too small", 1),
    ('<joint name="b" axis="0 0 1"/>', '<joint name="b" range="1 -1"/>', "the range ends below its beginning", 1),
    ('<joint name="b" axis="0 0 1"/>', '<joint name="b" range="1 nan"/>', "expected finite numbers", 1),
    ('<joint name="b" axis="0 0 1"/>', '<joint name="b" pos="0 1e7 0"/>', "expected numbers below 1e+06", 1),
    ('<body name="b">', '<body name="b" quat="inf 0 0 1">', "place or orientation is no number", 1),
    ('<joint name="b" axis="0 0 1"/>', '<joint name="a"/>', "repeated name 'a'", 1),
    ('<joint name="b" axis="0 0 1"/>', '<joint name="b" pos="0 x 0"/>', "bad format in attribute 'pos'", 1),
    ("</mujoco>", '<equality><joint joint1="a" joint2="z"/></equality></mujoco>', "unknown element 'z'", 2),
    ("</mujoco>", '<include file="none.xml"/></mujoco>', "none.xml' is not there", 2),
    ("</mujoco>", f'<include file="{"x" * 5000}"/></mujoco>', "is not there", 2),
    ("</mujoco>", '<include file="hand.xml"/></mujoco>', "'hand.xml' is included twice", 2),
    ("</mujoco>", "<include/></mujoco>", "<include> needs the attribute 'file'", 2),
    ("</mujoco>", "<joints/></mujoco>", "<joints>: MuJoCo says: unrecognized element", 2),
    ("</mujoco>", "", "not XML", 2),
    ("<mujoco>", "<!DOCTYPE mujoco>\n<mujoco>", "DOCTYPE", 1),
]


@pytest.mark.parametrize(("old", "new", "fragment", "line"), BAD, ids=[case[2] for case in BAD])
def test_what_is_no_hand_is_refused_where_it_stands(tmp_path, old, new, fragment, line):
    text = plain("a", "b")
    assert old in text
    issue = refused(tmp_path, text.replace(old, new, 1))
    assert fragment in issue.message
    assert issue.line == line


def test_a_file_without_joints_or_with_too_many_is_refused(tmp_path):
    assert "no joint that moves" in refused(tmp_path, "<mujoco/>").message
    assert "no joint that moves" in refused(tmp_path, plain()).message
    many = plain(*(f"j{k}" for k in range(201)))
    assert "a hand has at most 200" in refused(tmp_path, many).message
    two = '<body name="{0}"><freejoint/><body><joint/></body></body>'
    text = f"<mujoco><worldbody>{two.format('a')}{two.format('b')}</worldbody></mujoco>"
    assert "'a' and 'b' float and have joints" in refused(tmp_path, text).message
