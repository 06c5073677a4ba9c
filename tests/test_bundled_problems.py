"""Every bundled problem gives the answer that its [expect] table states."""

from __future__ import annotations

import pytest

from synergrip.grasps.plausible import grasp_doubts
from synergrip.planning.outcome import Infeasible, Plan
from synergrip.planning.planning import plan
from synergrip.problems.finding import bundled_problems
from synergrip.problems.problem import Problem, load_problem
from synergrip.statics.analysis import analyse
from synergrip.tasks.plausible import task_doubts

NAMES = bundled_problems()


def test_the_bundled_problems_are_found() -> None:
    assert {"barrett-ball-hold", "barrett-ball-lift", "table2-hard-motors", "pinch-soft", "tripod"} <= set(NAMES)


def judge_plan(problem: Problem, outcome: Plan) -> None:
    expect = problem.file.expect
    assert expect is not None
    tolerance = expect.tolerance or 1e-6
    assert all(check.passed for check in outcome.checks)
    assert all(decision.certificate.verified for decision in outcome.decisions)
    if expect.margin_worst_N is not None:
        assert outcome.margins.min() == pytest.approx(expect.margin_worst_N, rel=tolerance, abs=tolerance)
    if expect.peak_normal_N is not None:
        normals = outcome.motion.forces[:, [rows.start for rows in outcome.analysis.grasp.rows]]
        assert normals.max() == pytest.approx(expect.peak_normal_N, rel=tolerance)


@pytest.mark.parametrize("name", NAMES)
def test_answer_is_as_expected(name: str) -> None:
    problem = load_problem(name)
    expect = problem.file.expect
    assert expect is not None
    assert expect.verdict is not None
    if expect.dims is not None:
        assert analyse(problem.grasp).spaces.dimensions == expect.dims
        assert not analyse(problem.grasp).spaces.ambiguous
    assert not [*grasp_doubts(problem.grasp), *task_doubts(problem.task, problem.timed, problem.grasp)]
    outcome = plan(problem.grasp, problem.task)
    assert outcome.verdict == expect.verdict
    if isinstance(outcome, Plan):
        judge_plan(problem, outcome)
    else:
        assert isinstance(outcome, Infeasible)
        assert outcome.stage == expect.stage
        assert outcome.certificate.verified


def test_table_two() -> None:
    rows = {"hard-motors": (3, 0, 1), "hard-joints": (3, 2, 3), "soft-motors": (4, 0, 0), "soft-joints": (6, 1, 1)}
    for name, dimensions in rows.items():
        assert analyse(load_problem(f"table2-{name}").grasp).spaces.dimensions == dimensions
