"""What a hint says to write is what the user meant, and is accepted when it is written."""

from __future__ import annotations

import re

import numpy as np
import pytest

from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.documents.quantities import EXAMPLES, UNITS, quantity
from synergrip.errors import InputError, Issue
from synergrip.problems.problem import Problem, load_problem

LIFT, HOLD, PEG = "barrett-ball-lift", "barrett-ball-hold", "gripper-peg"


def issues(name: str, *overrides: str) -> list[Issue]:
    with pytest.raises(InputError) as caught:
        load_problem(name, overrides)
    return list(caught.value.issues)


def refused(name: str, *overrides: str) -> Issue:
    (issue,) = issues(name, *overrides)
    return issue


def hint(call: object, kind: str) -> list[str]:
    with pytest.raises(InputError) as caught:
        quantity(call, kind)
    return re.findall(r'"([^"]*)"', caught.value.issues[0].message)


@pytest.mark.parametrize("kind", UNITS)
@pytest.mark.parametrize("value", [0, 0.2, -0.2, 3, 8, 45, 90, 200, 1e-6, 1e9, "0.2", "+45", "1e3", ".5", " 7 "])
def test_a_number_keeps_its_value_when_it_gets_a_unit(kind: str, value: float | str) -> None:
    """The SI unit is always among what is suggested; another one comes with it when the size in SI is no usual one."""
    texts = hint(value, kind)
    assert 1 <= len(texts) <= 2
    assert all(float(text.split(" ")[0]) == float(value) for text in texts)
    assert float(value) in [quantity(text, kind) for text in texts]


def test_grams_are_suggested_for_200_and_kilograms_for_a_fifth() -> None:
    assert hint(0.2, "mass") == ["0.2 kg"]
    assert hint(200, "mass") == ["200 g", "200 kg"]
    assert hint(90, "angle") == ["90 deg", "90 rad"]
    assert hint(1.5, "angle") == ["1.5 rad"]
    assert hint(45, "length") == ["45 mm", "45 m"]
    assert hint(0.045, "length") == ["0.045 m"]


@pytest.mark.parametrize("value", [True, None, [], {}, "ten mm", "mm"])
def test_what_is_no_number_gets_an_example(value: object) -> None:
    assert hint(value, "length")[:1] == ["10 mm"]


def told(name: str, override: str) -> tuple[Issue, ...]:
    """What is wrong with a problem, if anything: another size of the object, say, may not do, though its unit does."""
    try:
        load_problem(name, [override])
    except InputError as error:
        return error.issues
    return ()


WITH_UNITS = [
    (HOLD, "object.mass"), (HOLD, "object.shape.sphere.radius"), (HOLD, "object.position[0]"),
    (HOLD, "hand.posture.spread"), (HOLD, "hand.compliance.joint"), (HOLD, "contacts.stiffness"),
    (HOLD, "contacts.tangential_stiffness"), (HOLD, "task.duration"), (HOLD, "limits.margin"),
    (HOLD, "limits.margin_angle"), (HOLD, "limits.normal_force"), (HOLD, "limits.elastic_motion"),
    (HOLD, "limits.drift"), (LIFT, "task.move[0].lift"), (LIFT, "task.move[1].roll"), (LIFT, "task.tolerance"),
    (LIFT, "task.drift"), (PEG, "contacts.spin_friction"), (PEG, "contacts.spin_stiffness"), (PEG, "task.tolerance"),
    (PEG, "task.push[0].force"), (PEG, "task.push[0].start"), (PEG, "task.waypoint[0].time"),
    (PEG, "task.waypoint[0].position[2]"), (PEG, "object.shape.box.size[1]"), ("barrett-ball-roll", "task.palm.turn"),
]  # fmt: skip
BY_OVERRIDE = {
    "object.position[0]": "object.position=[{}, '0 mm', '150 mm']", "hand.posture.spread": "hand.posture={{spread={}}}",
    "hand.compliance.joint": "hand.compliance.joint={}", "task.palm.turn": "task.palm={{axis='x', turn={}}}",
}  # fmt: skip


@pytest.mark.parametrize(("name", "key"), WITH_UNITS)
@pytest.mark.parametrize("value", ["0.2", "35"])
def test_the_hint_at_every_key_with_a_unit_is_accepted_there(name: str, key: str, value: str) -> None:
    text = BY_OVERRIDE.get(key, f"{key}={{}}")
    (issue,) = [issue for issue in issues(name, text.format(value)) if issue.key == key]
    meant = re.findall(r'"([^"]*)"', issue.message.split(" (units")[0])
    assert meant
    for suggestion in meant:
        assert suggestion.split(" ")[0] == value
        assert not any("unit" in issue.message for issue in told(name, text.format(f'"{suggestion}"')))


@pytest.mark.parametrize(
    ("override", "advice"),
    [
        ("contacts.friction=0.6 N", "write 0.6"),
        ("contacts.friction=200 g", "write 0.2"),
        ("limits.synergy_rate=30 deg", "write 0.523598775598"),
        ("contacts.friction=0.6", ""),
        ("contacts.friction='0.6'", "write 0.6"),
        ("limits.safety_factor='3/2'", "write 1.5"),
    ],
)
def test_a_unit_where_none_stands_is_worked_out(override: str, advice: str) -> None:
    if not advice:
        load_problem(HOLD, [override])
        return
    issue = refused(HOLD, override)
    assert issue.message.endswith(advice)
    load_problem(HOLD, [f"{override.split('=')[0]}={issue.message.split('write ')[1]}"])


def test_a_unit_that_nobody_knows_is_not_guessed() -> None:
    assert "write" not in refused(HOLD, "contacts.friction=60 %").message


# --set

ADVISED = [
    (LIFT, 'task.move.0.lift="2 mm"', "task.move[0].lift"),
    (LIFT, 'task.move.1.roll="2 deg"', "task.move[1].roll"),
    (LIFT, 'task.move.lift="2 mm"', "task.move[0].lift"),
    (LIFT, 'task.move.roll="2 deg"', "task.move[1].roll"),
    (LIFT, 'task.move.profile="cubic"', "task.move[0].profile"),
    (PEG, 'task.waypoint.1.position.2="-1 mm"', "task.waypoint[1].position[2]"),
    (PEG, 'task.waypoint.time="0.4 s"', "task.waypoint[0].time"),
    (PEG, 'task.push.0.force="2 N"', "task.push[0].force"),
    (PEG, 'object.shape.box.size.0="40 mm"', "object.shape.box.size[0]"),
    (HOLD, "task.gravity.2=-9.8", "task.gravity[2]"),
    (HOLD, "task.gravity.z=0", "task.gravity[0]"),
]


@pytest.mark.parametrize(("name", "override", "key"), ADVISED)
def test_a_key_that_is_advised_is_accepted(name: str, override: str, key: str) -> None:
    issue = refused(name, override)
    assert issue.message.endswith(f"write {key}")
    assert issue.file == f"--set {override}"
    load_problem(name, [f"{key}={override.split('=', 1)[1]}"])


@pytest.mark.parametrize(
    ("override", "fragment"),
    [
        ("task.move.7.lift=1 mm", "'task.move' has 2 entries, counted from 0; there is no [7]"),
        ("task.move[7].lift=1 mm", "'task.move' has 2 entries, counted from 0; there is no [7]"),
        ("task.waypoint[0].time=1 s", "there is no list 'task.waypoint'; give the whole list, task.waypoint=[...]"),
        ("task.waypoint.0.time=1 s", "expected a list, got a table; its entries are written [[task.waypoint]]"),
        ("title[0]=x", "'title' is not a list"),
        ("title.x=x", "'title' is a value and not a table"),
    ],
)
def test_lists_that_are_too_short_or_not_there_are_said_to_be(override: str, fragment: str) -> None:
    found = refused(LIFT, override)
    assert fragment in found.message
    assert found.file == f"--set {override}"


@pytest.mark.parametrize(
    ("override", "key", "fragment"),
    [
        ("bogus.x=3", "bogus", "unknown key 'bogus'"),
        ("limitz.margin=1 N", "limitz", "did you mean 'limits'?"),
        ("bogus=3", "bogus", "unknown key 'bogus'"),
        ("object.shape.cube.size=1 mm", "object.shape.cube", "unknown key 'cube'"),
        ("task.palm.turn=3 deg", "task.palm.axis", "missing key 'axis'"),
        ("hand.complience.joint=1 rad/(N m)", "hand.complience", "did you mean 'compliance'?"),
        ("limits={margni='1 N'}", "limits.margni", "did you mean 'margin'?"),
        ("task.push=[{force='1 N'}]", "task.push[0].direction", "missing key 'direction'"),
    ],
)
def test_what_an_override_brings_in_is_told_at_set(override: str, key: str, fragment: str) -> None:
    found = {issue.key: issue for issue in issues(LIFT, override)}
    assert fragment in found[key].message
    assert found[key].file == f"--set {override}"
    assert found[key].line == 0


def test_what_the_file_says_wrong_is_told_in_the_file_although_something_is_set() -> None:
    """A missing key of a table of the file, which the override did not make."""
    found = {issue.key: issue for issue in issues(LIFT, "object.mass=1 kg", "contacts.model=soft")}
    assert all(issue.file.endswith(f"{LIFT}.toml") for issue in found.values())
    assert set(found) == {"contacts.spin_friction", "contacts.spin_stiffness"}


# two goals


@pytest.mark.parametrize(
    ("goal", "key", "drops", "order"),
    [
        ("{maximise='margin', minimise='effort'}", "minimise", ("minimise", "maximise"), '["margin", "effort"]'),
        ("{maximise='margin', minimise='peak_force'}", "minimise", ("minimise",), '["margin", "peak_force"]'),
        ("{maximise='margin', order=['effort', 'travel']}", "order", ("order",), '["margin", "effort", "travel"]'),
        ("{minimise='travel', order=['effort']}", "order", ("order",), '["effort", "travel"]'),
        ("{minimise='peak_force', order=['effort']}", "order", ("order", "minimise"), None),
        ("{maximise='margin', minimise={effort=1, travel=1}}", "minimise", ("minimise", "maximise"), None),
    ],
)
def test_two_goals_say_which_to_drop(goal: str, key: str, drops: tuple[str, ...], order: str | None) -> None:
    issue = refused(HOLD, f"goal={goal}")
    assert issue.key == f"goal.{key}"
    for name in drops:
        assert re.search(rf"(drop|or) '{name}' to keep", issue.message)
    assert (order is None) == ("write only order" not in issue.message)
    if order is not None:
        assert f"write only order = {order}" in issue.message
        load_problem(HOLD, [f"goal={{order={order}}}"])


def test_a_goal_set_over_the_files_own_says_how_to_replace_it() -> None:
    issue = refused(HOLD, "goal.maximise=margin")
    assert "drop 'minimise' to keep maximise = \"margin\"" in issue.message
    assert "--set goal={...} replaces the whole table" in issue.message
    assert load_problem(HOLD, ['goal={maximise="margin"}']).timed.goals == (LargestMargin(),)


# gravity and wrench with units


def weight(*overrides: str) -> np.ndarray:
    problem: Problem = load_problem(HOLD, overrides)
    return problem.timed.wrench[0]


@pytest.mark.parametrize(
    "gravity",
    ["[0, 0, -9.81]", "['0 m/s^2', '0 m/s²', '-9.81 m/s^2']", "[0, 0, '-9.81 m/s^2']", "[0, 0, '-9810 mm/s^2']"],
)
def test_gravity_takes_numbers_and_units(gravity: str) -> None:
    assert weight(f"task.gravity={gravity}") == pytest.approx([0, 0, -1.962, 0, 0, 0])


def test_a_wrench_takes_numbers_and_units() -> None:
    told = "task.wrench=['1 N', 0, '-2e3 mN', 0, '5 N mm', '0.25 N m']"
    assert weight("task.gravity=[0, 0, 0]", told) == pytest.approx([1, 0, -2, 0, 0.005, 0.25])


@pytest.mark.parametrize("gravity", ["9.81 m/s^2", "9.81", "'-9.81 m/s^2'", "-9.81", "'9.81'"])
def test_one_size_of_gravity_is_told_to_have_a_direction(gravity: str) -> None:
    issue = refused(HOLD, f"task.gravity={gravity}")
    written = re.findall(r"write for example (\[.*\])", issue.message)
    assert weight(f"task.gravity={written[0]}") == pytest.approx([0, 0, -1.962, 0, 0, 0])


@pytest.mark.parametrize(
    ("override", "key", "fragment"),
    [
        ("task.gravity=[0, 0, '-9.81']", "task.gravity[2]", 'missing unit; write "-9.81 m/s^2"'),
        ("task.gravity=[0, 0, '-9.81 N']", "task.gravity[2]", "'N' is a unit of force"),
        ("task.gravity=[0, 0, 'down']", "task.gravity[2]", "expected a number, got 'down'"),
        ("task.gravity=[0, '1 g']", "task.gravity", "expected 3 numbers, got 2"),
        ("task.wrench=[0, 0, '1 N m', 0, 0, 0]", "task.wrench[2]", "'N m' is a unit of torque; expected a force"),
        ("task.wrench=[0, 0, 0, 0, 0, '1 N']", "task.wrench[5]", "'N' is a unit of force; expected a torque"),
        ("task.wrench='3 kN'", "task.wrench", 'write for example [0, 0, "3 kN", 0, 0, 0]'),
    ],
)
def test_units_of_gravity_and_wrench_are_judged(override: str, key: str, fragment: str) -> None:
    issue = refused(HOLD, override)
    assert issue.key == key
    assert fragment in issue.message


def test_every_example_is_of_a_usual_size() -> None:
    for kind, example in EXAMPLES.items():
        assert hint(quantity(example, kind), kind)[0].split(" ", 1)[1] == next(iter(UNITS[kind]))
