"""Springs that oppose or help the motors of two jaws: what limits and goals leave out is told, with units."""

import pytest

from synergrip import Infeasible, load_problem, plan

JAW = '<body name="{0}" pos="{1} 0 0.1"><joint name="{0}" type="slide" axis="{2} 0 0" range="-0.02 0.06" {3}/></body>'
MOTOR = '<position joint="{0}" forcerange="-{1} {1}"/>'
HAND = """schema = 1
title = "jaws"
model = "hand.xml"
[[joint]]
name = "r"
torque_limit = "6 N"
[[joint]]
name = "l"
torque_limit = "6 N"
[pads]
cl = { link = "l", point = ["0 mm", "0 mm", "0 mm"], normal = "x" }
cr = { link = "r", point = ["0 mm", "0 mm", "0 mm"], normal = [-1, 0, 0] }
"""
RESISTS = 'stiffness="200"', ""
HELPS = ('stiffness="200" springref="0.04"',) * 2


def problem(folder, springs, force, *, minimise="effort", listed=False, **limits):
    """Return a box between jaws at 20 mm: each spring asks its motor for 4 N, or helps it with 4 N."""
    jaws = JAW.format("l", -0.06, 1, springs[0]) + JAW.format("r", 0.06, -1, springs[1])
    (folder / "hand.xml").write_text(
        f'<mujoco><worldbody><body name="palm">{jaws}</body></worldbody>'
        f"<actuator>{MOTOR.format('l', force)}{MOTOR.format('r', force)}</actuator></mujoco>",
        encoding="utf-8",
    )
    (folder / "hand.toml").write_text(HAND, encoding="utf-8")
    contacts = {
        "model": "soft", "friction": 0.6, "spin_friction": "5 mm", "stiffness": "8 N/mm",
        "spin_stiffness": "2 N m/rad",
    }  # fmt: skip
    where = {"contacts": {**contacts, "at": ["cl", "cr"]}} if listed else {
        "contacts": contacts, "contact": [{"name": "cl", "link": "l"}, {"name": "cr", "link": "r"}],
    }  # fmt: skip
    return load_problem({
        "schema": 1,
        "hand": {"model": str(folder if listed else folder / "hand.xml"), "posture": {"l": "20 mm", "r": "20 mm"}},
        "object": {
            "shape": {"box": {"size": ["80 mm", "60 mm", "60 mm"]}}, "mass": "200 g",
            "position": ["0 mm", "0 mm", "100 mm"],
        },
        **where,
        "task": {"gravity": [0, 0, -9.81]},
        "limits": {"margin": "0.5 N", **limits},
        "goal": {"minimise": minimise},
    })  # fmt: skip


def noted(folder, *given, **more):
    held = problem(folder, *given, **more)
    answer = plan(held.grasp, held.task)
    return answer, [note for note in (*answer.notes, *held.notes) if "springs" in note]


def test_a_no_tells_what_springs_that_help_leave_contacts(tmp_path):
    answer, notes = noted(tmp_path, HELPS, 2, joint_torque="hand")
    assert isinstance(answer, Infeasible)
    assert "ask 'l' for -4 N, which of its 2 N leaves contacts 2 to 6 N; 'r' for -4 N, which" in notes[0]
    assert "'l' with -4 N, 'r' with -4 N, up to 200% of what they can" in notes[1]


@pytest.mark.parametrize("key", ["sustained_torque", "sustained_effort"])
def test_limits_over_time_are_noted(tmp_path, key):
    """4.06 N at 20.3 mm, where 2.468 N press."""
    _, notes = noted(tmp_path, RESISTS, 6, **{key: 5})
    assert f"limits.{key} does not count, 'l' needs 6.53 N of its 5 N over the time, 2.468 N for contacts" in notes[0]
    _, notes = noted(tmp_path, RESISTS, 6, **{key: 6.6})
    assert not any("does not count" in note for note in notes)


def test_goals_of_torques_and_efforts_are_noted(tmp_path):
    assert any(
        "the goal 'least actuator holding' counts" in note
        for note in noted(tmp_path, RESISTS, 6, minimise="holding")[1]
    )
    assert not any("the goal" in note for note in noted(tmp_path, RESISTS, 6)[1])
    assert not noted(tmp_path, ("", ""), 6, minimise="holding")[1]


def test_a_hand_toml_does_not_hide_them_whatever_the_order_of_its_joints(tmp_path):
    _, notes = noted(tmp_path, RESISTS, 6, listed=True, joint_torque="hand")
    assert (
        "'l' needs 6.53 N at t = 0 s, 2.468 N of it for contacts: more than its 6 N, which leave contacts -10.06"
        in notes[0]
    )
    assert "motors hold springs of the model file in this posture: 'l' with 4 N, up to 67% of" in notes[1]
