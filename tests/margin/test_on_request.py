"""Numbers of each contact and each rigid motion: closed forms, and a program that shares nothing with this one."""

from __future__ import annotations

import json

import cvxpy as cp
import numpy as np
import pytest
from command_line import run
from small_grasps import pinch

import synergrip as sg
from synergrip.linalg import frozen
from synergrip.margin.found import Margins
from synergrip.margin.margins import margins
from synergrip.reports.data.json_margins import margins_document
from synergrip.tasks.timed_task import TimedTask, still

MU, LOAD, CAP = 0.4, 3.0, 6.0
FRICTION, MODES = "critical_friction_per_contact", "largest_amplitude_per_mode"


def found(grasp: sg.Grasp, task: sg.Task | TimedTask, name: str) -> Margins:
    answer = margins(grasp, task, only=[name])
    assert isinstance(answer, Margins)
    assert answer.direct == {}
    assert list(answer.on_request) == [name]
    return answer


def test_each_finger_needs_the_friction_of_what_it_carries() -> None:
    """The load hangs nearer to the left finger, which carries 3/4 of it; each is pressed with the whole cap."""
    time = frozen([0.0])
    wrench = frozen([[0.0, 0.0, -LOAD, 0.0, -0.02 * LOAD / 2, 0.0]])
    task = TimedTask(time, wrench, still(time), 0.0, (sg.NormalForce(upper=CAP),), (sg.LeastEffort(),))
    numbers = found(pinch(MU), task, FRICTION).on_request[FRICTION]
    assert list(numbers) == ["left", "right"]
    for name, share in (("left", 0.75), ("right", 0.25)):
        number, least = numbers[name], share * LOAD / CAP
        assert number.value == pytest.approx(least, rel=1e-4)
        assert number.proven
        assert number.lower is not None
        assert number.lower <= least <= number.value
        assert number.setting == f"grasp.friction_factor={{ {json.dumps(name)} = {number.value / MU:.10g} }}"


def farthest(grasp: sg.Grasp, task: TimedTask, mode: int, sign: float, reference: float, cap: float) -> float:
    """How far a rigid motion may go, by maps, cones and bounds alone: at its end, as the way there is a part of it."""
    analysis = sg.analyse(grasp)
    response, (n_alpha, n_beta, _) = analysis.response, analysis.coordinates.dimensions
    z, size = cp.Variable(grasp.n_z), cp.Variable()
    force = -response.right_inverse @ task.wrench[-1] + response.dlambda_dzr @ z
    kept = [
        analysis.coordinates.M[n_alpha : n_alpha + n_beta] @ z == sign * size * np.eye(n_beta)[mode],
        cp.abs(z) <= reference,
    ]
    for contact, rows in zip(grasp.contacts, grasp.rows, strict=True):
        own = force[rows]
        kept += [cp.norm(own[1:3]) <= contact.friction * own[0], own[0] <= cap]
    problem = cp.Problem(cp.Maximize(size), kept)
    problem.solve(solver="CLARABEL")
    return float(size.value)


def test_rigid_motions_go_as_far_as_an_independent_program_finds() -> None:
    grasp, reference = sg.load_problem("tripod").grasp, [0.01, 0.02, 0.015, 0.03]
    loads = [sg.Wrench((0.5, 0, -3, 0, 0, 0.01))]
    limits = [sg.SynergyReference(reference), sg.NormalForce(upper=CAP)]
    task = sg.Task(knots=5, loads=loads, limits=limits)
    numbers = found(grasp, task, MODES).on_request[MODES]
    spaces = sg.analyse(grasp).spaces
    assert list(numbers) == [f"mode {k} {way}" for k in (1, 2) for way in ("forward", "back")]
    for (name, number), (mode, sign) in zip(numbers.items(), [(0, 1), (0, -1), (1, 1), (1, -1)], strict=True):
        most = farthest(grasp, task.timed(grasp), mode, sign, np.array(reference), CAP)
        assert number.value == pytest.approx(most, rel=1e-4), name
        assert number.proven
        assert number.upper is not None
        assert number.value <= most * (1 + 1e-7) <= number.upper <= 1.0011 * most
        assert number.value is not None
        np.testing.assert_allclose(number.displacement, sign * number.value * spaces.Gamma_ucs[:, mode], rtol=1e-12)
        made = sg.plan(grasp, task.replace(target=sg.ModeMove(mode=mode + 1, amplitude=sign * number.value)))
        assert isinstance(made, sg.Plan)


def test_a_hand_says_how_far_a_motion_goes_and_it_can_be_typed_in(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("synergrip.margin.on_request.SIGNS", {"back": -1.0})
    problem = sg.load_problem("gripper-box", ["task.knots=4", "task.move=[]"])
    document = margins_document("", found(problem.grasp, problem.task, MODES))
    json.dumps(document, allow_nan=False)
    assert document["direct"] == {}
    assert list(document[MODES]) == ["mode 1 back"]
    for number in document[MODES].values():
        again = sg.load_problem("gripper-box", ["task.knots=4", number["set"]])
        assert sg.plan(again.grasp, again.task).verdict == "feasible"
        assert number["value"] == number["lower"]
        assert len(number["displacement"]) == 6


def test_what_has_no_room_to_move_says_why() -> None:
    problem = sg.load_problem("tripod")
    held = sg.Task(knots=1, limits=problem.task.limits)
    for task, why in (
        (problem.task, "moves the object already"),
        (held, "task.knots = 1"),
        (held.timed(problem.grasp), ""),
    ):
        numbers = found(problem.grasp, task, MODES).on_request[MODES].values()
        assert len(numbers) == 4
        assert all(why in each.why and each.value is None for each in numbers)
    told = run("margins", "tripod", "--only", MODES).stdout
    assert "moves the object already" in " ".join(told.split())
