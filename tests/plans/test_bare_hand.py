"""The example of models/README.md: a problem on a hand that is one MJCF file."""

import re
from pathlib import Path

import numpy as np
import pytest

from synergrip import analyse, load_problem, plan
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
