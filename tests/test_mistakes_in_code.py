"""Mistakes made in code: each is an `InputError` that names the argument; none is accepted, none ends in NumPy."""

from __future__ import annotations

import copy
import math
import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from held_ball import at, ball, grasp, hand, hard, task

import synergrip as sg

nan = math.nan
PLAN = sg.plan(grasp, task)
any_call: Any = sg
"""Every public name, without its types: these calls are wrong on purpose."""


def made(**changes: Any) -> sg.Grasp:
    return any_call.make_grasp(
        **{"hand": hand, "object": ball, "posture": "ball", "synergies": "motors", "contacts": at, **changes}
    )


def given(**changes: Any) -> sg.Grasp:
    G = np.hstack([np.eye(6)[:, :3], np.eye(6)[:, :3]])
    values = {"G": G, "J": np.eye(6), "S": np.ones((6, 1)), "contacts": [("a", hard), ("b", hard)], "C_s": 1e-4}
    return any_call.grasp_from_matrices(**{**values, **changes})


MISTAKES: dict[str, tuple[Callable[[], Any], str]] = {
    "hand misspelt": (lambda: any_call.load_hand("baret"), "name_or_path"),
    "hand of another type": (lambda: any_call.load_hand(3), "name_or_path"),
    "hand missing": (lambda: any_call.load_hand(), "name_or_path"),
    "mass negative": (lambda: any_call.Object(mass=-0.2), "Object.mass"),
    "mass nan": (lambda: any_call.Object(mass=nan), "Object.mass"),
    "mass a text": (lambda: any_call.Object(mass="200 g"), "Object.mass"),
    "object misspelt": (lambda: any_call.Object(mas=0.2), "Object.mas"),
    "object position": (lambda: any_call.Object(mass=0.2, position=(0, 0)), "Object.position"),
    "object shape": (lambda: any_call.Object(mass=0.2, shape="sphere"), "Object.shape"),
    "radius zero": (lambda: any_call.Sphere(radius=0), "Sphere.radius"),
    "radius missing": (lambda: any_call.Sphere(), "Sphere.radius"),
    "radius misspelt": (lambda: any_call.Sphere(radios=0.1), "Sphere.radios"),
    "box sides": (lambda: any_call.Box(size=(0.1, 0.1)), "Box.size"),
    "cylinder radius": (lambda: any_call.Cylinder(radius=nan, height=0.1), "Cylinder.radius"),
    "friction negative": (lambda: any_call.HardFinger(friction=-0.1), "HardFinger.friction"),
    "friction missing": (lambda: any_call.HardFinger(), "HardFinger.friction"),
    "friction misspelt": (lambda: any_call.HardFinger(frction=0.5), "HardFinger.frction"),
    "soft finger": (lambda: any_call.SoftFinger(friction=0.5, torsional_friction=nan), "SoftFinger.torsional_friction"),
    "contact kind": (lambda: any_call.ContactAt("finger1/tip", "hard", stiffness=8e3), "ContactAt.kind"),
    "stiffness missing": (lambda: any_call.ContactAt("finger1/tip", hard), "ContactAt.stiffness"),
    "stiffness negative": (lambda: any_call.ContactAt("finger1/tip", hard, stiffness=-1), "ContactAt.stiffness"),
    "stiffness misspelt": (lambda: any_call.ContactAt("finger1/tip", hard, stifness=1), "ContactAt.stifness"),
    "tangent shape": (
        lambda: any_call.ContactAt("finger1/tip", hard, stiffness=1, tangent=(1, 0)),
        "ContactAt.tangent",
    ),
    "posture misspelt": (lambda: made(posture="bal"), "posture"),
    "posture shape": (lambda: made(posture=np.zeros(3)), "posture"),
    "posture nan": (lambda: made(posture=np.full(8, nan)), "posture"),
    "synergies misspelt": (lambda: made(synergies="motor"), "synergies"),
    "contacts empty": (lambda: made(contacts=[]), "contacts"),
    "contacts by name": (lambda: made(contacts=["finger1/tip"]), "contacts[0]"),
    "pad misspelt": (lambda: made(contacts=[sg.ContactAt("finger1/tp", hard, stiffness=1)]), "contacts[0].at"),
    "body instead of object": (lambda: made(body=ball), "body"),
    "compliance negative": (lambda: made(joint_compliance=-1.0), "joint_compliance"),
    "G shape": (lambda: given(G=np.eye(6)[:, :5]), "G"),
    "G nan": (lambda: given(G=np.full((6, 6), nan)), "G"),
    "J shape": (lambda: given(J=np.eye(5)), "J"),
    "S a vector": (lambda: given(S=np.ones(6)), "S"),
    "C_s negative": (lambda: given(C_s=-1.0), "C_s"),
    "contacts of matrices": (lambda: given(contacts=[("a", "hard")]), "contacts[0][1]"),
    "matrix misspelt": (lambda: given(C_ss=1.0), "C_ss"),
    "w_0 shape": (lambda: given(w_0=np.zeros(3)), "w_0"),
    "duration negative": (lambda: any_call.Task(duration=-1.0), "Task.duration"),
    "duration nan": (lambda: any_call.Task(duration=nan), "Task.duration"),
    "duration misspelt": (lambda: any_call.Task(durations=1.0), "Task.durations"),
    "duration without a name": (lambda: any_call.Task(1.0), "Task"),
    "knots not whole": (lambda: any_call.Task(knots=2.5), "Task.knots"),
    "target a text": (lambda: any_call.Task(target="hold"), "Task.target"),
    "a load without a list": (lambda: any_call.Task(loads=sg.Gravity((0, 0, -9.81))), "Task.loads"),
    "loads of numbers": (lambda: any_call.Task(loads=[1.0]), "Task.loads[0]"),
    "a goal by name": (lambda: any_call.Task(goals=["effort"]), "Task.goals[0]"),
    "a goal's class": (lambda: any_call.Task(goals=[sg.LeastEffort]), "Task.goals[0]"),
    "a limit of a number": (lambda: any_call.Task(limits=[20.0]), "Task.limits[0]"),
    "a limit's class": (lambda: any_call.Task(limits=[sg.JointTorque]), "Task.limits[0]"),
    "axes misspelt": (lambda: any_call.Task(axes=("x", "w")), "Task.axes[1]"),
    "task changed by a misspelt name": (lambda: task.replace(duraton=2.0), "Task.duraton"),
    "load factor negative": (lambda: task.replace(load_factor=-1.0), "Task.load_factor"),
    "gravity shape": (lambda: any_call.Gravity((0, -9.81)), "Gravity.acceleration"),
    "gravity nan": (lambda: any_call.Gravity((0, 0, nan)), "Gravity.acceleration"),
    "gravity missing": (lambda: any_call.Gravity(), "Gravity.acceleration"),
    "wrench shape": (lambda: any_call.Wrench((0, 0, 1)), "Wrench.values"),
    "wrench times reversed": (lambda: any_call.WrenchTable([1, 0], np.zeros((2, 6))), "WrenchTable.times"),
    "wrench rows": (lambda: any_call.WrenchTable([0, 1], np.zeros((3, 6))), "WrenchTable.values"),
    "push force negative": (lambda: any_call.Push(force=-1.0, direction="x"), "Push.force"),
    "push misspelt": (lambda: any_call.Push(forze=1.0, direction="x"), "Push.forze"),
    "push direction": (lambda: any_call.Push(force=1.0, direction="w"), "Push.direction"),
    "push times reversed": (lambda: any_call.Push(force=1.0, direction="x", start=1.0, end=0.5), "Push.end"),
    "palm misspelt": (lambda: any_call.Palm(turns=1.0), "Palm.turns"),
    "palm path shape": (lambda: any_call.PalmPath([0, 1], np.zeros((2, 3))), "PalmPath.poses"),
    "move axis missing": (lambda: any_call.Move(lift=0.01), "Move.axis"),
    "move nan": (lambda: any_call.Move(axis="z", lift=nan), "Move.lift"),
    "move profile": (lambda: any_call.Move(axis="z", lift=0.01, profile="jerk"), "Move.profile"),
    "mode zero": (lambda: any_call.ModeMove(mode=0, amplitude=0.01), "ModeMove.mode"),
    "waypoint times": (lambda: any_call.Waypoints(times=[2, 1], positions=np.zeros((2, 3))), "Waypoints.times"),
    "waypoint shape": (lambda: any_call.Waypoints(times=[1], positions=[0, 0, 0]), "Waypoints.positions"),
    "motion table": (lambda: any_call.MotionTable([0, 1], np.zeros((2, 5))), "MotionTable.values"),
    "modes table": (lambda: any_call.ModesTable([0, nan], np.zeros((2, 1))), "ModesTable.times"),
    "hold takes nothing": (lambda: any_call.Hold(1.0), "Hold"),
    "slip margin negative": (lambda: any_call.SlipMargin(-0.5), "SlipMargin.margin"),
    "slip margin missing name": (lambda: any_call.SlipMargin(margn=0.5), "SlipMargin.margn"),
    "bounds reversed": (lambda: any_call.NormalForce(lower=5.0, upper=1.0), "NormalForce.lower"),
    "normal force misspelt": (lambda: any_call.NormalForce(uper=1.0), "NormalForce.uper"),
    "torque zero": (lambda: any_call.JointTorque(0.0), "JointTorque.limit"),
    "torque missing": (lambda: any_call.JointTorque(), "JointTorque.limit"),
    "rate a text": (lambda: any_call.SynergyRate("fast"), "SynergyRate.limit"),
    "reference nan": (lambda: any_call.SynergyReference(nan), "SynergyReference.limit"),
    "elastic motion": (lambda: any_call.ElasticMotion(-1.0), "ElasticMotion.limit"),
    "goal misspelt argument": (lambda: any_call.LeastEffort(weight=1.0), "LeastEffort.weight"),
    "sum of names": (lambda: any_call.WeightedSum((("effort", 1.0),)), "WeightedSum.goals[0]"),
    "sum of nothing": (lambda: any_call.WeightedSum(), "WeightedSum.goals"),
    "grasp missing": (lambda: any_call.plan(task=task), "grasp"),
    "grasp and task reversed": (lambda: any_call.plan(task, grasp), "grasp"),
    "solver misspelt": (lambda: any_call.plan(grasp, task, "clarabell"), "solver"),
    "plan misspelt": (lambda: any_call.plan(grasp, task, solvr="clarabel"), "solvr"),
    "torques for other joints": (
        lambda: sg.plan(grasp, task.replace(limits=[sg.JointTorque([1, 2])])),
        "JointTorque.limit",
    ),
    "analyse a hand": (lambda: any_call.analyse(hand), "grasp"),
    "analyse a load": (lambda: any_call.analyse(grasp, np.zeros(3)), "load"),
    "problem misspelt": (lambda: any_call.load_problem("barrett-bal-hold"), "PROBLEM"),
    "problem a number": (lambda: any_call.load_problem(3), "problem"),
    "problem key misspelt": (
        lambda: any_call.load_problem("tripod", "limits.margn=1 N"),
        "--set limits.margn=1 N: limits.margn",
    ),
    "overrides of numbers": (lambda: any_call.load_problem("tripod", [3]), "overrides"),
    "overrides a number": (lambda: any_call.load_problem("tripod", 3), "overrides"),
    "problem argument misspelt": (lambda: any_call.load_problem(problm="tripod"), "problm"),
    "box of three values": (lambda: any_call.Box(0.06, 0.06, 0.06), "Box"),
    "gravity of three values": (lambda: any_call.Gravity(0, 0, -9.81), "Gravity"),
    "friction without a name": (lambda: any_call.HardFinger(0.5), "HardFinger"),
    "a problem in the place of grasp and task": (lambda: any_call.plan(sg.load_problem("tripod")), "task"),
    "a problem in the place of the grasp": (lambda: any_call.plan(sg.load_problem("tripod"), task), "grasp"),
    "lift a text": (lambda: any_call.Move(axis="z", lift="3 mm"), "Move.lift"),
    "J transposed": (lambda: given(J=np.ones((3, 6))), "J"),
    "J transposed, and S right": (lambda: given(J=np.ones((7, 6)), S=np.ones((7, 1))), "J"),
    "a grasp in the place of a task": (lambda: any_call.plan(grasp, grasp), "task"),
    "a task in the place of a grasp": (lambda: any_call.analyse(task), "grasp"),
    "a hand in the place of a response": (lambda: any_call.subspaces(hand), "response"),
    "grasps of one": (lambda: any_call.analyse_many(grasp), "grasps"),
    "masked acceleration": (lambda: any_call.Gravity(np.ma.array([0, 0, 1.0], mask=[0, 0, 1])), "Gravity.acceleration"),
    "a masked entry of G": (lambda: given(G=np.ma.masked_equal(np.eye(6), 1.0)), "G"),
    "masked rows in a list": (lambda: given(J=[np.ma.masked_equal(row, 1.0) for row in np.eye(6)]), "J"),
    "complex G": (lambda: given(G=np.eye(6) * 1j), "G"),
    "texts in J": (lambda: given(J=np.eye(6).astype(str)), "J"),
    "booleans as wrench": (lambda: any_call.Wrench([True] * 6), "Wrench.values"),
    "spans of time as torques": (lambda: any_call.JointTorque(np.ones(3, "timedelta64[s]")), "JointTorque.limit"),
    "no torques at all": (lambda: any_call.JointTorque([]), "JointTorque.limit"),
    "a generator of torques": (lambda: any_call.JointTorque(x for x in (1.0, 2.0)), "JointTorque.limit"),
    "a huge mass": (lambda: any_call.Object(mass=1e200), "Object.mass"),
    "a mass beyond all floats": (lambda: any_call.Object(mass=10**400), "Object.mass"),
    "a huge margin": (lambda: any_call.SlipMargin(10**400), "SlipMargin.margin"),
    "held by nothing": (lambda: grasp.replace(held=3.0), "held"),
    "another contact than there is": (lambda: grasp.replace(contact={"thumb": hard}), "contact['thumb']"),
    "kinds in a list": (lambda: any_call.Grasp.replace(grasp, contact=[hard]), "contact"),
    "names of contacts twice": (lambda: given(contacts=[("a", hard), ("a", hard)]), "contacts[1]"),
    "names that are numbers": (lambda: given(contacts=[(1, hard), (2, hard)]), "contacts[0][0]"),
    "joints as one text": (lambda: given(joints="abcdef"), "joints"),
    "a title that is none": (lambda: given(title=3), "title"),
    "normals by array": (lambda: any_call.ContactAt("a", hard, stiffness=1.0, normals=np.eye(3)), "ContactAt.normals"),
    "a name by array": (lambda: any_call.ContactAt("a", hard, stiffness=1.0, name=np.eye(3)), "ContactAt.name"),
    "ragged compliances": (lambda: made(joint_compliance=[[1], [1, 2]]), "joint_compliance"),
    "part of an error by array": (lambda: any_call.ObjectError(0.1, part=np.eye(3)), "ObjectError.part"),
    "axes of an error by number": (lambda: any_call.ObjectError(0.1, axes=3), "ObjectError.axes"),
    "motion by array": (lambda: any_call.LeastMotion(of=np.eye(3)), "LeastMotion.of"),
    "exactness by text": (lambda: any_call.SteadyForces(exact="yes"), "SteadyForces.exact"),
    "goals by array": (lambda: any_call.WeightedSum(np.eye(2)), "WeightedSum.goals"),
    "a weight negative": (lambda: any_call.WeightedSum([(sg.LeastEffort(), -1.0)]), "WeightedSum.goals[0]"),
    "goals twice": (lambda: any_call.Task(goals=[sg.LeastEffort(), sg.LeastEffort()]), "Task.goals[1]"),
    "gravity twice": (lambda: any_call.Task(loads=[sg.Gravity((0, 0, 1))] * 2), "Task.loads[1]"),
    "knots as a span of time": (lambda: any_call.Task(knots=np.timedelta64(3, "s")), "Task.knots"),
    "waypoint after the end": (
        lambda: any_call.Task(duration=1.0, target=sg.Waypoints(times=[2.0], positions=[[0, 0, 0.01]])),
        "Task.target.times",
    ),
    "a path that is none": (lambda: any_call.read_matrices(3), "path"),
    "a path misspelt": (lambda: any_call.read_matrices(pth="a"), "pth"),
    "loads of another width": (lambda: any_call.respond(grasp, np.zeros((2, 3))), "load"),
    "a solver's class": (lambda: any_call.plan(grasp, task, sg.Task), "solver"),
    "a solver that answers nothing": (lambda: any_call.plan(grasp, task, lambda *_: None), "solver"),
    "usage misspelt": (lambda: any_call.Usage(titel="x"), "Usage.titel"),
    "usage of other items": (
        lambda: any_call.Usage("t", "N", ("a",), [[1.0, 2.0]], [0], [1], [1], [0.0]),
        "Usage.value",
    ),
    "squares of nothing": (lambda: any_call.squares_of(3.0), "squares_of.value"),
    "an objective of numbers": (lambda: any_call.Objective((1.0,)), "Objective.squares[0]"),
    "within misspelt": (lambda: any_call.within(limt="x"), "limt"),
    "stack of other numbers": (lambda: any_call.GraspStack.varied(grasp, C_s=[["a"]]), "C_s"),
    "instants reversed": (lambda: any_call.Wrench(np.zeros(6)).at([1.0, 0.0]), "Wrench.at.times"),
    "gravity of no object": (lambda: any_call.Gravity((0, 0, -9.81)).at([0.0]), "Gravity.at"),
    "formats misspelt": (lambda: any_call.Plan.save(PLAN, "out", formats="jsn"), "formats"),
    "formats as one text of letters": (lambda: any_call.Plan.save(PLAN, "out", formats=("j", "s")), "formats"),
    "a force without a name": (lambda: any_call.NormalForce(20.0), "NormalForce"),
    "no force at all": (lambda: any_call.NormalForce(upper=0), "NormalForce.upper"),
    "a reserve in degrees": (lambda: any_call.FrictionReserve(angle=5), "FrictionReserve.angle"),
    "a turn in degrees": (lambda: any_call.Palm(axis="x", turn=90), "Palm.turn"),
    "a roll in degrees": (lambda: any_call.Move(axis="x", roll=45), "Move.roll"),
    "a move and a hold": (lambda: any_call.Hold() + sg.Move(axis="z", lift=0.01), "Moves.parts"),
    "a limit without a list": (lambda: any_call.Task(limits=sg.SlipMargin(0.5)), "Task.limits"),
    "a goal without a list": (lambda: any_call.Task(goals=sg.LeastEffort()), "Task.goals"),
    "an axis without a list": (lambda: any_call.Task(axes="z"), "Task.axes"),
    "a push in no time": (lambda: any_call.Push(force=1.0, direction="x").at([0.5]), "Push.at.start"),
    "a pad of the hand misspelt": (lambda: hand.pads["finger1/tp"], "Hand.pads"),
    "a posture of the hand misspelt": (lambda: hand.postures["bal"], "Hand.postures"),
    "synergies of the hand misspelt": (lambda: hand.synergy_sets["motor"], "Hand.synergy_sets"),
    "a map misspelt": (lambda: PLAN.analysis.response.accuracy["dlambda"], "accuracy"),
    "a decision misspelt": (lambda: PLAN.analysis.spaces.decisions["force"], "decisions"),
    "a place beyond a stack": (lambda: sg.GraspStack.of([grasp] * 2)[2], "place"),
    "a place before a stack": (lambda: sg.GraspStack.of([grasp] * 2)[-3], "place"),
    "a place by name": (lambda: any_call.GraspStack.of([grasp] * 2)["a"], "place"),
    "a place beyond responses": (lambda: sg.respond_many([grasp]).at(1), "index"),
    "a place beyond a group": (lambda: sg.analyse_many([grasp]).groups[0].at(1), "index"),
    "a place beyond subspaces": (lambda: sg.analyse_many([grasp]).groups[0].spaces.at(1), "index"),
    "a usage misspelt": (lambda: any_call.plan(grasp, task).usages["joint torqe"], "usages"),
    "a usage between the knots misspelt": (lambda: PLAN.between.usages["nothing"], "usages"),  # type: ignore[union-attr]
    "a usage beyond all": (lambda: PLAN.usages[99], "usages"),
    "a usage by a number that is none": (lambda: PLAN.usages[1.0], "usages"),
    "a check misspelt": (lambda: PLAN.checks["balance"], "checks"),
    "instants beyond loads": (lambda: sg.Loads.of(np.zeros((2, 6))).taken([7]), "places"),
    "an instant of loads without a list": (lambda: sg.Loads.of(np.zeros((2, 6))).taken(1), "places"),
    "instants of loads by words": (lambda: sg.Loads.of(np.zeros((2, 6))).taken(["first"]), "places"),
    "an odd slice of loads": (lambda: sg.Loads.of(np.zeros((2, 6))).taken(slice(None, None, 0)), "places"),
    "instants beyond states": (lambda: PLAN.executed.states.taken(np.array([99])), "places"),  # type: ignore[union-attr]
    "grasps beyond a stack": (lambda: sg.GraspStack.of([grasp] * 2).taken([2]), "places"),
    "a choice of too many grasps": (lambda: sg.GraspStack.of([grasp] * 2).taken([True] * 3), "places"),
    "grasps beyond responses": (lambda: sg.respond_many([grasp]).taken([-2]), "indices"),
    "coordinates of other sizes": (lambda: PLAN.analysis.coordinates.references([1], [1], []), "alpha"),  # type: ignore[arg-type]
    "coordinates of other lengths": (
        lambda: PLAN.analysis.coordinates.references(np.zeros((5, 3)), np.zeros((4, 1)), np.zeros((5, 0))),
        "beta",
    ),
    "points that moved without G": (lambda: sg.GraspStack.varied(grasp, points=np.zeros((2, 3, 3))), "G"),
    "a simulation of nothing": (lambda: any_call.Simulation(), "Simulation"),
    "references of other synergies": (lambda: PLAN.analysis.coordinates.coordinates(np.zeros(3)), "dz_r"),
    "references of other grasps": (
        lambda: sg.analyse_many([grasp] * 2).groups[0].coordinates.coordinates(np.zeros((3, 5, 4))),
        "dz_r",
    ),
    "an analysis of nothing": (lambda: any_call.Analysis(), "Analysis"),
    "a plan of nothing": (lambda: any_call.Plan(), "Plan"),
    "a stack of nothing": (lambda: any_call.GraspStack(), "GraspStack.matrices"),
    "argument of save misspelt": (lambda: any_call.Plan.save(PLAN, "out", format="json"), "format"),
}


@pytest.mark.parametrize(("mistake", "named"), MISTAKES.values(), ids=MISTAKES)
def test_a_mistake_is_refused_by_the_name_of_its_argument(mistake: Callable[[], Any], named: str) -> None:
    with pytest.raises(sg.InputError) as refused:
        mistake()
    lines = [line for line in str(refused.value).splitlines() if line.startswith(f"{named}: ")]
    assert lines, refused.value
    assert len(lines[0]) > len(named) + 7


def test_what_is_told_of_a_mistake_says_what_to_write() -> None:
    told = {name: refusal(mistake) for name, (mistake, _) in MISTAKES.items() if name in SAID}
    for name, fragments in SAID.items():
        assert all(fragment in told[name] for fragment in fragments), told[name]
        assert "\n" not in told[name], told[name]


def refusal(mistake: Callable[[], Any]) -> str:
    with pytest.raises(sg.InputError) as refused:
        mistake()
    return str(refused.value)


SAID = {
    "box of three values": ("takes one value, size, got 3", "size=(0.06, 0.06, 0.06)"),
    "friction without a name": ("write friction=...",),
    "friction misspelt": ("did you mean 'friction'?",),
    "a problem in the place of grasp and task": ("missing", "write problem.grasp, problem.task"),
    "a problem in the place of the grasp": ("write problem.grasp",),
    "lift a text": ("a number in m", "got '3 mm'"),
    "S a vector": ("expected shape (6, n_z)", "np.reshape"),
    "J transposed": ("expected shape (6, n_q)", "transposed"),
    "J transposed, and S right": ("fits when transposed",),
    "masked acceleration": ("masked entries",),
    "a force without a name": ("write upper=20.0 or lower=20.0",),
    "a turn in degrees": ("in radians: np.radians(90) = 1.57",),
    "a goal without a list": ("write goals=[...] around it",),
    "an axis without a list": ("write axes=[...] around it",),
    "a pad of the hand misspelt": ("did you mean 'finger1/tip'?",),
    "a place beyond a stack": ("from 0 to 1, got 2",),
}
"""What the refusal of some of them says, in one line: nothing is told twice."""


def test_a_single_text_is_one_format(tmp_path: Path) -> None:
    written = PLAN.save(tmp_path, formats="json")
    assert [path.name for path in written] == [path.name for path in tmp_path.iterdir()] == ["plan.json"]


def test_tables_by_name_and_sequences_stay_what_python_knows() -> None:
    """The errors are those that Python expects of them, and copies and pickles are tables of the same kind."""
    with pytest.raises(KeyError) as refused:
        hand.pads["thumb"]
    assert str(refused.value).startswith("Hand.pads: 'thumb' is not one of 'finger1/tip'")
    assert (hand.pads.get("thumb"), "thumb" in hand.pads) == (None, False)
    for pads in (copy.deepcopy(hand.pads), pickle.loads(pickle.dumps(hand.pads))):
        assert pads == hand.pads
        with pytest.raises(sg.InputError, match=r"Hand\.pads"):
            pads["thumb"]
    with pytest.raises(IndexError):
        sg.GraspStack.of([grasp])[1]
    assert [each is grasp for each in sg.GraspStack.of([grasp] * 2)] == [True, True]


def test_limits_and_checks_of_a_plan_are_found_by_place_and_by_name() -> None:
    titles = [usage.title for usage in PLAN.usages]
    assert PLAN.usages["joint value"] is PLAN.usages[titles.index("joint value")]
    assert (PLAN.usages[-1], PLAN.usages[:2]) == (list(PLAN.usages)[-1], tuple(PLAN.usages)[:2])
    assert PLAN.checks["equilibrium"].passed
    with pytest.raises(KeyError, match="'nothing' is not one of 'slip margin' or 'joint value'"):
        PLAN.usages["nothing"]
    with pytest.raises(IndexError, match=f"expected a place from 0 to {len(titles) - 1}, got 99"):
        PLAN.usages[99]
    for again in (copy.deepcopy(PLAN.usages), pickle.loads(pickle.dumps(PLAN.usages))):
        assert again["joint value"].value.tolist() == PLAN.usages["joint value"].value.tolist()


@pytest.mark.parametrize("places", [[1, -1], np.array([1, 2]), slice(1, None), [False, True, True], [], slice(-9, 1)])
def test_some_of_loads_are_those_that_an_array_takes(places: Any) -> None:
    wrench = np.arange(18.0).reshape(3, 6)
    same = places if len(np.shape(places)) == 0 else np.array(places, dtype=None if len(places) else int)
    assert sg.Loads.of(wrench).taken(places).wrench.tolist() == wrench[same].tolist()


def test_a_choice_of_grasps_is_those_that_are_true() -> None:
    two = [grasp, made(title="other")]
    assert list(sg.GraspStack.of(two).taken([False, True])) == [two[1]]


def test_moves_add_up_by_sum_and_one_lower_force_is_enough() -> None:
    moves = [sg.Move(axis="z", lift=0.01), sg.Move(axis="x", roll=0.1)]
    assert sum(moves) == moves[0] + moves[1]
    assert sg.NormalForce(lower=1.0) == sg.NormalForce(1.0, math.inf) == copy.copy(sg.NormalForce(lower=1.0))


def test_a_push_has_its_values_at_times() -> None:
    push = sg.Push(force=2.0, direction="x", point=(0.0, 0.01, 0.0))
    assert push.at([0.0, 1.0]).tolist() == [[2.0, 0.0, 0.0, 0.0, 0.0, -0.02]] * 2
