"""What can hardly be meant is noted where it is read, with place, key and value, and never refused."""

from __future__ import annotations

import json
import math
from pathlib import Path

import command_line
import numpy as np
import pytest

import synergrip as sg
from synergrip.batch.many_plans import OF_HAND
from synergrip.files import bundled
from synergrip.grasps.plausible import edge_distance, mass_doubt
from synergrip.hands.hand import Joint
from synergrip.hands.posture_units import posture_doubt
from synergrip.problems.problem import load_problem

WORDS = (
    "coefficient of friction",
    "far from 9.81",
    "is larger than",
    "whole one",
    "from an edge",
    "is meant in",
    "hands hold is so",
    "gives by",
    "more than any arm",
    "held for, too",
    "though off its surface",
)
"""One of each doubt."""


def doubts(notes: tuple[str, ...]) -> list[str]:
    return [note for note in notes if any(words in note for words in WORDS)]


NOTED = [
    ("contacts.friction=2.1", "contacts.friction", "coefficient of friction of 2.1 (contacts 'left/tip', 'right/tip')"),
    ("contacts.friction_factor=4", "contacts.friction_factor", "a coefficient of friction of 2.4"),
    ("task.gravity=[0, 0, -981]", "task.gravity", "gravity of 981 m/s^2 is far from 9.81 m/s^2"),
    ("task.gravity=[0, -9.81, -9.81]", "task.gravity", "gravity of 13.87 m/s^2"),
    ('task.move=[{axis="z", lift="61 mm"}]', "task.move", "motion of 61 mm is larger than the box 40 x 30 x 60 mm (60"),
    ('task.move=[{axis="z", roll="361 deg"}]', "task.move", "a turn by 361 deg is more than a whole one"),
    ('object.mass="200 kg"', "object.mass", "200 kg in the box around the box 40 x 30 x 60 mm are 2780000 kg/m^3"),
    ('object.mass="0.05 g"', "object.mass", "less than 1, as air"),
    (
        'contacts.stiffness="0.1 N/mm"',
        "contacts.stiffness",
        "contact 'left/tip' gives by 19.62 mm under the object's weight",
    ),
    ('task.palm={shift=["300 m", "0 m", "0 m"], inertia=true}', "task.palm", "the palm moves by 300 m"),
    ('allow.mass=["250 g", "300 g"]', "allow.mass", "the object's own mass, 200 g, is not between 250 g and 300 g"),
    ('allow.mass=["150 kg", "250 kg"]', "allow.mass", "150 kg in the box around the box 40 x 30 x 60 mm are 208"),
    ("allow.friction={'left/tip' = [0.7, 0.8]}", "allow.friction", "that of contact 'left/tip', 0.6, is not between"),
    (
        "object.position=['0 mm', '4 mm', '90.8 mm']",
        "contacts.at[0]",
        "contact 'left/tip' is 0.9 mm or less from an edge",
    ),
]
NOT_NOTED = (
    "contacts.friction=2.0", "task.gravity=[0, 0, -9.78]", "task.gravity=[0, 6.937, -6.937]",
    'allow.mass=["0.2 kg", "300 g"]', "allow.friction=[0.6, 0.8]",
    'object.mass="1.7 kg"', 'object.mass="0.1 g"', 'contacts.stiffness="0.17 N/mm"',
    'task.move=[{axis="z", lift="59 mm"}]', "object.position=['0 mm', '4 mm', '91.5 mm']",
)  # fmt: skip


@pytest.mark.parametrize(("override", "key", "words"), NOTED, ids=[each for each, _, _ in NOTED])
def test_what_can_hardly_be_meant_is_noted_with_its_place(override: str, key: str, words: str) -> None:
    found = doubts(load_problem("gripper-box", override).notes)
    assert words in found[0]
    assert f" {key}: " in found[0]
    assert len(found) == (2 if key.startswith("contacts.at") else 1)


@pytest.mark.parametrize("override", NOT_NOTED)
def test_what_is_usual_is_not_noted(override: str) -> None:
    assert not doubts(load_problem("gripper-box", override).notes)


def test_contacts_off_the_surface_are_noted_with_their_force_until_they_are_allowed_for() -> None:
    """A finger of 1.204 N/mm in the grasp of both; `allow.contact_gap` of what is told ends the note."""
    place = "object.position=['0.2004 mm', '4 mm', '120 mm']"
    (note,) = doubts(load_problem("gripper-box", place).notes)
    assert "contacts.at[0]: taken to touch the box" in note
    assert "'left/tip' 0.181 mm inside (about 0.22 N more than planned)" in note
    assert "'right/tip' 0.22 mm outside (about 0.27 N less than planned)" in note
    allow = note.split("allow.")[1].split(" asks")[0].replace(" = {", "={")
    assert not doubts(load_problem("gripper-box", [place, f"allow.{allow}"]).notes)
    assert not doubts(load_problem("gripper-box", "object.position=['0.03 mm', '4 mm', '120 mm']").notes)


def test_the_place_is_the_line_of_the_file_also_of_one_with_matrices(tmp_path: Path) -> None:
    data = json.loads((bundled("problems") / "pinch-soft.json").read_text(encoding="utf-8"))
    data["contacts"][1]["friction"] = 50
    (tmp_path / "grasp.json").write_text(json.dumps(data, indent=1), encoding="utf-8")
    text = 'schema = 1\ngrasp = { file = "grasp.json" }\n[task]\nwrench = [0, 0, -2, 0, 0, 0]\n'
    (tmp_path / "problem.toml").write_text(text, encoding="utf-8")
    (note,) = doubts(load_problem(tmp_path / "problem.toml").notes)
    line = next(i for i, each in enumerate(json.dumps(data, indent=1).splitlines(), 1) if '"friction": 50' in each)
    assert note.startswith(f"{tmp_path / 'grasp.json'}:{line}:")
    assert "contacts[1].friction: a coefficient of friction of 50 (contact 'right')" in note


def test_a_contact_with_a_friction_of_its_own_is_told_there() -> None:
    own = 'contact=[{at="right/tip", friction=3.0}]'
    (note,) = doubts(load_problem("gripper-box", own).notes)
    assert "contact[0].friction: a coefficient of friction of 3 (contact 'right/tip')" in note


def test_plans_made_in_code_say_the_same_and_those_of_files_say_it_once(tmp_path: Path) -> None:
    problem = load_problem("pinch-soft", ["limits.margin=0.1 N"])
    grasp = problem.grasp.replace(friction=2.5)
    answer = sg.plan(grasp, problem.task.replace(linearise="once"))
    assert isinstance(answer, sg.Plan)
    assert doubts(answer.notes) == [note for note in answer.notes if note.startswith("friction: a coefficient")]
    assert len(doubts(answer.notes)) == 1
    held = load_problem("gripper-box", "task.linearise=once")
    light = sg.Task(loads=[sg.Gravity((0, 0, -1.62))], limits=[sg.NormalForce(upper=20.0)], linearise="once")
    answer = sg.plan(held.grasp, light)
    assert isinstance(answer, sg.Plan)
    assert any(note.startswith("Task.loads[0]: gravity of 1.62 m/s^2") for note in answer.notes)
    told = command_line.document(
        "plan",
        "pinch-soft",
        "--set",
        "grasp.friction_factor=5",
        "-o",
        str(tmp_path / "out"),
        "--set",
        "limits.margin=0.1 N",
    )
    assert len(doubts(told["notes"])) == 1


def test_masses_in_another_unit_are_noted_of_a_no_and_of_many_plans() -> None:
    held = load_problem("barrett-ball-still", "task.linearise=once")
    grams = held.task.replace(allow=sg.Allowances(mass=(150, 250)))
    answer = sg.plan(held.grasp, grams)
    assert isinstance(answer, sg.Infeasible)
    assert any(note.startswith("Task.allow.mass: 150 kg in the box around the ball") for note in answer.notes)
    gravity, cap = sg.Gravity((0, 0, -9.81)), sg.NormalForce(upper=20.0)
    still = sg.Task(knots=1, loads=[gravity], limits=[cap], linearise="once")
    many = sg.plan_many(held.grasp, still, masses=[0.15, 200.0])
    assert many.notes[0].startswith("masses: 200 kg ")
    assert many.notes[1:] == (OF_HAND,)
    assert sg.plan_many(held.grasp, still, masses=[0.15, 0.2]).notes == (OF_HAND,)
    bare = sg.Object(mass=0.2, position=(0, 0, 0.1))  # without a shape the mass that is stated says it
    assert "1000 times the object's own mass" in mass_doubt(bare, 200.0)
    assert mass_doubt(bare, 2.0) == mass_doubt(bare, 0.02) == ""


def joints(upper: float = math.radians(140)) -> list[Joint]:
    return [Joint(name=name, kind="hinge", lower=-upper, upper=upper) for name in ("a", "b")]


def test_a_posture_in_the_wrong_unit_is_told() -> None:
    """Radians read as degrees hardly bend the hand; degrees read as radians turn joints without a range on and on."""
    radians, degrees = np.array([0.5, 1.2]), np.array([30.0, 70.0])
    assert posture_doubt(joints(), radians) == posture_doubt(joints(), np.radians(degrees)) == ""
    assert posture_doubt(joints(), np.zeros(2)) == ""
    assert "within 1.2 deg of 0 ('b' the farthest)" in posture_doubt(joints(), np.radians(radians))
    assert posture_doubt(joints(math.radians(20)), np.radians(radians)) == ""  # 1.2 rad would be outside
    assert "'b' is at 70 rad, more than a turn" in posture_doubt(joints(math.inf), degrees)


def test_a_posture_that_is_refused_says_when_another_unit_would_do() -> None:
    with pytest.raises(sg.InputError) as error:
        load_problem("gripper-box", 'hand.posture={proximal="-5 rad", distal="21.9 rad"}')
    assert "-5 deg would be inside: -5 was read in radians" in str(error.value)
    with pytest.raises(sg.InputError) as error:
        load_problem("gripper-box", 'hand.posture={proximal="-0.087 deg", distal="0.38 deg"}')
    last = error.value.issues[-1]
    assert (last.key, "if 0.38 is meant in radians" in last.message) == ("hand.posture", True)
    with pytest.raises(sg.InputError) as error:  # a joint a little outside its range is no matter of units
        load_problem("gripper-box", 'hand.posture={proximal="80 deg", distal="21.9 deg"}')
    assert "read in radians" not in str(error.value)


@pytest.mark.parametrize(("left", "told"), [(0.0, 1e-4), (2.5e-4, 3e-4), (9.5e-4, 1e-3), (1.5e-3, None)])
def test_an_edge_is_as_far_as_it_is(left: float, told: float | None) -> None:
    box, can = sg.Box(size=(0.04, 0.06, 0.1)), sg.Cylinder(radius=0.03, height=0.1)
    about_x = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])
    places: list[tuple[sg.Shape, tuple[float, float, float]]] = [
        (box, (0.02, 0.03 - left, 0.01)), (box, (-0.02, 0.0, left - 0.05)), (can, (0.03, 0.0, 0.05 - left)),
        (can, (0.0, 0.03 - left, -0.05)), (sg.Turned(box, about_x), (0.02, -0.05 + left, 0.0)),
        (box, (0.0202, 0.03 - left, 0.01)),
    ]  # fmt: skip
    for shape, point in places:
        assert edge_distance(shape, np.array(point)) == (None if told is None else pytest.approx(told)), (shape, point)
    assert edge_distance(sg.Sphere(radius=0.01), np.array([0.01, 0, 0])) is None
