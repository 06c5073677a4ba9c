"""Mistakes that no single value shows: places, methods of one's own, arguments that contradict each other."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from held_ball import at, ball, grasp, hand, hard, task

import synergrip as sg

any_call: Any = sg
"""Every public name, without its types: these calls are wrong on purpose."""


def made(**changes: Any) -> sg.Grasp:
    return any_call.make_grasp(
        **{"hand": hand, "object": ball, "posture": "ball", "synergies": "motors", "contacts": at, **changes}
    )


PAIR = sg.GraspStack.of([grasp] * 2)
MISTAKES: dict[str, tuple[Callable[[], Any], str]] = {
    "places beyond a stack": (lambda: PAIR.taken([0, 2]), "places"),
    "places by name": (lambda: PAIR.taken("a"), "places"),
    "places between": (lambda: PAIR.taken([0.5]), "places"),
    "yes or no for others": (lambda: PAIR.taken([True, False, True]), "places"),
    "a slice by names": (lambda: PAIR["a":"b"], "places"),  # type: ignore[misc]
    "places beyond responses": (lambda: sg.respond_many([grasp]).taken([1]), "indices"),
    "a stack of numbers": (
        lambda: any_call.GraspStack(matrices=1, points=2, w_0=3, like=4),
        "GraspStack.matrices",
    ),
    "a stack of other points": (
        lambda: sg.GraspStack(PAIR.matrices, np.zeros((1, 3, 3)), np.zeros((2, 6)), grasp),
        "GraspStack.points",
    ),
    "a rotation of the object": (lambda: any_call.Object(mass=0.2, rotation=np.eye(3)), "Object.rotation"),
    "friction of a contact": (lambda: any_call.ContactAt("a", hard, stiffness=1, friction=1), "ContactAt.friction"),
    "stiffness of a kind": (lambda: any_call.HardFinger(friction=1, stiffness=1), "HardFinger.stiffness"),
    "a stack of huge numbers": (lambda: sg.GraspStack.varied(grasp, G=np.full((2, 6, 9), 1e250)), "G"),
    "a response of another grasp": (
        lambda: sg.execute(
            grasp,
            [0.0],
            np.zeros((1, 4)),
            sg.Loads.of(np.zeros((1, 6))),
            response=sg.respond(grasp.replace(C_s=2 * grasp.C_s)),
        ),
        "response",
    ),
    "a goal that asks for nothing": (
        lambda: sg.plan(grasp, task.replace(goals=[sg.CentredJoints(lower=-np.inf, upper=np.inf)])),
        "CentredJoints.lower",
    ),
    "a limit whose class leaves out what it inherits": (
        lambda: sg.Task(limits=[type("Half", (sg.JointTorque,), {"__init__": lambda _: None})()]),
        "Task.limits[0]",
    ),
    "a goal whose class leaves out what it inherits": (
        lambda: sg.Task(goals=[type("Half", (sg.WeightedSum,), {"__init__": lambda _: None})()]),
        "Task.goals[0]",
    ),
    "a load whose class leaves out what it inherits": (
        lambda: sg.Task(loads=[type("Half", (sg.Gravity,), {"__init__": lambda _: None})()]),
        "Task.loads[0]",
    ),
    "a kind whose class leaves out what it inherits": (
        lambda: sg.ContactAt("a", type("Half", (sg.HardFinger,), {"__init__": lambda _: None})(), stiffness=1.0),
        "ContactAt.kind",
    ),
    "a lower end of infinity": (lambda: sg.JointRange(lower=np.inf, upper=np.inf), "JointRange.lower"),
    "an upper end of less": (lambda: sg.CentredJoints(upper=[0.0, -np.inf]), "CentredJoints.upper"),
    "a reserve given up thrice": (lambda: sg.FrictionReserve(factor=2.0, given_up=3.0), "FrictionReserve.given_up"),
    "a reserve given up by text": (
        lambda: any_call.FrictionReserve(factor=2.0, given_up="all"),
        "FrictionReserve.given_up",
    ),
    "an axis of an error twice": (lambda: sg.ObjectError(0.1, axes=("x", "x")), "ObjectError.axes"),
    "a key by number": (lambda: any_call.ContactAt("a", hard, stiffness=1.0, key=3), "ContactAt.key"),
    "a place of a normal by number": (
        lambda: any_call.ContactAt("a", hard, stiffness=1.0, normal_at=3),
        "ContactAt.normal_at",
    ),
    "a stiffness without a name": (lambda: any_call.ContactAt("a", hard, 8e3), "ContactAt"),
    "a value too many": (lambda: any_call.load_problem("tripod", "a=1", "b=2"), "it takes"),
    "a pad of the hand as a place": (
        lambda: any_call.ContactAt(hand.pads["finger1/tip"], hard, stiffness=1),
        "ContactAt.at",
    ),
    "an angle as rotation": (lambda: any_call.Turned(sg.Sphere(radius=0.1), 90), "Turned.rotation"),
    "waypoints in degrees": (lambda: sg.Waypoints(times=[1], rotations=[[0, 0, 90]]), "Waypoints.rotations"),
    "a motion in degrees": (lambda: sg.MotionTable([0, 1], [[0] * 6, [0, 0, 0, 0, 45, 0]]), "MotionTable.values"),
    "a table before it begins": (lambda: sg.WrenchTable([0, 1], np.eye(6)[:2]).at([-1, 1]), "WrenchTable.at.times"),
    "a table after its end": (lambda: sg.MotionTable([0, 1], np.zeros((2, 6))).at([0, 2]), "MotionTable.at.times"),
    "instants at once": (lambda: any_call.Hold().at(0.0), "Hold.at.times"),
    "a folder by number": (lambda: made(relative_to=3), "relative_to"),
    "friction by contact": (lambda: any_call.Grasp.replace(grasp, friction={"finger1/tip": 0.3}), "friction"),
}
SAID = {
    "a rotation of the object": "no such argument; turn the shape: shape=Turned(",
    "friction of a contact": "no such argument; it is the kind's: kind=HardFinger(friction=...)",
    "stiffness of a kind": "no such argument; it is the contact's: ContactAt(..., stiffness=...)",
    "a stiffness without a name": "write for example stiffness=8000.0",
    "a limit whose class leaves out what it inherits": "a Half without limit; call super().__init__(...)",
    "a value too many": "it takes 2 values, problem, overrides, got 3",
    "a pad of the hand as a place": "expected the name of a pad or a LinkPlace, got a Pad",
    "an angle as rotation": "Rotation.from_euler",
    "waypoints in degrees": "in radians: np.radians(90) = 1.57",
    "instants at once": "expected shape (T,)",
    "friction by contact": "contact={",
}


@pytest.mark.parametrize("name", SAID)
def test_what_is_told_of_a_mistake_says_what_to_write(name: str) -> None:
    with pytest.raises(sg.InputError) as refused:
        MISTAKES[name][0]()
    assert SAID[name] in str(refused.value)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(("mistake", "named"), MISTAKES.values(), ids=MISTAKES)
def test_a_mistake_is_refused_by_the_name_of_its_argument(mistake: Callable[[], Any], named: str) -> None:
    with pytest.raises(sg.InputError) as refused:
        mistake()
    lines = [line for line in str(refused.value).splitlines() if line.startswith((f"{named}: ", f"{named} "))]
    assert lines, refused.value


@pytest.mark.parametrize("stack", [PAIR, sg.GraspStack.varied(grasp, w_0=np.eye(6)[:2])], ids=["given", "varied"])
def test_grasps_of_a_stack_are_taken_by_places_or_by_yes_and_no(stack: sg.GraspStack) -> None:
    for places, those in (([True, False], [0]), (np.array([False, False]), []), ([1, -2, 0], [1, 0, 0]), ([], [])):
        taken = stack.taken(places)
        assert taken.w_0.tolist() == stack.w_0[np.array(those, dtype=int)].tolist()
        assert [each.w_0.tolist() for each in taken] == [stack[place].w_0.tolist() for place in those]


def test_a_value_beside_an_array_is_compared_as_one_thing() -> None:
    contact = grasp.contacts[0]
    box = sg.Box(size=(0.1, 0.1, 0.1))
    turned = sg.Turned(box, np.eye(3))
    values = [hard, contact, at[0], sg.LinkPlace("a"), box, turned, hand.joints[0], grasp, task, sg.SlipMargin(0.5)]
    for value in values:
        for other in (np.zeros(3), np.zeros((2, 6))):
            assert [value == other, other == value, value != other, other != value] == [False, False, True, True]
