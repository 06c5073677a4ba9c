"""Problems on model files with joints that no motor drives, and on arms that carry a hand."""

import re
from dataclasses import replace

import mujoco
import numpy as np
import pytest
from mjcf_texts import with_masses

from synergrip import Infeasible, InputError, JointTorque, Plan, load_problem, plan
from synergrip.planning.check import judge_references
from synergrip.planning.references import References
from synergrip.planning.springs import spring_notes
from synergrip.reports.data.json_grasp import in_order_document
from synergrip.reports.text.text_check import judgement_document
from synergrip.reports.text.text_grasp import in_order_text

PINCH = """<mujoco><compiler angle="degree"/><worldbody><body name="palm">
  <site name="l0" pos="0 0.030 0.010"/><site name="r0" pos="0 -0.030 0.010"/>
  <body name="l" pos="0 0.04 0"><joint name="l" axis="1 0 0" range="-30 90"/><site name="l1" pos="0 -0.01 0.03"/>
    <body name="l tip" pos="0 0 0.05"><joint name="l tip" axis="1 0 0" range="-30 90" LEFT/>
      <site name="l2" pos="0 -0.008 0.03"/></body></body>
  <body name="r" pos="0 -0.04 0"><joint name="r" axis="-1 0 0" range="-30 90"/><site name="r1" pos="0 0.01 0.03"/>
    <body name="r tip" pos="0 0 0.05"><joint name="r tip" axis="-1 0 0" range="-30 90" RIGHT/>
      <site name="r2" pos="0 0.008 0.03"/></body></body>
  <body name="spare"><joint name="spare" range="-30 90"/></body>
</body></worldbody>
<tendon>TENDONS</tendon><actuator>ACTUATORS</actuator></mujoco>"""
PROBLEM = """schema = 1
[hand]
model = "hand.xml"
posture = { l = "-10 deg", r = "-10 deg" }
close = { l = 1, r = 1 }
[object]
shape = { box = { size = ["40 mm", "50 mm", "30 mm"] } }
mass = "200 g"
position = ["0 mm", "0 mm", "80 mm"]
[contacts]
model = "soft"
friction = 0.6
spin_friction = "5 mm"
stiffness = "8 N/mm"
spin_stiffness = "2 N m/rad"
[[contact]]
link = "l tip"
point = ["0 mm", "0 mm", "30 mm"]
radius = "8 mm"
[[contact]]
link = "r tip"
point = ["0 mm", "0 mm", "30 mm"]
radius = "8 mm"
[task]
gravity = [0, 0, -9.81]
move = [{ axis = "z", lift = "1 mm" }]
[limits]
margin = "0.3 N"
normal_force = "20 N"
"""
MOTORS = '<position joint="l"/><position joint="r"/>'
CABLE = '<spatial name="{0} cable"><site site="{0}0"/><site site="{0}1"/><site site="{0}2"/></spatial>'
CORD = '<fixed name="{0} cable"><joint joint="{0}" coef="1"/><joint joint="{0} tip" coef="0.8"/></fixed>'
PULLED = '<motor name="l motor" tendon="l cable"/><motor name="r motor" tendon="r cable"/>'


def problem(folder, tendons="", actuators=MOTORS, left="", right="", changes=(), text=PROBLEM):
    hand = (
        PINCH.replace("TENDONS", tendons).replace("ACTUATORS", actuators).replace("LEFT", left).replace("RIGHT", right)
    )
    (folder / "hand.xml").write_text(hand, encoding="utf-8")
    (folder / "problem.toml").write_text(text, encoding="utf-8")
    return load_problem(folder / "problem.toml", list(changes))


def refused(folder, **given):
    with pytest.raises(InputError) as caught:
        problem(folder, **given)
    (issue,) = caught.value.issues
    assert issue.key == "hand.synergies"
    assert issue.line == 2 or "--set hand.synergies" in issue.file
    return issue.message


def flat(text):
    return " ".join(text.split())


SPRING = 'stiffness="0.5"'


def test_tips_that_only_springs_hold_yield_and_are_no_synergies(tmp_path):
    held = problem(tmp_path, left=SPRING, right=SPRING)
    assert held.grasp.S.shape == (5, 2)
    np.testing.assert_allclose(held.grasp.C_q, np.diag([0, 2, 0, 2, 0]))
    first, second = held.notes[:2]
    assert first == "no actuator of the model file drives 'l tip', 'r tip': no synergy moves them, springs hold them"
    assert second == "no actuator of the model file is known to drive 'spare': no synergy moves them"
    answer = plan(held.grasp, held.task)
    assert isinstance(answer, Infeasible)
    assert answer.stage == "direction"
    for text in (in_order_text(held), str(in_order_document(held))):
        assert first in flat(text)


def test_a_tip_that_nothing_holds_is_refused_with_what_to_write(tmp_path):
    message = refused(tmp_path, left=SPRING)
    assert "no actuator of the model file is known to drive 'r tip' ('r tip': no spring holds it either)" in message
    assert "spare" not in message  # it carries no contact


def test_the_refusal_names_what_was_not_read(tmp_path):
    message = refused(tmp_path, left='springdamper="0.1 1"', actuators=f'{MOTORS}<motor name="far" site="l0"/>')
    assert "actuators that act at a site are not read, nor what they drive: 'far'" in message
    assert "the spring of joint 'l tip' is not read: springdamper needs inertias" in message


def test_each_thing_that_the_refusal_advises_is_taken(tmp_path):
    message = refused(tmp_path)
    (tmp_path / "mine.toml").write_text(
        'schema = 1\njoints = ["l", "l tip", "r", "r tip"]\nsynergies = ["both"]\nS = [[1], [0.8], [1], [0.8]]\n',
        encoding="utf-8",
    )
    file = problem(tmp_path, changes=[f"hand.{re.search(r'synergies = .mine.toml.', message)[0]}"])
    assert file.grasp.n_z == 1
    assert "synergies move 'l tip', 'r tip', which no actuator of the model file is known to drive" in file.notes[0]
    named = problem(tmp_path, changes=['hand.synergies=["l", "l tip", "r", "r tip"]'])
    assert named.grasp.n_z == 4
    assert named.notes[0] == file.notes[0]
    yields = [f'"{c} rad/(N m)"' for c in (0, 0.1, 0, 0.2, 0)]
    listed = problem(tmp_path, changes=[f"hand.compliance.joint=[{', '.join(yields)}]"])
    assert listed.grasp.n_z == 2
    np.testing.assert_allclose(np.diag(listed.grasp.C_q), [0, 0.1, 0, 0.2, 0])
    assert problem(tmp_path, actuators=MOTORS + '<motor joint="l tip"/><motor joint="r tip"/>').grasp.n_z == 4
    assert problem(tmp_path, tendons=CORD.format("l") + CORD.format("r"), actuators=PULLED).grasp.n_z == 2


@pytest.mark.parametrize(
    "change", ['hand.synergies=["l", "r"]', 'hand.compliance.joint="0.1 rad/(N m)"', "hand.synergies=2"]
)
def test_what_says_nothing_of_the_tips_does_not_do(tmp_path, change):
    assert "known to drive 'l tip', 'r tip' (" in refused(tmp_path, changes=[change])


def test_all_joints_are_taken_when_they_are_asked_for(tmp_path):
    held = problem(tmp_path, changes=['hand.synergies="all"'])
    assert held.grasp.n_z == 5
    assert "'l tip', 'r tip', 'spare', which no actuator" in held.notes[0]


def test_cables_whose_arms_change_are_refused_by_name(tmp_path):
    message = refused(
        tmp_path, tendons=CABLE.format("l") + CABLE.format("r"), actuators=PULLED, left=SPRING, right=SPRING
    )
    for part in (
        "known to drive 'l', 'l tip', 'r', 'r tip', 'spare' (",
        "'l motor' pulls through the spatial tendon 'l cable'",
        "<fixed>",
    ):
        assert part in message
    again = refused(
        tmp_path, tendons=CABLE.format("l") + CABLE.format("r"), actuators=PULLED, changes=['hand.synergies=["l", "r"]']
    )
    assert "known to drive 'l tip', 'r tip' (" in again


def test_cords_make_two_synergies_and_the_springs_give_way_to_a_stated_compliance(tmp_path):
    given = {"tendons": CORD.format("l") + CORD.format("r"), "actuators": PULLED, "left": SPRING, "right": SPRING}
    held = problem(tmp_path, **given)
    assert held.grasp.n_z == 2
    stated = problem(tmp_path, **given, changes=['hand.compliance.joint="0.05 rad/(N m)"'])
    np.testing.assert_allclose(stated.grasp.C_q, 0.05 * np.eye(5))
    assert any("hand.compliance.joint stands in place of what the springs" in note for note in stated.notes)
    assert plan(stated.grasp, stated.task).stage == "direction"


def test_one_compliance_for_all_leaves_springs_that_nothing_else_helps(tmp_path):
    held = problem(tmp_path, left=SPRING, right=SPRING, changes=['hand.compliance.joint="0.05 rad/(N m)"'])
    np.testing.assert_allclose(held.grasp.C_q, np.diag([0.05, 2, 0.05, 2, 0.05]))
    assert not any("in place of" in note for note in held.notes)


def test_a_spring_that_the_posture_bends_is_noted(tmp_path):
    held = problem(tmp_path, left=SPRING + ' springref="4"', right=SPRING)
    assert np.degrees(held.held.q[1]) == pytest.approx(4)
    assert not any("out of balance" in note for note in held.notes)
    bent = 'hand.posture={ l = "-10 deg", r = "-10 deg", "r tip" = "3 deg" }'
    held = problem(tmp_path, left=SPRING + ' springref="4"', right=SPRING, changes=[bent])
    assert np.degrees(held.held.q[[1, 3]]) == pytest.approx([4, 3])
    (note,) = [each for each in held.notes if "out of balance" in each]
    assert "'r tip' is at 3 deg, would go to 0 deg without contact, and is kept from it by 0.0262 N m" in note


LINKS = "".join(f'<link name="{name}"/>' for name in ("base", "lift", "turn", "palm", "left", "right"))
ARM = f"""<robot name="arm">{LINKS}
  <joint name="lift" type="prismatic"><parent link="base"/><child link="lift"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1"/></joint>
  <joint name="turn" type="revolute"><parent link="lift"/><child link="turn"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3"/></joint>
  <joint name="flange" type="fixed"><parent link="turn"/><child link="palm"/><origin xyz="0.4 0 0"/></joint>
  <joint name="motor" type="prismatic"><parent link="palm"/><child link="left"/><axis xyz="0 1 0"/>
    <limit lower="0" upper="0.04"/></joint>
  <joint name="other" type="prismatic"><parent link="palm"/><child link="right"/><axis xyz="0 -1 0"/>
    <limit lower="0" upper="0.04"/><mimic joint="motor"/></joint>
</robot>"""
HELD = """schema = 1
hand = { model = "arm.urdf", posture = { motor = "40 mm" }, close = "-motor" }
object = { shape = { sphere = { radius = "20 mm" } }, mass = "200 g", position = ["400 mm", "0 mm", "0 mm"] }
[contacts]
model = "soft"
friction = 0.6
spin_friction = "5 mm"
stiffness = "8 N/mm"
spin_stiffness = "2 N m/rad"
[[contact]]
link = "left"
[[contact]]
link = "right"
[task]
gravity = [0, 0, -9.81]
move = [{ axis = "z", lift = "1 mm" }]
[limits]
margin = "0.5 N"
"""
AT_PALM = ['hand.palm="palm"', 'object.position=["0 mm", "0 mm", "0 mm"]']


def arm(folder, changes=(), text=HELD):
    (folder / "arm.urdf").write_text(ARM, encoding="utf-8")
    (folder / "problem.toml").write_text(text, encoding="utf-8")
    return load_problem(folder / "problem.toml", list(changes))


def test_an_arm_that_carries_the_grasp_is_noted_with_the_palm_that_leaves_it_out(tmp_path):
    held = arm(tmp_path)
    assert held.grasp.n_z == 3
    assert held.notes[0] == (
        "the synergies move 'lift', 'turn', which carry all contacts: the arm moves the object; when only the hand is "
        'to move it, write hand.palm = "palm" (an argument of load_hand in code)'
    )
    assert all("collide" in note for note in held.notes[1:])
    assert plan(held.grasp, held.task).verdict == "feasible"
    assert "carries all contacts" in arm(tmp_path, ['hand.synergies=["lift", "motor"]']).notes[0]
    assert "all contacts" not in str(arm(tmp_path, ['hand.synergies=["motor"]']).notes)


def test_above_the_palm_all_stands_still(tmp_path):
    held = arm(tmp_path, AT_PALM)
    assert held.held.hand.joint_names == ("motor", "other")
    assert "all contacts" not in str(held.notes)
    answer = plan(held.grasp, held.task)
    assert (answer.verdict, answer.stage) == ("infeasible", "direction")


STILL = {
    "a contact": (
        "contact[1].link=turn",
        "contact[1].link",
        "link 'turn' stands still: the palm 'palm' ",
    ),
    "a posture": ('hand.posture={ motor = "40 mm", lift = "1 mm" }', "hand.posture.lift", "'lift' stands still"),
    "a synergy": ('hand.synergies=["motor", "lift"]', "hand.synergies[1]", "'lift' stands still"),
    "closing": ("hand.close=turn", "hand.close", "'turn' stands still"),
}


@pytest.mark.parametrize(("change", "key", "message"), STILL.values(), ids=STILL)
def test_what_stands_still_is_not_to_be_moved_or_touched(tmp_path, change, key, message):
    with pytest.raises(InputError, match=message) as caught:
        arm(tmp_path, [*AT_PALM, change])
    assert [issue.key for issue in caught.value.issues] == [key]


def test_a_wrist_that_nothing_drives_may_be_left_out_by_the_palm(tmp_path):
    text = PINCH.replace(
        '<worldbody><body name="palm">', '<worldbody><body name="wall"><body name="palm"><joint name="w"/>'
    )
    text = text.replace("</body></worldbody>", "</body></body></worldbody>").replace("TENDONS", "")
    hand = text.replace("ACTUATORS", MOTORS + '<motor joint="l tip"/><motor joint="r tip"/>')
    (tmp_path / "hand.xml").write_text(hand.replace("LEFT", "").replace("RIGHT", ""), encoding="utf-8")
    (tmp_path / "problem.toml").write_text(PROBLEM, encoding="utf-8")
    with pytest.raises(InputError, match=r"known to drive 'w' .* or hand\.palm = \"palm\", to leave out what is above"):
        load_problem(tmp_path / "problem.toml")
    assert load_problem(tmp_path / "problem.toml", ['hand.palm="palm"']).grasp.n_z == 4


ALL = MOTORS + '<position joint="l tip"/><position joint="r tip"/>'
STRONG = 'stiffness="0.8" springref="-60"'
FEW = ("task.knots=5", "task.move[0].lift=0.4 mm")


def planned_with(folder, *limits):
    held = problem(folder, actuators=ALL, left=STRONG, changes=[*FEW, *limits])
    found = plan(held.grasp, held.task)
    assert isinstance(found, Plan)
    return held, found


def of_springs(notes):
    return [note for note in notes if "springs of the model file, which" in note]


@pytest.fixture(scope="module")
def free(tmp_path_factory):
    """A plan without a limit, and what its motors need: of contacts, and with MuJoCo's own springs."""
    held, found = planned_with(tmp_path_factory.mktemp("free"))
    hand = PINCH.replace("TENDONS", "").replace("ACTUATORS", ALL).replace("LEFT", STRONG).replace("RIGHT", "")
    model = with_masses(hand)
    takes = []
    for q in found.executed.states.q:
        data = mujoco.MjData(model)
        data.qpos[[model.joint(name).qposadr[0] for name in found.grasp.joints]] = q
        mujoco.mj_forward(model, data)
        takes.append([-data.qfrc_spring[model.joint(name).dofadr[0]] for name in found.grasp.joints])
    return held, found, np.array(found.motion.torques), np.array(takes)


def test_what_motors_need_with_springs_is_that_of_mujoco(free, tmp_path):
    held, found, alone, takes = free
    whole, i = np.abs(alone + takes), list(found.grasp.joints).index("l tip")
    assert whole[:, i].max() > np.abs(alone).max(), "or this test says nothing"
    assert not of_springs(found.notes), "no limit is asked for"
    between = (whole[:, i].max() + np.abs(alone).max()) / 2
    _, bound = planned_with(tmp_path, f"limits.joint_torque={between}")
    (note,) = of_springs(bound.notes)
    k = int(np.argmax(whole[:, i]))
    assert f"limits.joint_torque does not count, 'l tip' needs {(alone + takes)[k, i]:.4g} N m at" in note
    assert f"{alone[k, i]:.4g} N m of it for contacts: more than its {between:.4g} N m, which leave contacts " in note
    assert f"{-between - takes[k, i]:.4g} to {between - takes[k, i]:.4g} N m there" in note
    judged = judge_references(held.grasp, bound.task, References(bound.time, bound.dz_r, {}))
    assert of_springs(judgement_document(judged)["notes"]) == [note]


def test_limits_with_room_for_springs_are_not_noted(free, tmp_path):
    alone, takes = free[2:]
    enough = 1.01 * np.abs(alone + takes).max()
    assert not of_springs(planned_with(tmp_path, f"limits.joint_torque={enough}")[1].notes)
    (note,) = of_springs(
        planned_with(tmp_path, f"limits.actuator_effort={0.99 * np.abs(alone + takes).max()}")[1].notes
    )
    assert "limits.actuator_effort does not count, 'l tip' needs" in note


def test_joints_without_springs_may_be_at_their_limits(free, tmp_path):
    """The springs of the left tip take nothing of the motors of the right finger."""
    _, found, alone, takes = free
    i = list(found.grasp.joints).index("r")
    enough = [10.0] * alone.shape[1]
    enough[i] = float(np.abs(alone[:, i]).max()) * (1 - 1e-9)
    assert not takes[:, i].any()
    assert not list(spring_notes(found.executed, alone, replace(found.task, limits=(JointTorque(enough),))))
    tip = list(found.grasp.joints).index("l tip")
    enough[tip] = float(np.abs(alone[:, tip]).max())
    assert len(list(spring_notes(found.executed, alone, replace(found.task, limits=(JointTorque(enough),))))) == 1
