"""What is called feasible on a hand is true where it really comes to rest, also of a plan of the start posture."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from jaws_that_move import jaws
from second_execution import between_knots, with_fewer_lines
from second_execution import executed as executed_otherwise

from synergrip import (
    Gravity,
    Infeasible,
    JointTorque,
    Plan,
    Push,
    SlipMargin,
    Sphere,
    Task,
    Unknown,
    load_problem,
    plan,
)
from synergrip.equilibrium.execute import execute
from synergrip.planning.check import judge_references
from synergrip.planning.executing import Executor, loads
from synergrip.planning.planning import plan_of_start_posture
from synergrip.planning.references import References
from synergrip.planning.solvers import SOLVERS
from synergrip.planning.straying import strayed
from synergrip.planning.walk import Walker
from synergrip.reports.data.json_plan import outcome_document

REPOSITORY = Path(__file__).resolve().parents[2]
ONCE = "task.linearise=once"


@pytest.mark.parametrize("name", ["human-ball", "robonaut-handle", "dlr-ball-lift-free", "gripper-peg"])
def test_a_plan_that_slips_where_the_hand_moves_is_never_feasible(name: str) -> None:
    problem = load_problem(name, [ONCE] if name == "gripper-peg" else [ONCE, "task.knots=9"])
    promised, answer = (make(problem.grasp, problem.task) for make in (plan_of_start_posture, plan))
    assert isinstance(promised, Plan)
    assert isinstance(answer, Unknown)
    assert (answer.stage, answer.exit_code) == ("execution", 3)
    assert answer.executed is not None
    worst = float(answer.usages[0].value.min())
    asked = answer.usages[0].lower[0]
    assert worst < min(asked, promised.margins.min()) - 1e-3
    assert f"slip margin {worst:.4g} N" in answer.why
    assert "along" in answer.why
    document = outcome_document("", problem.grasp, answer)
    assert document["true"]["margin"]["worst_N"] == pytest.approx(worst, abs=1e-12)
    assert document["limits"][0]["value"] == pytest.approx(worst, abs=1e-12)


@pytest.mark.parametrize("name", ["barrett-ball-still", "barrett-ball-carry"])
def test_a_plan_of_the_start_posture_that_holds_says_what_its_promise_was_worth(name: str, tmp_path: Path) -> None:
    problem = load_problem(name, [ONCE])
    promised, answer = (make(problem.grasp, problem.task) for make in (plan_of_start_posture, plan))
    assert isinstance(promised, Plan)
    assert isinstance(answer, Plan), answer
    assert answer.passes == 0
    assert np.array_equal(answer.dz_r, promised.dz_r)
    assert answer.margins.min() != promised.margins.min()
    told = f"promises a smallest slip margin of {promised.margins.min():.4g} N; the hand that moves keeps"
    assert any(told in note for note in answer.notes)
    answer.save(tmp_path)
    document = json.loads((tmp_path / "plan.json").read_text())
    other = executed_otherwise(document, REPOSITORY, document["true"]["contact_model"])
    assert np.abs(answer.margins - other.margins).max() <= 0.01 * np.abs(answer.forces).max()
    assert document["certificate"]["scope"] == "start"


LINES = 40
"""Instants at which a second program looks at a plan, about."""


@pytest.mark.parametrize(("name", "knots"), [("barrett-ball-hold", 2), ("gripper-box", 2), ("human-graspit-ball", 2)])
def test_a_plan_of_few_knots_keeps_its_margin_at_all_times(name: str, knots: int) -> None:
    """Half-way of a course that starts and ends smoothly a load is on its straight line, and elsewhere it is not."""
    problem = load_problem(name, [f"task.knots={knots}"])
    reported, answer = (plan(problem.grasp, problem.task.replace(between=each)) for each in ("report", None))
    least = []
    for each in (reported, answer):
        assert isinstance(each, Plan), each
        document = json.loads(json.dumps(outcome_document("", problem.grasp, each)))
        lines = len(document["execution"]["load"]["times_s"])
        fewer = between_knots(document, 4) if lines <= LINES else between_knots(with_fewer_lines(document, LINES), 1)
        finer = executed_otherwise(fewer, REPOSITORY, document["true"]["contact_model"], parts=1)
        assert finer.ended is None
        least.append(finer.margins.min())
    room = max(1e-3, 1e-3 * np.abs(answer.forces).max())
    assert least[0] < answer.task.margin - 2 * room  # so the test can fail
    assert least[1] >= answer.task.margin - room


def test_a_torque_is_judged_by_its_own_limit_and_not_by_the_force_of_a_slide() -> None:
    """On a hand of slides and hinges efforts have no unit in common: 20 N of one give a hinge no room."""
    moving = jaws(Sphere(radius=0.03), 0.03, 0.008, C_s=[1e-4, 1e-4, 1e-4, 0.5], C_q=[1e-4, 1e-4, 0.02] * 2)
    grasp = replace(moving, lambda_0=None)
    pushes = [Push(force=4.0, direction=(0, 1, 0), start=t, end=t + 0.5, profile="half-sine") for t in (0.0, 0.25)]
    task = Task(duration=1.0, knots=5, loads=[Gravity((0, 0, -9.81)), *pushes], limits=[SlipMargin(0.3)])
    free = plan(grasp, task)
    assert isinstance(free, Plan)
    hinge = 1.02 * float(np.abs(free.motion.torques[:, 2]).max())
    outcome = plan(grasp, task.replace(limits=[SlipMargin(0.3), JointTorque([20.0, 20.0, hinge] * 2)]))
    assert isinstance(outcome, Unknown)
    assert "between the knots: joint torque" in outcome.why
    assert "left_jaw" in outcome.why


def test_of_given_matrices_nothing_is_executed() -> None:
    problem = load_problem("pinch-soft")
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Plan)
    assert answer.executed is None
    assert "true" not in outcome_document("", problem.grasp, answer)


def test_what_it_costs_to_be_wrong_about_rolling_is_said() -> None:
    problem = load_problem("human-ball", ["task.knots=9"])
    answer = plan(problem.grasp, problem.timed)
    assert isinstance(answer, Plan)
    there = loads(answer.task, answer.time, answer.task.wrench)
    fixed = execute(answer.grasp, answer.time, answer.dz_r, there, contact_model="fixed")
    document = outcome_document("", problem.grasp, answer)["true"]
    assert document["contact_model"] == "rolling"
    assert document["pad_radius_m"] == pytest.approx([0.0075] * 5)
    assert document["worst_N_if_fixed"] == pytest.approx(fixed.margins.min(), abs=1e-6)
    assert document["worst_N_if_fixed"] < answer.margins.min() - 0.05


def test_check_judges_references_by_what_the_hand_does_with_them() -> None:
    problem = load_problem("human-ball", [ONCE, "task.knots=9"])
    promised = plan_of_start_posture(problem.grasp, problem.task)
    assert isinstance(promised, Plan)
    judged = judge_references(problem.grasp, problem.timed, References(promised.time, promised.dz_r, {}))
    assert judged.verdict == "fails"
    assert judged.executed is not None
    assert judged.margins.min() < 0


def test_a_motion_strays_where_it_is_wanted_in_vain() -> None:
    problem = load_problem("gripper-box")
    answer = plan(problem.grasp, problem.timed)
    assert isinstance(answer, Plan)
    assert answer.executed is not None
    start = answer.analysis
    walker = Walker(answer.task, start, Executor.of(start, answer.task), SOLVERS["clarabel"])
    walk = walker.executed(answer.dz_r, answer.forces, answer.executed)
    assert strayed(walk, walker).max() < 1e-5
    wanted = np.array(walker.wanted)
    beside = np.zeros_like(wanted)
    beside[:, 5] = np.linspace(0, 0.1, len(wanted))  # a turn that no synergy makes, as far as it is wanted
    walker.__dict__["wanted"] = wanted + beside
    assert strayed(walk, walker).max() > 0.5e-3


def test_a_no_that_motion_cannot_help_stays_a_proof() -> None:
    for name, overrides in (("barrett-ball-lift", []), ("human-ball", ["limits.normal_force=0.2 N"])):
        problem = load_problem(name, overrides)
        answer = plan(problem.grasp, problem.task)
        assert isinstance(answer, Infeasible), answer
        assert answer.certificate.verified
