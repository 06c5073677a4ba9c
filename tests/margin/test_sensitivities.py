"""What changes are worth: closed forms, differences of margins that are found anew, and kinks that are told as such."""

from __future__ import annotations

import dataclasses
import json
from dataclasses import replace

import numpy as np
import pytest
from altered_grasps import altered, largest_margin
from command_line import run
from small_grasps import pinch, tripod
from too_much import with_plan

import synergrip as sg
from synergrip.changes.asked import Asked
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.linalg import frozen
from synergrip.margin.sensitivity.moved_contacts import moved, turned
from synergrip.margin.sensitivity.of_largest import by_differences
from synergrip.margin.sensitivity.optimum import optimum
from synergrip.margin.sensitivity.parameters import parameters
from synergrip.margin.sensitivity.sensitivity import FIXED, HAND, LARGEST, START, Sensitivities, Sensitivity
from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan
from synergrip.reports.data.json_sensitivities import sensitivities_document
from synergrip.reports.text.text_sensitivities import sensitivity_lines
from synergrip.statics.motion import forward
from synergrip.statics.response import respond
from synergrip.tasks.timed_task import TimedTask, still

MU, LOAD, CAP = 0.4, 3.0, 6.0
TIME = frozen([0.0])
CARRY = TimedTask(
    TIME, frozen([[0.0, 0.0, -LOAD, 0.0, 0.0, 0.0]]), still(TIME), 0.0, (NormalForce(upper=CAP),),
    (LargestMargin(), LeastEffort()),
)  # fmt: skip
"""Two fingers carry a load between them, half of it each: mu n - load / 2 is the margin, with n up to the cap."""
WIDTH = 1e-3


def found(grasp: sg.Grasp, task: sg.TimedTask | sg.Task) -> Sensitivities:
    answer = sg.sensitivities(grasp, task)
    assert isinstance(answer, Sensitivities)
    return answer


def one(of: Sensitivities, kind: str, name: str, whose: str = "") -> Sensitivity:
    return next(each for each in of.of(kind) if each.name == name and each.of.endswith(whose))


@pytest.fixture(scope="module")
def carried() -> Sensitivities:
    return found(pinch(MU), CARRY)


def test_a_pinch_has_its_closed_form(carried: Sensitivities) -> None:
    assert carried.margins[LARGEST] == pytest.approx(MU * CAP - LOAD / 2)
    whole = {"friction": MU * CAP, "load": -LOAD / 2, "force cap": MU * CAP}
    for name, derivative in whole.items():
        each = one(carried, LARGEST, name)
        assert each.differentiable
        assert (each.derivative, each.value) == pytest.approx((derivative, derivative / 100), rel=1e-7)
    kept = {"friction": MU * CAP, "load": -LOAD / 2, "contact stiffness": MU * CAP}  # springs push as they are stiff
    for name, derivative in kept.items():
        assert one(carried, FIXED, name).derivative == pytest.approx(derivative, rel=1e-6)


def test_a_number_that_only_one_of_the_worst_contacts_has_makes_a_kink(carried: Sensitivities) -> None:
    for kind in (LARGEST, FIXED):
        each = one(carried, kind, "friction", "left")
        assert (each.differentiable, each.value, each.gain) == (False, None, 0.0)
        assert each.why
        assert each.left == pytest.approx(MU * CAP / 100, rel=1e-6)
        assert each.right == pytest.approx(0.0, abs=1e-9)


def test_the_three_worth_most_are_told_by_what_they_add(carried: Sensitivities) -> None:
    assert [(each.name, each.grows) for each in carried.worth_most(LARGEST)] == [
        ("friction", True), ("force cap", True), ("load", False),
    ]  # fmt: skip
    assert [each.name for each in carried.worth_most(LARGEST, 1)] == ["friction"]
    with pytest.raises(sg.InputError, match="kind"):
        carried.worth_most("margin")
    with pytest.raises(sg.InputError, match="count"):
        carried.worth_most(LARGEST, 0)


def test_what_has_no_derivative_says_why(carried: Sensitivities) -> None:
    assert "kinematics" in carried.left_out["position"]
    assert "rigid" in carried.left_out["joint stiffness"]
    unbounded = found(pinch(MU), replace(CARRY, limits=(), goals=(LeastEffort(),)))
    assert unbounded.margins[LARGEST] is None
    assert "bounds" in unbounded.left_out[LARGEST]
    assert unbounded.of(LARGEST) == ()
    problem = sg.load_problem("table2-hard-joints")
    moved_away = found(problem.grasp, problem.task)
    lost = [each for each in moved_away.of(LARGEST) if each.name == "position" and each.left is None]
    assert lost
    assert all(not each.differentiable and "synergies control" in each.why for each in lost)


def agrees(each: Sensitivity, grasp: sg.Grasp, task: TimedTask, size: float, scale: float = 1.0) -> None:
    """A sensitivity of the largest margin is that of differences; one-sided ones are less close."""
    margins = [largest_margin(*_altered(grasp, task, each, k * WIDTH * scale)) for k in (-2, -1, 0, 1, 2)]
    a, b, c, d, e = margins
    middle, left, right = (8 * (d - b) - (e - a)) / 12, (3 * c - 4 * b + a) / 2, (4 * d - 3 * c - e) / 2
    assert each.left is not None
    assert each.right is not None
    told = np.array([each.left, each.right]) / each.step * WIDTH * scale
    if each.differentiable:
        assert abs(told[0] - middle) <= 1e-5 * max(abs(middle), size * WIDTH), each
    else:
        assert np.abs(told - (left, right)).max() <= 1e-2 * max(abs(left), abs(right)), each


def _altered(grasp: sg.Grasp, task: TimedTask, each: Sensitivity, change: float) -> tuple[sg.Grasp, TimedTask]:
    other = altered(grasp, task, each, change)
    assert other is not None
    return other


def test_random_grasps_agree_with_margins_found_anew() -> None:
    question = with_plan(np.random.default_rng([31, 3]), "force_cap")
    assert question is not None
    made = plan(*question)
    assert isinstance(made, Plan)
    of = found(*question)
    tried = [each for each in of.of(LARGEST) if each.size > 1e-5]
    assert sum(each.differentiable for each in tried) > 8
    for each in tried[::3]:
        agrees(each, made.grasp, made.task, 0.1 * float(np.abs(made.forces).max()))


def test_turned_normals_of_matrices_agree_with_margins_found_anew() -> None:
    grasp = tripod(below=0.3)
    task = replace(CARRY, wrench=frozen([[0.2, -0.3, -1.0, 0.0, 0.004, 0.002]]), limits=(NormalForce(upper=CAP),))
    tried = [each for each in found(grasp, task).of(LARGEST) if each.name == "normal"]
    assert len(tried) == 6
    assert sum(bool(each.size) for each in tried) > 3
    for each in tried:
        agrees(each, grasp, task, CAP)


def test_differences_of_optima_found_anew_are_what_multipliers_say() -> None:
    made = plan(pinch(MU), CARRY)
    assert isinstance(made, Plan)
    asked = Asked.of(made.grasp, CARRY, made.task)
    posed = asked.posed(made.analysis)
    assert posed is not None
    best = optimum(posed)
    assert not isinstance(best, str)
    common, left, *_ = parameters(asked, made.task, made.analysis.response)
    smooth, kinked = by_differences(common, best, MU * CAP), by_differences(left, best, MU * CAP)
    assert (smooth.differentiable, smooth.derivative) == (True, pytest.approx(MU * CAP))
    assert (kinked.left, kinked.right) == pytest.approx((MU * CAP / 100, 0.0), rel=1e-4, abs=1e-7)
    assert not kinked.differentiable


def test_places_and_normals_on_a_hand_agree_with_margins_found_anew() -> None:
    problem = sg.load_problem("utah-mit-ball", ["task.knots=2"])
    made = plan(problem.grasp, problem.task)
    assert isinstance(made, Plan)
    tried = [each for each in found(problem.grasp, problem.task).of(LARGEST) if each.per != "1 %"]
    assert len(tried) == 5 * made.grasp.n_c
    lengths = {"1 mm": made.analysis.response.scale.length, "1 deg": 1.0}
    for each in [each for each in tried if each.size > 1e-3][::6]:
        agrees(each, made.grasp, made.task, float(np.abs(made.forces).max()), lengths[each.per])


def test_a_moved_contact_stays_on_its_link() -> None:
    grasp, by, step = sg.load_problem("barrett-ball-hold").grasp, np.array([1e-3, 2e-3, -5e-4]), 1e-6
    held = grasp.held
    assert held is not None
    other = turned(moved(grasp, 0, by), 0, np.array([0.1, -0.2, 0.3]))
    contact, touch = other.contacts[0], held.touches[0]
    assert np.allclose(contact.point, grasp.contacts[0].point + grasp.contacts[0].frame @ by)
    (motion,) = held.hand.kinematics.at(held.q, [(touch.pad.link, touch.pad.point)])
    spot = motion.rotation.T @ (contact.point + held.body.position - motion.position) + touch.pad.point
    for joint in range(grasp.n_q):
        way = step * np.eye(grasp.n_q)[joint]
        ends = [held.hand.kinematics.at(held.q + sign * way, [(touch.pad.link, spot)])[0] for sign in (1, -1)]
        velocity = (ends[0].position - ends[1].position) / (2 * step)
        assert np.allclose(other.J[grasp.rows[0], joint], contact.frame.T @ velocity, atol=1e-8)


def test_fixed_references_on_a_hand_are_those_of_its_equilibria() -> None:
    problem = sg.load_problem("barrett-ball-hold", ["task.knots=2", "task.between=report"])
    made = plan(problem.grasp, problem.task)
    assert isinstance(made, Plan)
    of = found(problem.grasp, problem.task)
    assert {each.model for each in of.of(FIXED)} == {HAND}
    assert {each.model for each in of.of(LARGEST)} == {START}
    each = one(of, FIXED, "contact stiffness", "finger2/tip")
    rates = []
    for sign in (1, -1):
        other, _ = _altered(made.grasp, made.task, each, sign * WIDTH)
        loads = sg.Loads.of(np.array(made.task.wrench))
        rates.append(sg.execute(other, made.time, made.dz_r, loads).margins)
    change = (rates[0] - rates[1]) / (2 * WIDTH) / 100
    tied = change[made.margins <= made.margins.min() + 1e-4 * np.abs(made.forces).max()]
    assert (each.left, each.right) == pytest.approx((tied.max(), tied.min()), rel=1e-3)


def test_fixed_references_of_random_grasps_agree_with_their_response() -> None:
    question = with_plan(np.random.default_rng([31, 3]), "force_cap")
    assert question is not None
    made = plan(*question)
    assert isinstance(made, Plan)
    for each in found(*question).of(FIXED):
        grasps = [_altered(made.grasp, made.task, each, sign * 1e-4) for sign in (1, -1)]
        both = [
            np.column_stack([c.slip_margin(forces[:, rows]) for c, rows in zip(g.contacts, g.rows, strict=True)])
            for g, t in grasps
            for forces in [forward(respond(g), made.time, made.dz_r, t.wrench).forces]
        ]
        tied = ((both[0] - both[1]) / 2e-4)[made.margins <= made.margins.min() + 1e-5]
        assert each.left is not None
        assert each.right is not None
        told = np.array([each.left, each.right]) / each.step
        assert told == pytest.approx([tied.max(), tied.min()], rel=1e-5, abs=1e-5)


def test_they_are_printed() -> None:
    done = run("margins", "pinch-soft", "--only", "sensitivities")
    assert done.exit_code == 0
    assert done.stdout.count("friction of all contacts +1 %") == 2
    assert "friction of left" not in done.stdout
    assert "friction of left" in run("margins", "pinch-soft", "--only", "sensitivities", "--all").stdout


def test_what_was_interrupted_is_not_said_to_be_nothing(carried: Sensitivities) -> None:
    half = dataclasses.replace(carried, each=carried.of(LARGEST), interrupted=True)
    told = "\n".join(sensitivity_lines(half, sg.load_problem("tripod").grasp))
    assert "with these references: interrupted before it was found" in told
    assert "no such change" not in told


def test_where_tangents_point_is_told_on_a_hand(carried: Sensitivities) -> None:
    grasp = sg.load_problem("barrett-ball-carry").grasp
    first = grasp.contacts[0]
    one = dataclasses.replace(carried.of(LARGEST)[0], of=first.name, direction="about t")
    told = " ".join("\n".join(sensitivity_lines(dataclasses.replace(carried, each=(one,)), grasp, whole=True)).split())
    t = ", ".join(f"{each + 0.0:.3g}" for each in np.round(first.frame[:, 1], 6))
    assert f" in the palm frame at the start: t of {first.name} ({t})" in told
    assert " o of " not in told
    assert "palm frame" not in "".join(sensitivity_lines(carried, sg.load_problem("tripod").grasp, whole=True))


def test_the_document_has_them_in_si_units(carried: Sensitivities) -> None:
    document = sensitivities_document(carried)
    json.dumps(document, allow_nan=False)
    (friction,) = (
        each for each in document["sensitivities"] if (each["kind"], each["name"], each["of"]) == MOST
    )  # fmt: skip
    assert (friction["value"], friction["per"], friction["derivative_unit"]) == (pytest.approx(0.024), "1 %", "N")
    assert friction["derivative"] == pytest.approx(MU * CAP)
    assert document["worth_most"][LARGEST][0] == [*MOST[1:], ""]
    assert {each["differentiable"] for each in document["sensitivities"]} == {True, False}
    assert all((each["value"] is None) == (not each["differentiable"]) for each in document["sensitivities"])


MOST = (LARGEST, "friction", "all contacts")


def test_a_plan_of_another_grasp_is_refused() -> None:
    made = plan(pinch(MU), CARRY)
    with pytest.raises(sg.InputError, match="another grasp"):
        sg.sensitivities(pinch(2 * MU), CARRY, known=made)  # type: ignore[arg-type]
    assert isinstance(sg.sensitivities(pinch(MU), CARRY, known=made), Sensitivities)  # type: ignore[arg-type]
