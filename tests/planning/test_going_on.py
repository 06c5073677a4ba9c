"""A no of the start posture is told as what it is, and is not the last word about knots after the first."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from second_execution import executed as executed_otherwise

from synergrip import Infeasible, Plan, load_problem, plan
from synergrip.planning.outcome import Outcome
from synergrip.planning.planning import plan_of_start_posture
from synergrip.problems.problem import Problem
from synergrip.reports.data.json_plan import outcome_document
from synergrip.reports.text.text_plan import verdict_lines

REPOSITORY = Path(__file__).resolve().parents[2]
ABOUT = "it is about the linear model at the start posture"


def capped(most: float, *overrides: str) -> tuple[Problem, Outcome]:
    """Return the answer to a hold that takes 11.89 N at its contacts at the start posture, with a cap on these."""
    cap = f"limits.normal_force={most} N"
    problem = load_problem("barrett-ball-hold", [cap, "task.knots=11", "task.between=report", *overrides])
    assert isinstance(plan_of_start_posture(problem.grasp, problem.task), Infeasible)
    return problem, plan(problem.grasp, problem.task)


def test_a_hold_that_the_start_posture_just_misses_at_a_later_knot_is_planned_along_the_motion() -> None:
    """The squeezed hand needs less than the start posture says."""
    problem, answer = capped(11.87)
    assert isinstance(answer, Plan), answer
    assert any("start posture alone says no: these limits allow a slip margin" in note for note in answer.notes)
    document = json.loads(json.dumps(outcome_document("", problem.grasp, answer)))
    other = executed_otherwise(document, REPOSITORY, document["true"]["contact_model"])
    assert other.margins.min() == pytest.approx(0.5, abs=2e-3)
    assert np.abs(answer.margins - other.margins).max() <= 1e-3


def test_where_no_plan_along_the_motion_is_found_the_no_stays_with_its_proof() -> None:
    problem, answer = capped(11.6)
    assert isinstance(answer, Infeasible), answer
    assert answer.certificate.verified
    assert [conflict.key for conflict in answer.conflicts] == ["limits.margin", "limits.normal_force"]
    (hint,) = answer.hints
    assert hint.startswith("this is proven of the linear model of the start posture")
    assert "no plan was found either: the hand that moves does not hold the object within its limits after t" in hint
    assert ABOUT in " ".join(verdict_lines(problem, answer))
    assert outcome_document("", problem.grasp, answer)["certificate"]["scope"] == "start"


def test_a_hold_that_is_infeasible_at_its_first_knot_stays_a_proof_about_that_posture() -> None:
    problem, answer = capped(8.0)
    assert isinstance(answer, Infeasible), answer
    assert answer.hints == ()
    assert ABOUT in " ".join(verdict_lines(problem, answer))


def test_planned_once_a_no_says_what_may_help() -> None:
    _, answer = capped(11.87, "task.linearise=once")
    assert isinstance(answer, Infeasible), answer
    assert any('task.linearise = "along"' in hint for hint in answer.hints)


def test_of_given_matrices_a_no_is_about_all_that_there_is() -> None:
    problem = load_problem("pinch-soft", ["limits.normal_force=0.1 N"])
    answer = plan(problem.grasp, problem.task)
    assert isinstance(answer, Infeasible), answer
    assert ABOUT not in " ".join(verdict_lines(problem, answer))
    assert "re-checked" in " ".join(verdict_lines(problem, answer))
