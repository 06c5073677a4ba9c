import math
import re

import pytest
from scipy.spatial.transform import Rotation

from synergrip.errors import InputError
from synergrip.hands.urdf import read_urdf

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
    assert joint.quaternion == pytest.approx(rotation.as_quat(scalar_first=True), abs=1e-15)
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
        ("revolute", "floating", "'floating' is not one of 'revolute'", 5),
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
