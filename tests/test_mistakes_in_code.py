"""Mistakes made in code: each is an `InputError` that names the argument; none is accepted, none ends in NumPy."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import synergrip as sg

nan = math.nan
hard = sg.HardFinger(friction=0.6)
hand = sg.load_hand("barrett")
ball = sg.Object(mass=0.2, shape=sg.Sphere(radius=0.05))
at = [sg.ContactAt(pad, hard, stiffness=8e3) for pad in ("finger1/tip", "finger2/tip", "finger3/tip")]
grasp = sg.make_grasp(hand, ball, posture="ball", synergies="motors", contacts=at)
task = sg.Task(duration=1.0, knots=3)
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
    "hand misspelt": (lambda: any_call.load_hand("baret"), "baret"),
    "hand of another type": (lambda: any_call.load_hand(3), "hand"),
    "hand missing": (lambda: any_call.load_hand(), "missing"),
    "mass negative": (lambda: any_call.Object(mass=-0.2), "mass"),
    "mass nan": (lambda: any_call.Object(mass=nan), "mass"),
    "mass a text": (lambda: any_call.Object(mass="200 g"), "mass"),
    "object misspelt": (lambda: any_call.Object(mas=0.2), "mas"),
    "object position": (lambda: any_call.Object(mass=0.2, position=(0, 0)), "position"),
    "object shape": (lambda: any_call.Object(mass=0.2, shape="sphere"), "shape"),
    "radius zero": (lambda: any_call.Sphere(radius=0), "radius"),
    "radius missing": (lambda: any_call.Sphere(), "radius"),
    "radius misspelt": (lambda: any_call.Sphere(radios=0.1), "radios"),
    "box sides": (lambda: any_call.Box(size=(0.1, 0.1)), "size"),
    "cylinder radius": (lambda: any_call.Cylinder(radius=nan, height=0.1), "radius"),
    "friction negative": (lambda: any_call.HardFinger(friction=-0.1), "friction"),
    "friction missing": (lambda: any_call.HardFinger(), "friction"),
    "friction misspelt": (lambda: any_call.HardFinger(frction=0.5), "frction"),
    "soft finger": (lambda: any_call.SoftFinger(friction=0.5, torsional_friction=nan), "torsional_friction"),
    "contact kind": (lambda: any_call.ContactAt("finger1/tip", "hard", stiffness=8e3), "kind"),
    "stiffness missing": (lambda: any_call.ContactAt("finger1/tip", hard), "stiffness"),
    "stiffness negative": (lambda: any_call.ContactAt("finger1/tip", hard, stiffness=-1), "stiffness"),
    "stiffness misspelt": (lambda: any_call.ContactAt("finger1/tip", hard, stifness=1), "stifness"),
    "tangent shape": (lambda: any_call.ContactAt("finger1/tip", hard, stiffness=1, tangent=(1, 0)), "tangent"),
    "posture misspelt": (lambda: made(posture="bal"), "posture"),
    "posture shape": (lambda: made(posture=np.zeros(3)), "posture"),
    "posture nan": (lambda: made(posture=np.full(8, nan)), "posture"),
    "synergies misspelt": (lambda: made(synergies="motor"), "synergies"),
    "contacts empty": (lambda: made(contacts=[]), "contacts"),
    "contacts by name": (lambda: made(contacts=["finger1/tip"]), "contacts"),
    "pad misspelt": (lambda: made(contacts=[sg.ContactAt("finger1/tp", hard, stiffness=1)]), "contacts"),
    "body instead of object": (lambda: made(body=ball), "body"),
    "compliance negative": (lambda: made(joint_compliance=-1.0), "joint_compliance"),
    "G shape": (lambda: given(G=np.eye(6)[:, :5]), "G"),
    "G nan": (lambda: given(G=np.full((6, 6), nan)), "G"),
    "J shape": (lambda: given(J=np.eye(5)), "J"),
    "S a vector": (lambda: given(S=np.ones(6)), "S"),
    "C_s negative": (lambda: given(C_s=-1.0), "C_s"),
    "contacts of matrices": (lambda: given(contacts=[("a", "hard")]), "contacts"),
    "matrix misspelt": (lambda: given(C_ss=1.0), "C_ss"),
    "w_0 shape": (lambda: given(w_0=np.zeros(3)), "w_0"),
    "duration negative": (lambda: any_call.Task(duration=-1.0), "duration"),
    "duration nan": (lambda: any_call.Task(duration=nan), "duration"),
    "duration misspelt": (lambda: any_call.Task(durations=1.0), "durations"),
    "duration without a name": (lambda: any_call.Task(1.0), "duration"),
    "knots not whole": (lambda: any_call.Task(knots=2.5), "knots"),
    "target a text": (lambda: any_call.Task(target="hold"), "target"),
    "a load without a list": (lambda: any_call.Task(loads=sg.Gravity((0, 0, -9.81))), "loads"),
    "loads of numbers": (lambda: any_call.Task(loads=[1.0]), "loads"),
    "a goal by name": (lambda: any_call.Task(goals=["effort"]), "goals"),
    "a goal's class": (lambda: any_call.Task(goals=[sg.LeastEffort]), "goals"),
    "a limit of a number": (lambda: any_call.Task(limits=[20.0]), "limits"),
    "a limit's class": (lambda: any_call.Task(limits=[sg.JointTorque]), "limits"),
    "axes misspelt": (lambda: any_call.Task(axes=("x", "w")), "axes"),
    "task changed by a misspelt name": (lambda: task.replace(duraton=2.0), "duraton"),
    "load factor negative": (lambda: task.replace(load_factor=-1.0), "load_factor"),
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
    "bounds reversed": (lambda: any_call.NormalForce(lower=5.0, upper=1.0), "NormalForce"),
    "normal force misspelt": (lambda: any_call.NormalForce(uper=1.0), "NormalForce.uper"),
    "torque zero": (lambda: any_call.JointTorque(0.0), "JointTorque.limit"),
    "torque missing": (lambda: any_call.JointTorque(), "JointTorque.limit"),
    "rate a text": (lambda: any_call.SynergyRate("fast"), "SynergyRate.limit"),
    "reference nan": (lambda: any_call.SynergyReference(nan), "SynergyReference.limit"),
    "elastic motion": (lambda: any_call.ElasticMotion(-1.0), "ElasticMotion.limit"),
    "goal misspelt argument": (lambda: any_call.LeastEffort(weight=1.0), "LeastEffort.weight"),
    "sum of names": (lambda: any_call.WeightedSum((("effort", 1.0),)), "WeightedSum"),
    "sum of nothing": (lambda: any_call.WeightedSum(), "WeightedSum"),
    "grasp missing": (lambda: any_call.plan(task=task), "grasp"),
    "grasp and task reversed": (lambda: any_call.plan(task, grasp), "grasp"),
    "solver misspelt": (lambda: any_call.plan(grasp, task, "clarabell"), "solver"),
    "plan misspelt": (lambda: any_call.plan(grasp, task, solvr="clarabel"), "solvr"),
    "torques for other joints": (lambda: sg.plan(grasp, task.replace(limits=[sg.JointTorque([1, 2])])), "JointTorque"),
    "analyse a hand": (lambda: any_call.analyse(hand), "grasp"),
    "analyse a load": (lambda: any_call.analyse(grasp, np.zeros(3)), "load"),
    "problem misspelt": (lambda: any_call.load_problem("barrett-bal-hold"), "PROBLEM"),
    "problem a number": (lambda: any_call.load_problem(3), "problem"),
    "problem key misspelt": (lambda: any_call.load_problem("tripod", "limits.margn=1 N"), "margn"),
    "overrides of numbers": (lambda: any_call.load_problem("tripod", [3]), "overrides"),
    "overrides a number": (lambda: any_call.load_problem("tripod", 3), "overrides"),
    "problem argument misspelt": (lambda: any_call.load_problem(problm="tripod"), "problm"),
}


@pytest.mark.parametrize(("mistake", "named"), MISTAKES.values(), ids=MISTAKES)
def test_a_mistake_is_refused_by_the_name_of_its_argument(mistake: Callable[[], Any], named: str) -> None:
    with pytest.raises(sg.InputError) as refused:
        mistake()
    assert named in str(refused.value)
    assert len(str(refused.value)) > len(named) + 5
