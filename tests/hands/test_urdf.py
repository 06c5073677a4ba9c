import math
import re

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from synergrip.errors import InputError
from synergrip.hands.hand import Coupling
from synergrip.hands.models.urdf import read_urdf
from synergrip.hands.synergies.matrix import coupling_map

TWO_LINKS = """<?xml version="1.0"?>
<robot name="r">
  <link name="palm"/>
  <link name="finger"/>
  <joint name="bend" type="revolute">
    <parent link="palm"/><child link="finger"/>
    <origin xyz="1 2 3" rpy="0.1 0.2 0.3"/><axis xyz="0 0 2"/>
    <limit lower="-1" upper="2"/>
  </joint>
</robot>
"""


def read(tmp_path, text):
    path = tmp_path / "hand.urdf"
    path.write_text(text, encoding="utf-8")
    return read_urdf(path, "model")


def refused(tmp_path, text):
    with pytest.raises(InputError) as caught:
        read(tmp_path, text)
    (issue,) = caught.value.issues
    assert issue.file == str(tmp_path / "hand.urdf")
    return issue


def test_links_and_joints_are_read(tmp_path):
    urdf = read(tmp_path, TWO_LINKS)
    assert urdf.root == "palm"
    assert urdf.links == ("palm", "finger")
    assert urdf.moving == ("bend",)
    joint = urdf.joints["bend"]
    assert (joint.kind, joint.parent, joint.child) == ("hinge", "palm", "finger")
    assert joint.xyz == (1, 2, 3)
    rotation = Rotation.from_euler("xyz", (0.1, 0.2, 0.3))  # about the fixed axes of the parent, as URDF has it
    assert joint.quaternion == pytest.approx(np.roll(rotation.as_quat(), 1), abs=1e-15)
    assert joint.axis == (0, 0, 1)
    assert (joint.lower, joint.upper) == (-1, 2)


def test_defaults_are_those_of_the_format(tmp_path):
    text = TWO_LINKS.replace('<origin xyz="1 2 3" rpy="0.1 0.2 0.3"/><axis xyz="0 0 2"/>', "")
    joint = read(tmp_path, text.replace('<limit lower="-1" upper="2"/>', "<limit/>")).joints["bend"]
    assert (joint.xyz, joint.quaternion, joint.axis) == ((0, 0, 0), (1, 0, 0, 0), (1, 0, 0))
    assert (joint.lower, joint.upper) == (0, 0)


def test_a_continuous_joint_has_no_limits(tmp_path):
    text = TWO_LINKS.replace("revolute", "continuous").replace('<limit lower="-1" upper="2"/>', "")
    joint = read(tmp_path, text).joints["bend"]
    assert (joint.kind, joint.lower, joint.upper) == ("hinge", -math.inf, math.inf)


@pytest.mark.parametrize(
    "declaration",
    [
        '<!DOCTYPE robot [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;&a;&a;">]>',
        '<!DOCTYPE robot [<!ENTITY secret SYSTEM "file:///etc/passwd">]>',
        '<!DOCTYPE robot SYSTEM "robot.dtd">',
    ],
)
def test_document_types_and_entities_are_refused(tmp_path, declaration):
    issue = refused(tmp_path, TWO_LINKS.replace("<robot", declaration + "\n<robot", 1))
    assert "DOCTYPE" in issue.message
    assert issue.line == 2


SECOND = '<joint name="other" type="fixed"><parent link="palm"/><child link="finger"/></joint></robot>'


@pytest.mark.parametrize(
    ("pattern", "replacement", "fragment", "line"),
    [
        (r"</robot>", "", "not XML", 11),
        (r"(?s).*", "", "not XML: no element found", 1),
        (r"(?s).*", "hello", "not XML", 1),
        (r"(?s)<robot.*", "<mujoco/>", "got <mujoco>", 2),
        (r"(?s)<joint.*</joint>", "", "no joint that moves", 2),
        ("revolute", "fixed", "no joint that moves", 2),
        ("revolute", "floating", "moves in more than one direction", 5),
        ("revolute", "planar", "moves in more than one direction", 5),
        ("revolute", "hinge", "'hinge' is not one of 'revolute'", 5),
        ("revolute", "revolut", "did you mean 'revolute'", 5),
        ('name="bend" ', "", "needs the attribute 'name'", 5),
        ('<child link="finger"/>', "", "<child> needs the attribute 'link'", 5),
        ('child link="finger"', 'child link="fingr"', "did you mean 'finger'", 5),
        ('child link="finger"', 'child link="palm"', "form a loop", 2),
        ('<link name="finger"/>', '<link name="finger"/><link name="palm"/>', "two links are named 'palm'", 4),
        ('<link name="finger"/>', '<link name="finger"/><link name="loose"/>', "'palm', 'loose' are no child", 2),
        ("</robot>", SECOND, "child of two joints", 10),
        ("</robot>", SECOND.replace("other", "bend"), "two joints are named 'bend'", 10),
        ('xyz="1 2 3"', 'xyz="1 2"', "expected 3 finite numbers", 7),
        ('xyz="1 2 3"', 'xyz="1 2 three"', "expected 3 finite numbers", 7),
        ('rpy="0.1 0.2 0.3"', 'rpy="0 nan 0"', "expected 3 finite numbers", 7),
        ('upper="2"', 'upper="inf"', "expected a finite number", 8),
        ('upper="2"', 'upper="1e200"', "expected numbers below 1e+100", 8),
        ('xyz="1 2 3"', 'xyz="1 2e7 3"', "expected numbers below 1e+06", 7),
        ('upper="2"', 'upper="2" effort="nan"', "expected a finite number", 8),
        ('<link name="palm"/>', '<xacro:macro name="m"/><link name="palm"/>', "expand it first", 3),
        ('upper="2"', 'upper="-2"', "lower limit -1 is above", 8),
        ('<limit lower="-1" upper="2"/>', "", "needs <limit", 5),
        ('axis xyz="0 0 2"', 'axis xyz="0 0 0"', "no direction", 5),
    ],
)
def test_what_is_no_hand_is_refused_where_it_stands(tmp_path, pattern, replacement, fragment, line):
    text = re.sub(pattern, lambda _: replacement, TWO_LINKS, count=1)
    assert text != TWO_LINKS
    issue = refused(tmp_path, text)
    assert fragment in issue.message
    assert issue.line == line


def test_a_missing_file_is_told_at_the_key_that_names_it(tmp_path):
    with pytest.raises(InputError, match="not found") as caught:
        read_urdf(tmp_path / "none.urdf", "model")
    assert caught.value.issues[0].key == "model"


def two_fingers(*mimics):
    """Return a URDF with a turning joint for each mimic tag, one that slides and a fixed one."""
    parts = ['<robot name="r"><link name="palm"/><link name="rail"/><link name="tip"/>']
    parts += [
        f"""<link name="l{i}"/>
<joint name="j{i}" type="continuous"><parent link="palm"/><child link="l{i}"/>
{mimic}</joint>"""
        for i, mimic in enumerate(mimics)
    ]
    parts.append(
        """<joint name="slide" type="prismatic"><parent link="palm"/><child link="rail"/><limit upper="1"/></joint>
<joint name="end" type="fixed"><parent link="rail"/><child link="tip"/><mimic joint="nobody"/></joint></robot>"""
    )
    return "".join(parts)


def test_mimic_tags_become_couplings(tmp_path):
    text = two_fingers(
        "",
        '<mimic joint="j0" multiplier="-0.5" offset="0.1"/>',
        '<mimic joint="slide" multiplier="20"/>',
        '<mimic joint="j1"/>',
    )
    tree = read(tmp_path, text)
    assert tree.couplings == {
        "j1": Coupling({"j0": -0.5}, 0.1),
        "j2": Coupling({"slide": 20}, 0),
        "j3": Coupling({"j1": 1}, 0),
    }
    E, e = coupling_map(tree.moving, tree.couplings)
    np.testing.assert_allclose(E @ [2, 0, 0, 0, 0.3] + e, [2, -0.9, 6, -0.9, 0.3])


@pytest.mark.parametrize(
    ("mimic", "fragment"),
    [
        ('<mimic joint="j9"/>', "a joint that is not there: 'j9' is not one of 'j0', 'j1', 'j2' or 'slide'"),
        ('<mimic joint="end"/>', "mimics 'end', which is fixed"),
        ('<mimic joint="j1"/>', "would follow itself"),
        ('<mimic joint="j2"/>', "would follow itself"),
        ("<mimic/>", "<mimic> needs the attribute 'joint'"),
        ('<mimic joint="j0" multiplier="nan"/>', "<mimic multiplier> is 'nan'; expected a finite number"),
        ('<mimic joint="j0" offset="one"/>', "<mimic offset> is 'one'; expected a finite number"),
    ],
)
def test_a_mimic_that_cannot_be_is_refused_where_it_stands(tmp_path, mimic, fragment):
    issue = refused(tmp_path, two_fingers("", mimic, '<mimic joint="j1"/>'))
    assert fragment in issue.message
    assert issue.line == 5


def test_a_mimic_that_is_told_elsewhere_is_passed_over(tmp_path):
    path = tmp_path / "hand.urdf"
    path.write_text(two_fingers("", '<mimic joint="nobody"/>', '<mimic joint="j0"/>'), encoding="utf-8")
    assert read_urdf(path, told=["j1"]).couplings == {"j2": Coupling({"j0": 1}, 0)}


@pytest.mark.parametrize(("effort", "limit"), [("2.5", 2.5), ("0", math.inf), ("-1", math.inf), ("inf", math.inf)])
def test_effort_is_the_torque_limit_when_it_is_a_limit(tmp_path, effort, limit):
    assert read(tmp_path, TWO_LINKS).joints["bend"].torque_limit == math.inf
    text = TWO_LINKS.replace('upper="2"', f'upper="2" effort="{effort}"')
    assert read(tmp_path, text).joints["bend"].torque_limit == limit


def test_comments_that_only_strict_readers_refuse_are_allowed(tmp_path):
    text = TWO_LINKS.replace("<link", "<!-- a -- b\n\n -- c --><link", 1)
    assert read(tmp_path, text).moving == ("bend",)
    assert refused(tmp_path, text.replace("revolute", "revolut")).line == 7


def test_what_would_take_minutes_is_refused(tmp_path):
    links = "".join(f'<link name="x{i}"/>' for i in range(6000))
    assert "give the hand alone" in refused(tmp_path, TWO_LINKS.replace("</robot>", links + "</robot>")).message
    mimics = [f'<mimic joint="j{max(i - 1, 0)}"/>' * (i > 0) for i in range(300)]
    assert "a hand has at most 200" in refused(tmp_path, two_fingers(*mimics)).message
    assert "nested more than 200 deep" in refused(tmp_path, "<robot>" + "<a>" * 5000).message
