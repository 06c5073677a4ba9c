"""Every argument of every public constructor and function, given what it never is, is refused by its name."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import fields
from typing import Any

import numpy as np
import pytest
from held_ball import at, ball, grasp, hand, hard, task

import synergrip as sg
from synergrip.conic.goals.registry import GOALS
from synergrip.conic.limits.registry import LIMITS
from synergrip.grasps.contacts.kinds import KINDS
from synergrip.grasps.shapes.shapes import SHAPES


class Odd:
    """Nothing that anybody expects."""


NEVER: dict[str, Callable[[], Any]] = {
    "nan": lambda: math.nan,
    "an object": Odd,
    "a class": lambda: Odd,
    "a function": lambda: len,
    "a module": lambda: math,
    "a complex number": lambda: 1j,
    "a complex number of NumPy": lambda: np.complex128(1.0),
    "a number beyond all floats": lambda: 10**400,
    "a generator": lambda: (each for each in (1.0, 2.0)),
    "bytes": lambda: b"abc",
    "a set": lambda: {1, 2},
    "a date": lambda: np.datetime64("2020"),
    "a masked entry": lambda: np.ma.masked,
    "an array of nan": lambda: np.full((2, 2), math.nan),
    "an array of objects": lambda: np.array([Odd(), Odd()], dtype=object),
    "an array of texts": lambda: np.array(["a", "b"]),
    "an array of booleans": lambda: np.array([True, False, True]),
    "an array with masked entries": lambda: np.ma.array([1.0, 2.0, 3.0], mask=[0, 1, 0]),
    "a complex array": lambda: np.ones(3) * 1j,
    "an array of four axes": lambda: np.zeros((2, 2, 2, 2)),
    "a ragged list": lambda: [[1], [1, 2]],
    "a list with a hole": lambda: [1, None, 2],
    "a list of nothing but lists": lambda: [[[]]],
}
two = [sg.Contact(name=name, kind=hard, point=(x, 0, 0), frame=np.eye(3)) for name, x in (("a", -0.02), ("b", 0.02))]
response = sg.respond(grasp)
responses = sg.respond_many([grasp])
still, unheld = np.zeros((2, 6)), sg.load_problem("pinch-hard")
RIGHT: dict[str, dict[str, Any]] = {
    **{key.kind.__name__: {"limit": 1.0} for key in LIMITS if fields(key.kind)[0].name == "limit"},
    "load_hand": {"name_or_path": "barrett"},
    "Object": {"mass": 0.2, "shape": sg.Sphere(radius=0.05), "position": (0, 0, 0), "title": "ball"},
    "Turned": {"shape": sg.Box(size=(0.1, 0.1, 0.1)), "rotation": np.eye(3)},
    **{shape.__name__: {size.name: 0.1 if size.count == 1 else (0.1,) * size.count for size in shape.sizes}
       for shape in SHAPES.values()},
    **{kind.__name__: {each.name: 0.01 if each.length else 0.5 for each in kind.parameters}
       for kind in KINDS.values() if kind.parameters},
    "Contact": {"name": "a", "kind": hard, "point": (0, 0, 0), "frame": np.eye(3)},
    "ContactAt": {"at": "a", "kind": hard, "stiffness": 1.0, "tangential_stiffness": 1.0, "tangent": (1, 0, 0),
                  "normals": "pad", "name": "a"},
    "LinkPlace": {"link": "a", "point": (0, 0, 0), "normal": (0, 0, 1), "radius": 0.01},
    "Grasp": {"title": "", "contacts": two, "G": np.eye(6), "J": np.eye(6), "S": np.ones((6, 1)), "C_s": 1e-4,
              "C_q": 0.0, "C_z": 0.0, "lambda_0": np.zeros(6), "w_0": np.zeros(6), "joints": tuple("abcdef"),
              "synergies": ("s",), "held": grasp.held},
    "make_grasp": {"hand": hand, "object": ball, "posture": "ball", "contacts": at, "synergies": "motors",
                   "joint_compliance": 1e-3, "synergy_compliance": 0.0, "title": "", "close": None},
    "grasp_from_matrices": {"G": np.hstack([np.eye(6)[:, :3]] * 2), "J": np.eye(6), "S": np.ones((6, 1)),
                            "contacts": [("a", hard), ("b", hard)], "C_s": 1e-4, "C_q": 0.0, "C_z": 0.0,
                            "joints": list("abcdef"), "synergies": ["s"], "title": ""},
    "GivenContact": {"name": "a", "kind": hard, "point": (0, 0, 0), "normal": (1, 0, 0)},
    "analyse": {"grasp": grasp, "load": still},
    "grasp_properties": {"grasp": grasp},
    "analyse_many": {"grasps": [grasp]},
    "respond": {"grasp": grasp, "load": still},
    "subspaces": {"response": response},
    "coordinates": {"response": response, "spaces": sg.subspaces(response)},
    "respond_many": {"grasps": [grasp]},
    "subspaces_many": {"responses": responses},
    "coordinates_many": {"group": sg.subspaces_many(responses)[0]},
    "execute": {"grasp": grasp, "times": [0.0, 1.0], "references": np.zeros((2, 4)), "loads": sg.Loads.of(still),
                "contact_model": "rolling", "response": response, "guess": None},
    "Loads": {"wrench": still, "points": np.zeros((1, 3)), "at_points": np.zeros((2, 1, 3))},
    "Usage": {"title": "t", "unit": "N", "items": ("a",), "value": [[0.0]], "lower": [0.0], "upper": [1.0],
              "scale": [1.0], "times": [0.0]},
    "SlipMargin": {"margin": 0.5},
    "FrictionReserve": {"factor": 2.0},
    "NormalForce": {"lower": 0.0, "upper": 5.0},
    "JointRange": {"start": 0.0, "lower": -1.0, "upper": 1.0},
    "ObjectError": {"limit": 0.1, "axes": ("x",), "part": "whole", "key": "k", "title": "t"},
    "Objective": {"squares": (), "epigraph": 1.0},
    "LeastHolding": {"of": "torque"},
    "SteadyForces": {"exact": False, "stiffest": 1e6},
    "LeastMotion": {"of": "references", "exact": False, "stiffest": 1e6},
    "CentredJoints": {"start": 0.0, "lower": -1.0, "upper": 1.0},
    "WeightedSum": {"goals": ((sg.LeastEffort(), 1.0),)},
    "Move": {"axis": "z", "lift": 0.01, "roll": 0.1, "profile": "cubic"},
    "ModeMove": {"mode": 1, "amplitude": 0.1, "profile": "cubic"},
    "Waypoints": {"times": [1.0], "positions": [[0, 0, 0.1]]},
    "MotionTable": {"times": [0, 1], "values": still},
    "ModesTable": {"times": [0, 1], "values": np.zeros((2, 1))},
    "Gravity": {"acceleration": (0, 0, -9.81)},
    "Wrench": {"values": np.zeros(6)},
    "WrenchTable": {"times": [0, 1], "values": still},
    "Push": {"force": 1.0, "direction": "x", "point": (0, 0, 0), "start": 0.1, "end": 0.5, "profile": "trapezoid",
             "ramp": 0.1},
    "Palm": {"axis": "x", "turn": 1.0, "shift": (0, 0, 0.1), "profile": "cubic", "inertia": True},
    "PalmPath": {"times": [0, 1], "poses": still},
    "Task": {"duration": 1.0, "knots": 3, "target": sg.Hold(), "loads": [], "limits": [], "goals": [sg.LeastEffort()],
             "tracking": "rigid", "tolerance": 0.0, "axes": ("x",), "drift": 0.1, "between": "report",
             "load_factor": 1.0, "motion_factor": 1.0, "time_factor": 1.0, "control": None,
             "allow": None},
    "Allowances": {"friction": (0.4, 0.8), "friction_share": 0.1, "mass": (0.1, 0.2), "load": [np.zeros(6)],
                   "load_box": np.ones(6), "contact_gap": 1e-4, "scenarios": None},
    "Scenarios": {"position": 1e-3, "normal": 0.05, "compliance": 0.1, "share": 0.05, "confidence": 0.99, "seed": 1},
    "Control": {"forces": 1, "motions": ("z",), "reconfiguration": 0},
    "load_problem": {"problem": "tripod", "overrides": []},
    "grasps_in_postures": {"grasp": grasp, "q": [grasp.held.q], "positions": None, "normals": None},
    "plan": {"grasp": grasp, "task": task},
    "plan_many": {"grasp": [grasp], "task": sg.Task(knots=1, linearise="once"), "wrenches": [np.zeros(6)],
                  "friction_factors": [1.0], "masses": None, "kernel": None, "threads": 1, "progress": None},
    "margins_many": {"grasp": [grasp], "task": sg.Task(knots=1, linearise="once"), "of": "load_factor",
                     "wrenches": [np.zeros(6)], "friction_factors": [1.0], "masses": None, "kernel": None,
                     "threads": 1, "progress": None},
    "place_object": {"hand": hand, "object": ball, "posture": "open", "contacts": at, "close": "close", "task": task,
                     "synergies": "motors", "joint_compliance": 1e-3, "synergy_compliance": 0.0, "title": ""},
    "wrench_space_quality": {"grasp": grasp, "edges": 8},
    "exact_proof": {"no": sg.plan(unheld.grasp, unheld.task)},
    "synergies_needed": {"grasp": grasp, "task": task, "by": "effort", "most": 1, "up_to": 1, "along": False},
}  # fmt: skip
MADE_OF_OTHERS = {"within", "norm_within", "squares_of", "below_scalar"}
"""Of quantities that only a formulation has: their arguments are tried in tests/planning/test_own_mistakes.py."""
OTHERS = {
    "Hand", "Shape", "ContactKind", "Frictionless", "read_matrices", "Analysis", "GraspStack", "Analyses", "Execution",
    "Limit", *MADE_OF_OTHERS, "Goal",
    "Program", "Certificate", "Hold", "TimedTask", "Problem", "Plan", "ManyPlans", "ManyMargins", "PlacedObject",
    "Infeasible", "Unknown",
    "ExactProof", "NoExactProof",
    "SynergripError", "InputError", "VerdictError", "Refusal", "SelfCheckError", "OutputError",
    "__version__",
    "simulate", "export", "figure", "Simulation", "Explanation", "Repair", "When",
    "missing_synergies", "MissingSynergies", "SynergiesNeeded", "margins", "Margins", "Measure", "DirectNumber",
    "disturbances", "Disturbances", "WithstoodAlong", "Withstood", "WrenchSpaceQuality",
    "sensitivities", "Sensitivities", "Sensitivity", "fastest_timing", "FastestTiming", "InCase",
    "GraspProperties",
    *(type(goal).__name__ for goal in GOALS.values() if type(goal).__name__ not in RIGHT),
}  # fmt: skip
"""Bases, answers, values that only other functions make, goals without numbers, and what is tried above."""
PLACES = [(name, argument) for name, arguments in RIGHT.items() for argument in arguments]


def test_every_public_name_is_tried_or_known_not_to_be() -> None:
    assert set(RIGHT) | OTHERS == set(sg.__all__)
    for name, arguments in RIGHT.items():
        getattr(sg, name)(**arguments)  # what is right is accepted, or what is wrong would prove nothing


@pytest.mark.parametrize(("name", "argument"), PLACES, ids=[".".join(place) for place in PLACES])
def test_what_an_argument_never_is_is_refused_by_its_name(name: str, argument: str) -> None:
    make = getattr(sg, name)
    for what, value in NEVER.items():
        wrong = {**RIGHT[name], argument: value()}
        keys = [issue.key for issue in refused(lambda each=wrong: make(**each), f"{what} as {argument}")]
        assert any(argument in key for key in keys), (what, keys)


def refused(make: Callable[[], Any], what: str) -> tuple[Any, ...]:
    try:
        made = make()
    except sg.InputError as error:
        return error.issues
    pytest.fail(f"accepted {what}: {made!r}")


@pytest.mark.parametrize("name", sorted({*RIGHT, *MADE_OF_OTHERS, "Frictionless", "Hold"}))
def test_a_misspelt_argument_and_too_many_of_them_are_refused_by_name(name: str) -> None:
    with pytest.raises(sg.InputError, match="zzz: no such argument"):
        getattr(sg, name)(**RIGHT.get(name, {}), zzz=1)
    with pytest.raises(sg.InputError, match=r"without a name|takes"):
        getattr(sg, name)(*[1] * 30)


MADE_BY = {
    "Analysis": "analyse(", "Analyses": "analyse_many(", "Execution": "execute(", "Problem": "load_problem(",
    "Plan": "plan(", "ManyPlans": "plan_many(", "ManyMargins": "margins_many(",
    "Infeasible": "plan(", "Unknown": "plan(", "Simulation": "simulate(",
    "Explanation": "explain(", "Repair": "explain(", "When": "explain(",
    "MissingSynergies": "missing_synergies(", "SynergiesNeeded": "synergies_needed(",
    "GraspProperties": "grasp_properties(", "Margins": "margins(", "Measure": "margins(", "DirectNumber": "margins(",
    "Disturbances": "disturbances(", "WithstoodAlong": "disturbances(", "Withstood": "disturbances(",
    "WrenchSpaceQuality": "wrench_space_quality(",
    "Sensitivities": "sensitivities(", "Sensitivity": "sensitivities(",
    "FastestTiming": "fastest_timing(",
}  # fmt: skip


@pytest.mark.parametrize("name", MADE_BY)
def test_what_is_not_made_by_hand_says_what_makes_it(name: str) -> None:
    for arguments in ((), (1.0,)):
        with pytest.raises(sg.InputError, match="is not made by hand") as error:
            getattr(sg, name)(*arguments)
        assert error.value.issues[0].key == name
        assert MADE_BY[name] in str(error.value)


@pytest.mark.parametrize(
    ("name", "example"),
    [("Shape", "Sphere"), ("ContactKind", "HardFinger"), ("Limit", "SlipMargin"), ("Goal", "LeastEffort")],
)
def test_what_kinds_share_names_one_and_what_one_of_ones_own_needs(name: str, example: str) -> None:
    base = getattr(sg, name)
    with pytest.raises(sg.InputError, match=rf"^{name}: .* such as {example}\(") as error:
        base()
    left_out = sorted(base.__abstractmethods__)
    assert str(error.value).endswith(", ".join(left_out))
    own: Any = type("Own", (base,), {})
    with pytest.raises(sg.InputError, match=f"Own: has no method .*'{left_out[-1]}'; write it"):
        own()


@pytest.mark.parametrize("ranged", [sg.JointRange, sg.CentredJoints])
@pytest.mark.parametrize(("values", "named"), [((1.0,), {}), ((-1.0, 1.0), {}), ((0.0,), {"upper": 1.0})])
def test_ends_of_a_joint_range_need_their_names(
    ranged: Any, values: tuple[float, ...], named: dict[str, float]
) -> None:
    with pytest.raises(sg.InputError, match=rf"^{ranged.__name__}: .*lower=\.\.\., upper="):
        ranged(*values, **named)
    assert ranged(0.0, -1.0, 1.0) == ranged(0.0, lower=-1.0, upper=1.0) == ranged(start=0.0, lower=-1.0, upper=1.0)


@pytest.mark.parametrize(("times", "told"), [([1.0, 0.0], "times must increase: 0 s comes after 1 s"),
                                             ([1.0, 1.0], "1 s stands twice with two references")])  # fmt: skip
def test_times_of_an_execution_increase(times: list[float], told: str) -> None:
    references = np.linspace(0, 1e-3, 2)[:, None] * np.ones(4)
    with pytest.raises(sg.InputError, match=f"^times: {told}"):
        sg.execute(**{**RIGHT["execute"], "times": times, "references": references})


def test_an_instant_at_which_a_load_jumps_stands_twice_in_an_execution() -> None:
    loads = sg.Loads.of(np.outer([0.0, 0.0, 0.1], np.eye(6)[2]))
    executed = sg.execute(**{**RIGHT["execute"], "times": [0, 1, 1], "references": np.zeros((3, 4)), "loads": loads})
    assert executed.whole
    assert executed.du[2, 2] > executed.du[1, 2] == executed.du[0, 2]


@pytest.mark.parametrize(
    ("ask", "named"),
    [
        (lambda executed: executed.interpolated("x"), "times"),
        (lambda executed: executed.interpolated([math.nan]), "times"),
        (lambda executed: executed.interpolated([[0.0]]), "times"),
        (lambda executed: executed.left(np.zeros((2, 5))), "wanted"),
        (lambda executed: executed.left(None), "wanted"),
    ],
)
def test_what_an_execution_is_asked_is_judged(ask: Callable[[Any], Any], named: str) -> None:
    executed = sg.execute(**RIGHT["execute"])
    assert len(executed.interpolated([0.0, 0.5])) == len(executed.interpolated(np.array([0.5]))) + 1
    assert not executed.left(executed.du).round(12).any()
    assert [issue.key.split(".")[-1] for issue in refused(lambda: ask(executed), named)] == [named]
