"""Spatial tendons, springs and joints that no motor drives, in MJCF files; MuJoCo is the referee."""

import mujoco
import numpy as np
import pytest
from mjcf_texts import fingers, plain, with_masses

from synergrip.errors import InputError
from synergrip.hands.folder import load_hand
from synergrip.hands.models.model_file import read_model

PULLEY = '<geom name="{0}" type="cylinder" size="{1} 0.01" pos="{2}" quat="0.7071067811865476 0 0.7071067811865476 0"/>'
FINGER = """<mujoco><compiler angle="degree"/>
<default><geom type="mesh" mesh="skin" material="m"/></default>
<worldbody><body name="palm">
  <site name="s0" pos="0 {ra} -0.03"/>
  <body name="prox"><joint name="a" axis="1 0 0" range="0 60" stiffness="{ka}" springref="-10"/>
    {pulley_a}<site name="outside a" pos="0 0.05 0"/><site name="s1" pos="0 {between} 0.025"/><geom/>
    <body name="dist" pos="0 0 0.05"><joint name="b" axis="1 0 0" range="0 60" stiffness="{kb}"/>
      {pulley_b}<site name="outside b" pos="0 0.05 0"/><site name="s2" pos="0 {rb} 0.03"/></body>
  </body>
</body></worldbody>
<tendon><spatial name="cable" {tendon}>
  <site site="s0"/><geom geom="pa" sidesite="outside a"/><site site="s1"/>
  <geom geom="pb" sidesite="outside b"/><site site="s2"/></spatial></tendon>
<actuator><motor name="m" tendon="cable" gear="2" forcerange="-5 0"/></actuator></mujoco>"""


def finger(ra=0.01, rb=0.01, ka=0.5, kb=0.5, tendon="", shift=0.0):
    """Return two hinges and a cable over their backs; about pulleys at the hinges its arms are the radii.

    Pulleys that are moved by `shift` make arms that change.
    """
    return FINGER.format(
        ra=ra, rb=rb, ka=ka, kb=kb, tendon=tendon, between=0.8 * min(ra, rb),
        pulley_a=PULLEY.format("pa", ra, f"0 {shift} 0"), pulley_b=PULLEY.format("pb", rb, f"0 {shift} 0"),
    )  # fmt: skip


def hand_of(folder, text):
    path = folder / "hand.xml"
    path.write_text(text, encoding="utf-8")
    return load_hand(path)


def referee(text):
    """Return the file as MuJoCo reads it, without what it does not need to find."""
    return with_masses(text.replace(' mesh="skin" material="m"', "").replace('type="mesh"', 'size="0.001"'))


def passive_and_pull(model, q):
    """Return the joint forces of springs (n_q,) and the moment arms of the actuators (n_a, n_q) at joint values q."""
    model.opt.gravity[:] = 0
    data = mujoco.MjData(model)
    data.qpos[:] = q
    mujoco.mj_forward(model, data)
    moment = np.zeros((model.nu, model.nv))
    mujoco.mju_sparse2dense(moment, data.actuator_moment, data.moment_rownnz, data.moment_rowadr, data.moment_colind)
    return data.qfrc_passive.copy(), moment


@pytest.mark.parametrize("stiffness", [(0.5, 0.5), (0.2, 1.5), (1.0, 0.4)])
@pytest.mark.parametrize("radii", [(0.01, 0.01), (0.012, 0.006)])
def test_a_cable_about_pulleys_is_a_coupling_and_its_joints_are_where_mujoco_balances_them(tmp_path, stiffness, radii):
    text = finger(*radii, *stiffness)
    hand = hand_of(tmp_path, text)
    free = hand.synergy_sets["free"]
    compliance = 1 / np.array(stiffness)
    along = compliance * radii
    assert free.synergies == ("a",)
    np.testing.assert_allclose(free.S[:, 0], along / along[0], rtol=1e-9)
    expected = np.diag(compliance) - np.outer(along, along) / (radii @ along)
    np.testing.assert_allclose(hand.C_q, expected, atol=1e-9 * compliance.max())
    assert (hand.drives.notes, hand.drives.idle) == ((), ())
    assert not hand.couplings["b"].rigid
    assert hand.joints[0].torque_limit == pytest.approx(2 * radii[0] * 5)
    for angle in (0.5, 0.9):  # of the joint that bends more
        q = free.S @ [min((angle - free.offset) / free.S[:, 0])] + free.offset
        spring, moment = passive_and_pull(referee(text), q)
        force = np.linalg.lstsq(moment.T, -spring, rcond=None)[0]
        assert abs(force[0]) > 5
        np.testing.assert_allclose(moment.T @ force, -spring, atol=1e-9)


def test_a_cable_that_is_nearly_constant_is_taken_with_a_note_that_says_how_nearly(tmp_path):
    hand = hand_of(tmp_path, finger(0.012, 0.009, shift=0.0002))
    (note,) = hand.drives.notes
    assert note.startswith("the moment arms of the spatial tendon 'cable' change by up to ")
    said = float(note.split("by up to ")[1].split(" %")[0]) / 100
    assert 0 < said < 0.05
    model = referee(finger(0.012, 0.009, shift=0.0002))
    postures = np.random.default_rng(1).uniform(0, np.radians(60), (300, 2))
    arms = np.array([passive_and_pull(model, q)[1][0] for q in postures]) / 2  # the gear
    assert np.abs(arms - arms.mean(axis=0)).max() / 0.012 == pytest.approx(said, rel=0.15)  # in other postures
    along = arms.mean(axis=0) / 0.5
    np.testing.assert_allclose(hand.synergy_sets["free"].S[1, 0], along[1] / along[0], rtol=0.01)


def test_a_cable_whose_arms_change_drives_nothing_that_is_known(tmp_path):
    hand = hand_of(tmp_path, finger(0.012, 0.009, shift=0.004))
    assert list(hand.synergy_sets) == ["joints"]
    assert hand.drives.sprung == {}
    assert set(hand.drives.loose) == {"a", "b"}
    reason = hand.drives.loose["a"]
    assert "'m' pulls through the spatial tendon 'cable', whose moment arms change too much" in reason
    assert "a " in reason
    assert " mm, b " in reason
    np.testing.assert_array_equal(hand.C_q, np.zeros((2, 2)))


def test_arms_count_for_the_yield_where_they_do_not_for_the_synergy(tmp_path):
    """A joint without a spring bends alone, whatever the arms are; how far it yields depends on them."""
    hand = hand_of(tmp_path, finger(0.012, 0.009, shift=0.004).replace('stiffness="0.5" springref="-10"', ""))
    assert set(hand.drives.loose) == {"a", "b"}


def test_motors_that_lose_hold_of_a_joint_do_not_drive_it(tmp_path):
    text = """<mujoco><compiler angle="degree"/><worldbody><body name="palm"><site name="s" pos="0 0.01 -0.03"/>
      <body name="f"><joint name="a" axis="1 0 0" range="-60 60"/><site name="t" pos="0 0.01 0.03"/></body>
      </body></worldbody>
      <tendon><spatial name="rope"><site site="s"/><site site="t"/></spatial></tendon>
      <actuator><motor name="m" tendon="rope"/></actuator></mujoco>"""
    assert hand_of(tmp_path, text).drives.loose.keys() == {"a"}  # the arm passes through 0
    assert hand_of(tmp_path, text.replace("-60 60", "-60 10")).drives.idle == ()


def test_a_cable_over_one_joint_drives_it_whatever_its_arm_does(tmp_path):
    text = finger(0.012, 0.009, shift=0.004).replace("</actuator>", '<position joint="b"/></actuator>')
    hand = hand_of(tmp_path, text)
    assert [each.name for each in hand.synergy_sets.values()] == ["joints"]
    assert hand.drives.idle == ()
    np.testing.assert_allclose(hand.C_q, 0, atol=1e-12)  # both are held by motors


def test_springs_in_tendons_share_the_pull_too(tmp_path):
    """A spring along a tendon of its own, over the second joint, at rest where that is at 0.3 rad."""

    def text(joint, tendon):
        spring = f'<fixed name="band" {tendon}><joint joint="b" coef="0.02"/></fixed>'
        cable = '<fixed name="t"><joint joint="a" coef="1"/><joint joint="b" coef="0.8"/></fixed>'
        return fingers(("a", 'axis="1 0 0" stiffness="0.5"'), ("b", f'axis="1 0 0" {joint}'),
                       after=f'<tendon>{cable}{spring}</tendon><actuator><motor tendon="t"/></actuator>')  # fmt: skip

    by_tendon = hand_of(tmp_path, text("", 'stiffness="2000" springlength="0.006"'))
    by_joint = hand_of(tmp_path, text('stiffness="0.8" springref="0.3"', ""))
    np.testing.assert_allclose(by_tendon.synergy_sets["free"].S, by_joint.synergy_sets["free"].S, atol=1e-12)
    np.testing.assert_allclose(by_tendon.synergy_sets["free"].offset, by_joint.synergy_sets["free"].offset, atol=1e-12)
    np.testing.assert_allclose(by_tendon.C_q, by_joint.C_q, atol=1e-12)
    assert np.abs(by_joint.synergy_sets["free"].offset).max() > 0.1


def test_joints_that_only_springs_hold_are_no_synergies_and_yield_as_these_do(tmp_path):
    text = fingers(("a", 'axis="1 0 0"'), ("b", 'axis="1 0 0" stiffness="0.25" springref="0.1"'),
                   ("s", 'type="slide" stiffness="400"'), after='<actuator><motor joint="a"/></actuator>')  # fmt: skip
    hand = hand_of(tmp_path, text)
    free = hand.synergy_sets["free"]
    assert list(hand.synergy_sets) == ["free", "joints"]
    assert free.synergies == ("a",)
    assert "no actuator is known to drive 'b', 's'" in free.title
    np.testing.assert_allclose(free.offset, [0, 0.1, 0])
    np.testing.assert_allclose(hand.C_q, np.diag([0, 4, 1 / 400]), atol=1e-15)
    assert hand.drives.sprung == pytest.approx({"b": 0.1, "s": 0})
    np.testing.assert_allclose(hand.postures["zero"], [0, 0.1, 0])


def test_a_spring_that_presses_a_joint_against_the_end_of_its_range_rests_there(tmp_path):
    text = fingers(("a", ""), ("b", 'stiffness="1" springref="-0.4" range="0 1"'),
                   after='<actuator><motor joint="a"/></actuator>')  # fmt: skip
    assert hand_of(tmp_path, text).drives.sprung == {"b": 0}


DRIVES = {
    "its own motor": ('<motor joint="b"/>', ()),
    "in the frame of the parent": ('<motor jointinparent="b"/>', ()),
    "a plugin": ('<plugin joint="b" plugin="no.such"/>', ()),
    "a muscle": ('<muscle joint="b"/>', ()),
    "nothing": ("", ("b",)),
    "a gear of 0": ('<motor joint="b" gear="0"/>', ("b",)),
    "a damper": ('<damper joint="b" kv="1" ctrlrange="0 1"/>', ("b",)),
    "adhesion": ('<adhesion body="b" ctrlrange="0 1"/>', ("b",)),
    "at a site": ('<motor name="push" site="s"/>', ("b",)),
}


@pytest.mark.parametrize(("actuator", "idle"), DRIVES.values(), ids=DRIVES)
def test_what_drives_a_joint(tmp_path, actuator, idle):
    text = plain("a", "b", after=f'<actuator><motor joint="a"/>{actuator}</actuator>')
    hand = hand_of(tmp_path, text.replace('"palm">', '"palm"><site name="s"/>'))
    assert hand.drives.idle == idle
    assert select_names(hand) == tuple(name for name in "ab" if name not in idle)
    if idle:
        assert hand.drives.loose["b"] == "no spring holds it either"
    told = "actuators that act at a site are not read, nor what they drive: 'push'"
    assert hand.drives.notes == ((told,) if "site" in actuator else ())


def select_names(hand):
    return next(iter(hand.synergy_sets.values())).synergies


def test_followers_of_a_driven_joint_are_driven_and_those_of_another_one_are_not(tmp_path):
    equalities = '<equality><joint joint1="b" joint2="a"/><joint joint1="d" joint2="c" polycoef="0 2"/></equality>'
    hand = hand_of(tmp_path, plain("a", "b", "c", "d", after=f'{equalities}<actuator><motor joint="b"/></actuator>'))
    assert hand.drives.idle == ("c", "d")
    assert select_names(hand) == ("a",)
    assert {name: each.rigid for name, each in hand.couplings.items()} == {"b": True, "d": True}
    assert hand.drives.loose["c"] == hand.drives.loose["d"]


def test_without_actuators_every_joint_counts_as_driven(tmp_path):
    hand = hand_of(tmp_path, plain("a", "b"))
    assert hand.drives is None
    sprung = fingers(("a", 'axis="0 0 1" stiffness="2"'), ("b", 'axis="0 0 1"'))
    hand = hand_of(tmp_path, sprung)
    assert select_names(hand) == ("a", "b")
    assert hand.drives.idle == ()
    (note,) = hand.drives.notes
    assert "the file has no actuators: every joint counts as driven, and its springs are not read (joint 'a')" in note
    np.testing.assert_array_equal(hand.C_q, np.zeros((2, 2)))


def test_a_hand_that_no_motor_drives_has_only_the_set_of_all_joints(tmp_path):
    hand = hand_of(tmp_path, plain("a", "b", after='<actuator><adhesion body="a" ctrlrange="0 1"/></actuator>'))
    assert hand.drives is None  # adhesion says nothing of joints
    hand = hand_of(tmp_path, plain("a", "b", after='<actuator><motor joint="a" gear="0"/></actuator>'))
    assert list(hand.synergy_sets) == ["joints"]
    assert hand.drives.idle == ("a", "b")


UNREAD = {
    "springdamper": ('springdamper="0.1 1"', "", "the spring of joint 'b' is not read: springdamper needs inertias"),
    "a slack band": (
        "",
        'springlength="0 0.1" stiffness="3"',
        "tendon 'band' is not read: springlength leaves it slack",
    ),
}


@pytest.mark.parametrize(("joint", "tendon", "note"), UNREAD.values(), ids=UNREAD)
def test_springs_that_are_not_read_are_named(tmp_path, joint, tendon, note):
    band = f'<tendon><fixed name="band" {tendon}><joint joint="b" coef="1"/></fixed></tendon>'
    text = fingers(("a", ""), ("b", joint), after=f'{band}<actuator><motor joint="a"/></actuator>')
    hand = hand_of(tmp_path, text)
    assert note in hand.drives.notes[0]
    assert list(hand.drives.loose) == ["b"]
    np.testing.assert_array_equal(hand.C_q, np.zeros((2, 2)))


def test_an_equality_of_a_spatial_tendon_with_constant_arms_is_a_relation(tmp_path):
    motor = '<actuator><motor name="m" tendon="cable" gear="2" forcerange="-5 0"/></actuator>'
    held = finger(0.012, 0.006).replace(motor, '<equality><tendon tendon1="cable"/></equality>')
    tree = read_model(write(tmp_path, held))
    assert tree.couplings["b"].ratios == pytest.approx({"a": -2})
    with pytest.raises(InputError, match="holds the spatial tendon 'cable', which is not linear in the joints"):
        read_model(write(tmp_path, held.replace('size="0.012', 'size="0.004')))


def write(folder, text):
    path = folder / "hand.xml"
    path.write_text(text, encoding="utf-8")
    return path


def test_a_tendon_over_a_hinge_and_a_slide_is_shared_by_springs_alone(tmp_path):
    def text(*stiffness):
        joints = [("a", f'axis="0 0 1" {stiffness[0]}'), ("s", f'type="slide" axis="0 0 1" {stiffness[1]}')]
        tendon = '<fixed name="t"><joint joint="a" coef="0.01"/><joint joint="s" coef="1"/></fixed>'
        return fingers(*joints, after=f'<tendon>{tendon}</tendon><actuator><motor tendon="t"/></actuator>')

    hand = hand_of(tmp_path, text('stiffness="0.5"', 'stiffness="1000"'))
    np.testing.assert_allclose(hand.synergy_sets["free"].S[:, 0], [1, (1 / 1000) / (0.01 / 0.5)])
    with pytest.raises(InputError, match="pulls at hinges and slides"):
        hand_of(tmp_path, text("", ""))


def test_a_geom_that_is_fitted_to_a_mesh_is_refused_where_it_stands(tmp_path):
    with pytest.raises(InputError, match="fitted to a mesh; give it a type and a size") as caught:
        hand_of(tmp_path, finger().replace('name="pa"', 'name="pa" mesh="skin"'))
    assert caught.value.issues[0].line == 6


EFFORTS = {
    "its own": ('<motor joint="a" gear="3" forcerange="-2 1"/>', 6),
    "through a cord": ('<motor tendon="cord" gear="3" forcerange="-2 0"/>', 2 * 3 * (1 + 0.8**2)),
    "at the follower": ('<motor joint="b" forcerange="-2 2"/>', 2 * 0.8),
    "at both": ('<motor joint="a" forcerange="-1 1"/><motor joint="b" forcerange="-2 2"/>', 1 + 2 * 0.8),
    "without a limit": ('<motor joint="a" forcerange="-1 1"/><motor joint="b"/>', np.inf),
}


@pytest.mark.parametrize(("actuators", "effort"), EFFORTS.values(), ids=EFFORTS)
def test_efforts_are_what_all_actuators_give_along_a_synergy(tmp_path, actuators, effort):
    """The effort of a synergy is sigma = S' tau: a cord with the pull f gives tau = r f, and so r' S f."""
    cord = '<fixed name="cord"><joint joint="a" coef="1"/><joint joint="b" coef="0.8"/></fixed>'
    equality = "" if "cord" in actuators else '<equality><joint joint1="b" joint2="a" polycoef="0 0.8"/></equality>'
    after = f"{equality}<tendon>{cord}</tendon><actuator>{actuators}</actuator>"
    free = hand_of(tmp_path, plain("a", "b", after=after)).synergy_sets["free"]
    np.testing.assert_allclose(free.S, [[1], [0.8]])
    np.testing.assert_allclose(free.effort_limits, [effort])


def test_a_torque_limit_of_the_joint_itself_counts_as_the_effort(tmp_path):
    equality = (
        '<equality><joint joint1="b" joint2="a"/></equality><actuator><motor joint="a" forcerange="-9 9"/></actuator>'
    )
    text = fingers(("a", 'actuatorfrcrange="-4 4"'), ("b", ""), after=equality)
    assert hand_of(tmp_path, text).synergy_sets["free"].effort_limits.tolist() == [4]
