"""Objects that contacts leave free to move, planned where nothing loads that motion or asks for it; else refused."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from free_grasps import FORMS, free_grasp
from made_kinds import made_kind

import synergrip as sg
from synergrip.errors import NotRestrainedError
from synergrip.grasps.contacts.contact import Contact, contact_frame
from synergrip.grasps.grasp import Grasp, grasp_matrix
from synergrip.linalg import frozen
from synergrip.planning.check import judge_references
from synergrip.planning.references import References
from synergrip.planning.refusals import refusal_certificate
from synergrip.statics.analysis import analyse
from synergrip.statics.restraint import NO_LOAD

WEIGHT = (0.0, -1.0, 0.0, 0.0, 0.0, 0.0)
ALONG_X = (0.0, -1.0, 0.0, 0.1, 0.0, 0.0)
"""A weight and a moment about the line through the two hard fingers."""
FREE = "the object may turn about the line through L and R; no load works against it and no motion asks for it"


def grasp_of(contacts: list[tuple[str, str, list[float], list[float]]]) -> Grasp:
    """A grasp whose every force component has a joint and a synergy of its own; friction 1, 1 N/mm."""
    made = tuple(
        Contact(
            name=name, kind=made_kind(kind, float(kind == "hard")), point=frozen(point), frame=contact_frame(normal)
        )
        for name, kind, point, normal in contacts
    )
    G = grasp_matrix(made)
    n, zero = G.shape[1], np.zeros((G.shape[1], G.shape[1]))
    return Grasp(
        title="free", contacts=made, G=G, J=frozen(np.eye(n)), S=frozen(np.eye(n)), C_s=frozen(1e-3 * np.eye(n)),
        C_q=frozen(zero), C_z=frozen(zero), lambda_0=None, w_0=frozen(np.zeros(6)),
        joints=tuple(f"q{i}" for i in range(n)), synergies=tuple(f"z{i}" for i in range(n)),
    )  # fmt: skip


PLANAR = grasp_of([("L", "hard", [-1, 0, 0], [1, 0, 0]), ("R", "hard", [1, 0, 0], [-1, 0, 0])])
SPATIAL = grasp_of(
    [
        ("A", "frictionless", [-1, 0, 0], [1, 0, 0]),
        ("B", "hard", [0, 0, -1], [0, 0, 1]),
        ("C", "hard", [0, 0, 1], [0, 0, -1]),
    ]
)


def task(*loads: object, **others: object) -> sg.Task:
    stated = {"limits": [sg.NormalForce(upper=100.0)], "goals": [sg.LeastPeak()], "duration": 1.0, "knots": 3}
    return sg.Task(loads=list(loads), **(stated | others))


def world(grasp: Grasp, forces: np.ndarray) -> np.ndarray:
    """Contact forces (n_c, 3) in the axes of the object."""
    rows = [
        contact.frame[:, : slots.stop - slots.start] for contact, slots in zip(grasp.contacts, grasp.rows, strict=True)
    ]
    return np.array([frame @ forces[slots] for frame, slots in zip(rows, grasp.rows, strict=True)])


@pytest.mark.parametrize("solver", ["clarabel", "cvxpy"])
@pytest.mark.parametrize(
    ("grasp", "published"),
    [
        (PLANAR, [[0.5, 0.5, 0], [-0.5, 0.5, 0]]),
        (SPATIAL, [[0, 0, 0], [0, 0.5, 0.5], [0, 0.5, -0.5]]),
    ],
    ids=["planar", "spatial"],
)
def test_the_forces_of_a_textbook(grasp: Grasp, published: list[list[float]], solver: str) -> None:
    answer = sg.plan(grasp, task(sg.Wrench(WEIGHT)), solver=solver)
    assert answer.verdict == "feasible"
    for forces in answer.forces:
        assert np.allclose(world(grasp, forces), published, rtol=0, atol=1e-5)
    assert any(note.startswith("the object may turn about the line through") for note in answer.notes)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("seed", range(4))
def test_loads_that_some_pushes_balance_are_held_between_the_knots_too(form: str, seed: int) -> None:
    """Every joint driven, and loads made from forces within the cones, so that there is a plan."""
    rng = np.random.default_rng(seed)
    grasp = free_grasp(rng, form)
    n, zero = grasp.n_l, np.zeros((grasp.n_l, grasp.n_l))
    grasp = replace(
        grasp, J=frozen(np.eye(n)), S=frozen(np.eye(n)), C_q=frozen(zero), C_z=frozen(zero),
        joints=tuple(f"q{i}" for i in range(n)), synergies=tuple(f"z{i}" for i in range(n)),
    )  # fmt: skip
    pushes = 0.1 * rng.normal(size=(4, n))
    pushes[:, grasp.normal_rows] = rng.uniform(1, 2, size=(4, grasp.n_c))
    table = sg.WrenchTable([0.0, 0.3, 0.6, 1.0], -pushes @ grasp.G.T)
    answer = sg.plan(grasp, task(table, goals=[sg.LeastEffort()], between="hold"))
    assert answer.verdict == "feasible"
    assert np.abs(answer.forces @ grasp.G.T + answer.task.wrench).max() < 1e-9
    assert answer.margins.min() > -1e-6
    assert answer.between is not None
    assert answer.between.excess <= 1e-6
    response = answer.analysis.response
    assert np.abs(response.scale.twist(answer.motion.du) @ response.free).max() < 1e-12
    assert response.free.shape[1] == FORMS[form]


def test_the_note_names_what_is_free() -> None:
    (note,) = [note for note in sg.plan(PLANAR, task(sg.Wrench(WEIGHT))).notes if "may" in note]
    assert note.startswith(FREE)


@pytest.mark.parametrize(
    ("loads", "when"),
    [
        (([0.0, 1.0], [WEIGHT, ALONG_X]), "at t = 1 s the load"),
        (([0.0, 0.25, 0.3, 0.35, 1.0], [WEIGHT, WEIGHT, ALONG_X, WEIGHT, WEIGHT]), "at t = 0.3 s the load"),
    ],
    ids=["at a knot", "between the knots"],
)
def test_a_load_on_what_is_free_is_named_with_its_time(loads: tuple, when: str) -> None:
    answer = sg.plan(PLANAR, task(sg.WrenchTable(*loads)))
    assert (answer.verdict, answer.stage, answer.certificate.verified) == ("infeasible", "restraint", True)
    assert when in answer.why
    assert "(0, 0, 0, 0.1, 0, 0) N, N m" in answer.why


def test_a_load_at_the_start_alone_is_named_too() -> None:
    loaded = replace(PLANAR, w_0=frozen(ALONG_X))
    answer = sg.plan(loaded, task(sg.Wrench(WEIGHT)))
    assert (answer.verdict, answer.stage) == ("infeasible", "restraint")
    assert "at the start, where it is w_0, the load has a part" in answer.why


def moves(*values: float) -> sg.MotionTable:
    return sg.MotionTable([0.0, 1.0], [[0.0] * 6, list(values)])


def test_a_motion_along_what_is_free_is_refused_and_another_is_followed() -> None:
    asked = sg.plan(PLANAR, task(sg.Wrench(WEIGHT), target=moves(0, 0.01, 0, 0.1, 0, 0)))
    assert (asked.verdict, asked.stage, asked.certificate.verified) == ("infeasible", "restraint", True)
    assert "at t = 1 s the wanted motion" in asked.why
    assert "(5.73, 0, 0) deg along what is free" in asked.why
    other = sg.plan(PLANAR, task(sg.Wrench(WEIGHT), target=moves(0, 0.01, 0, 0, 0, 0.02)))
    assert other.verdict == "feasible"
    du = other.motion.du[-1] - other.motion.sag[-1] - other.elastic_motion[-1]
    assert np.allclose(du, [0, 0.01, 0, 0, 0, 0.02], rtol=0, atol=1e-12)


def test_a_refusal_that_the_task_does_not_need_does_not_verify() -> None:
    known = analyse(PLANAR, NO_LOAD)
    no = sg.plan(PLANAR, task(sg.Wrench(ALONG_X))).refusal
    assert isinstance(no, NotRestrainedError)
    for load, verified in ((WEIGHT, False), (ALONG_X, True)):
        assert refusal_certificate(task(sg.Wrench(load)).timed(PLANAR), known, no).verified is verified
    elsewhere = NotRestrainedError(str(no), np.eye(6)[:, 4:5], no.unsupported)  # a turn that contacts do resist
    assert not refusal_certificate(task(sg.Wrench(ALONG_X)).timed(PLANAR), known, elsewhere).verified


def test_check_judges_such_a_plan() -> None:
    timed = task(sg.Wrench(WEIGHT)).timed(PLANAR)
    answer = sg.plan(PLANAR, timed)
    good = judge_references(PLANAR, timed, References(answer.time, answer.dz_r, {}))
    assert good.verdict == "feasible"
    assert np.allclose(good.motion.forces, answer.forces, rtol=0, atol=1e-12)
    assert judge_references(PLANAR, timed, References(answer.time, 0.5 * answer.dz_r, {})).verdict == "fails"


def test_a_hand_is_planned_and_not_executed() -> None:
    hard = {"contacts.model": "hard", "task.push": "[]"}
    problem = sg.load_problem("gripper-peg", overrides=[f"{key}={value}" for key, value in hard.items()])
    load = np.zeros((len(problem.timed.times), 6))
    answer = sg.plan(problem.grasp, replace(problem.timed, wrench=frozen(load), course=None))
    assert answer.analysis.response.restraint.rank == 5
    assert answer.verdict == "feasible"
    assert answer.executed is None
    assert any("was not executed" in note for note in answer.notes)
