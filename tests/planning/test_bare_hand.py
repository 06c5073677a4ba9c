"""The example of models/README.md: a problem on a hand that is one MJCF file."""

import re
from pathlib import Path

import numpy as np
import pytest

from synergrip import InputError, analyse, load_problem, plan
from synergrip.files import bundled

README = (bundled("models") / "README.md").read_text(encoding="utf-8")
SECTION = README[README.index("## A URDF or MJCF without hand.toml") :]
URDF = """<robot name="gripper"><link name="palm"/><link name="left"/><link name="right"/>
  <joint name="left" type="revolute"><parent link="palm"/><child link="left"/><origin xyz="0 0.03 0"/>
    <limit lower="0" upper="1.0471975511965976" effort="3"/></joint>
  <joint name="right" type="revolute"><parent link="palm"/><child link="right"/><origin xyz="0 -0.03 0"/>
    <axis xyz="-1 0 0"/><limit lower="0" upper="1.0471975511965976"/><mimic joint="left"/></joint>
</robot>"""


@pytest.fixture
def folder(tmp_path):
    (mjcf,) = re.findall(r"```xml\n(.*?)```", SECTION, re.DOTALL)
    (toml,) = re.findall(r"```toml\n(.*?)```", SECTION, re.DOTALL)
    (tmp_path / "gripper.xml").write_text(mjcf, encoding="utf-8")
    (tmp_path / "gripper.urdf").write_text(URDF, encoding="utf-8")
    (tmp_path / "ball.toml").write_text(toml, encoding="utf-8")
    return tmp_path


def test_the_example_of_the_readme_is_feasible(folder: Path):
    problem = load_problem(folder / "ball.toml")
    hand = problem.held.hand
    assert (hand.name, hand.title, hand.joint_names) == ("gripper", "A gripper with one motor", ("left", "right"))
    assert analyse(problem.grasp).spaces.dimensions == (1, 0, 0)
    answer = plan(problem.grasp, problem.task)
    assert answer.verdict == "feasible"
    assert answer.margins.min() == pytest.approx(0.5, abs=1e-6)


def test_the_same_gripper_as_a_urdf_is_the_same_grasp(folder: Path):
    one, other = (
        load_problem(folder / "ball.toml", [f'hand.model="gripper.{suffix}"']).grasp for suffix in ("xml", "urdf")
    )
    for matrix in ("G", "J", "S", "C_q"):
        np.testing.assert_allclose(getattr(one, matrix), getattr(other, matrix), atol=1e-12)


OFF_CENTRE = """
<mujoco model="two fingers">
  <worldbody>
    <body name="palm">
      <body name="left" pos="0 0.03 0"><joint name="left" axis="1 0 0" range="0 60"/></body>
      <body name="right" pos="0 -0.03 0"><joint name="right" axis="-1 0 0" range="0 60"/></body>
    </body>
  </worldbody>
  COUPLING
  <actuator>MOTOR</actuator>
</mujoco>
"""
OFF_CENTRE_PROBLEM = """
schema = 1
hand = { model = "hand.xml", posture = POSTURE, compliance = { joint = "0.02 rad/(N m)" } CLOSE }
object = { shape = { sphere = { radius = "12 mm" } }, position = ["0 mm", "6 mm", "80 mm"] }
[contacts]
model = "soft"
friction = 0.6
spin_friction = "5 mm"
stiffness = "8 N/mm"
spin_stiffness = "2 N m/rad"
[[contact]]
link = "left"
point = ["0 mm", "0 mm", "80 mm"]
radius = "8 mm"
[[contact]]
link = "right"
point = ["0 mm", "0 mm", "80 mm"]
radius = "8 mm"
"""
EQUALITY = '<equality><joint joint1="right" joint2="left"/></equality>'
TENDON = '<tendon><fixed name="both"><joint joint="left" coef="1"/><joint joint="right" coef="1"/></fixed></tendon>'


def off_centre(tmp_path, coupling, motor, posture='"zero"', close=', close = "left"'):
    text = OFF_CENTRE.replace("COUPLING", coupling).replace("MOTOR", motor)
    (tmp_path / "hand.xml").write_text(text, encoding="utf-8")
    problem = OFF_CENTRE_PROBLEM.replace("POSTURE", posture).replace("CLOSE", close)
    (tmp_path / "problem.toml").write_text(problem, encoding="utf-8")
    return load_problem(tmp_path / "problem.toml")


def test_rigidly_coupled_fingers_stop_together_and_those_of_a_tendon_go_on(tmp_path):
    with pytest.raises(InputError, match="does not reach"):  # the ball is off the middle
        off_centre(tmp_path, EQUALITY, '<position joint="left"/>')
    held = off_centre(tmp_path, TENDON, '<position tendon="both"/>').held
    assert held.notes == ()
    left, right = held.q
    assert right > left + 0.05  # the finger that is farther away closes more


def test_a_posture_that_parts_rigidly_coupled_joints_is_noted(tmp_path):
    q = off_centre(tmp_path, TENDON, '<position tendon="both"/>').held.q
    posture = f'{{ left = "{q[0]:.15f} rad", right = "{q[1]:.15f} rad" }}'
    (note,) = off_centre(tmp_path, EQUALITY, '<position joint="left"/>', posture, close="").held.notes
    assert "'right'" in note
    assert "rigid coupling to 'left'" in note
