"""Springs that one motor shares and a posture bends out of balance: no tick where they push the object away."""

from dataclasses import replace

import mujoco
import numpy as np
import pytest

from synergrip import Plan, Unknown, load_problem, plan
from synergrip.planning.check import judge_references
from synergrip.planning.in_balance import BALANCE, out_of_balance
from synergrip.planning.references import References
from synergrip.reports.text.text_broken import broken
from synergrip.statics.unbalanced_springs import unbalanced_springs

JAW = """<body name="{0}" pos="{1} 0 0.1"><inertial pos="0 0 0" mass="0.1" diaginertia="1e-4 1e-4 1e-4"/>
  <joint name="{0}" type="slide" axis="{2} 0 0" range="-0.02 {3}" stiffness="{4}" damping="20"/>{5}</body>"""
TIP = '<geom type="sphere" size="0.005" pos="{0} 0 0"/>'
BOX = """<body pos="0 0 0.1"><joint name="box" type="slide" axis="1 0 0" damping="5"/>
  <geom type="box" size="0.04 0.03 0.03" mass="0.2" solref="-8000 -50"/></body>"""
TENDON = '<fixed name="t"><joint joint="l" coef="1"/><joint joint="r" coef="1"/></fixed>'


def model(tips=("", ""), box="", far=0.06):
    """Return two jaws that slide on one tendon, with springs of 300 and 100 N/m."""
    left = JAW.format("l", -0.06, 1, far, 300, tips[0])
    right = JAW.format("r", 0.06, -1, far, 100, tips[1])
    return (
        f'<mujoco><option gravity="0 0 0"/><worldbody><body name="palm">{left}{right}</body>{box}</worldbody>'
        f'<tendon>{TENDON}</tendon><actuator><motor tendon="t" forcerange="-90 90"/></actuator></mujoco>'
    )


def problem(folder, x="0 mm", **hand):
    (folder / "hand.xml").write_text(model(**hand), encoding="utf-8")
    stated = {
        "schema": 1,
        "hand": {"model": str(folder / "hand.xml"), "posture": {"l": "0 mm"}, "close": "l"},
        "object": {
            "shape": {"box": {"size": ["80 mm", "60 mm", "60 mm"]}}, "mass": "200 g", "position": [x, "0 mm", "100 mm"],
        },
        "contacts": {
            "model": "soft", "friction": 0.6, "spin_friction": "5 mm", "stiffness": "8 N/mm",
            "spin_stiffness": "2 N m/rad",
        },
        "contact": [{"name": "cl", "link": "l"}, {"name": "cr", "link": "r"}],
        "task": {"gravity": [0, 0, -9.81]},
        "limits": {"margin": "0.5 N"},
    }  # fmt: skip
    return load_problem(stated)


@pytest.fixture(scope="module")
def bent(tmp_path_factory):
    return problem(tmp_path_factory.mktemp("bent"))


def test_they_push_the_object_as_far_as_in_mujoco(bent):
    found = unbalanced_springs(bent.grasp)
    full = mujoco.MjModel.from_xml_string(model((TIP.format(-0.005), TIP.format(0.005)), BOX))
    data = mujoco.MjData(full)
    at = [full.joint(name).qposadr[0] for name in ("l", "r", "box")]
    data.qpos[at] = [0.02, 0.02, 0.0]
    data.ctrl[:] = 8
    for _ in range(4000):
        mujoco.mj_step(full, data)
    assert found.push[0] == pytest.approx(data.qpos[at[2]], abs=1e-3)
    np.testing.assert_allclose(found.way, [-0.01, 0.01], atol=1e-12)
    np.testing.assert_allclose(found.torques, [3, -1], atol=1e-9)
    assert np.abs(found.forces).max() < 1e-9, "the object goes where they leave it"


def test_such_a_grasp_has_no_tick(bent):
    answer = plan(bent.grasp, bent.task)
    assert isinstance(answer, Unknown)
    assert "they would push the object by about 10 mm" in answer.why
    for notes in (answer.notes, bent.notes):
        (note,) = [each for each in notes if "out of balance" in each]
        assert "'l' is at 20 mm, would go to 10 mm without contact, and is kept from it by 3 N; 'r' is at 20 mm" in note
        assert "(-10 mm, 0 mm, 0 mm) along x, y, z of the palm" in note
    judged = judge_references(bent.grasp, answer.task, References(answer.motion.times, answer.motion.dz_r, {}))
    assert [check.name for check in judged.checks if not check.passed] == [BALANCE]
    (told,) = broken(judged)
    assert answer.why.startswith(told)


def test_springs_that_press_without_pushing_are_told_by_what_they_press(bent):
    found = replace(unbalanced_springs(bent.grasp), moved=0.0, forces=np.eye(bent.grasp.n_l)[0])
    assert out_of_balance(found, bent.grasp).endswith("by about 0 mm and change normal forces by up to 1 N")


def test_where_the_note_sends_the_object_they_are_in_balance(tmp_path):
    moved = problem(tmp_path, x="-10 mm")
    assert unbalanced_springs(moved.grasp) is None
    assert isinstance(plan(moved.grasp, moved.task), Plan)


def test_a_joint_stops_at_the_end_of_its_range_on_the_way(tmp_path):
    """The tendon keeps l + r: where r stops at 22 mm, l does at 18 mm."""
    found = unbalanced_springs(problem(tmp_path, far=0.022).grasp)
    np.testing.assert_allclose(found.way, [-0.002, 0.002], atol=1e-12)
