"""What pyramids cost: against a second formulation, in the right direction, and without a say in the verdict."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from named_goals import goals
from random_tasks import random_task_on_grasp
from scipy.optimize import linprog

from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.program import Program
from synergrip.conic.question import Question
from synergrip.conic.rows import Kind
from synergrip.conic.solution import Claim, Solution
from synergrip.conic.solvers import qpsolvers_
from synergrip.errors import InputError
from synergrip.linalg import frozen
from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan_of_start_posture as plan
from synergrip.planning.pyramids import Comparison, Request, compare, requested
from synergrip.problems.problem import load_problem


def planned(seeds: range, goal: str, kinds: tuple[str, ...] = ("hard", "soft")) -> Iterator[Plan]:
    """Yield the plans of random tasks with this goal."""
    for seed in seeds:
        grasp, task = random_task_on_grasp(np.random.default_rng(seed))
        if {contact.kind.name for contact in grasp.contacts} <= {*kinds}:
            outcome = plan(grasp, replace(task, goals=goals(goal)))
            if isinstance(outcome, Plan):
                yield outcome


def bundled(name: str, *overrides: str) -> Plan:
    problem = load_problem(name, list(overrides))
    outcome = plan(problem.grasp, problem.task)
    assert isinstance(outcome, Plan)
    return outcome


def margin_of_edges(cones: Plan, facets: int) -> float:
    """The largest margin [N] of hard-finger forces that are sums of the pyramids' edges, not bounded by facets."""
    question = Question(cones.formulation, cones.task.kept, LargestMargin())
    program = question.program()
    angles = 2 * np.pi * np.arange(facets) / facets
    edges = np.vstack([np.ones(facets), np.cos(angles), np.sin(angles)])
    A, n = program.A.toarray(), len(program.q)
    below, bounds, equal, sides, columns = [], [], [], [], []
    for block, rows in program.slices():
        for start in range(rows.start, rows.stop, block.dim):
            part = slice(start, start + block.dim)
            if block.kind is Kind.NONNEGATIVE:
                below.append(A[part])
                bounds.append(program.b[part])
            else:
                assert (block.kind, block.dim) == (Kind.SECOND_ORDER, 3)
                equal.append(A[part])
                sides.append(program.b[part])
                columns.append(edges)
    weights = np.zeros((3 * len(columns), facets * len(columns)))
    for i, column in enumerate(columns):
        weights[3 * i : 3 * i + 3, facets * i : facets * (i + 1)] = column
    count = weights.shape[1]
    found = linprog(
        np.r_[program.q, np.zeros(count)],
        A_ub=np.hstack([np.vstack(below), np.zeros((sum(len(b) for b in below), count))]), b_ub=np.concatenate(bounds),
        A_eq=np.hstack([np.vstack(equal), weights]), b_eq=np.concatenate(sides),
        bounds=[(None, None)] * n + [(0, None)] * count, method="highs",
    )  # fmt: skip
    assert found.success
    return -float(found.fun) * cones.formulation.force_unit


@pytest.mark.parametrize("facets", [4, 7])
def test_the_largest_margin_is_that_of_sums_of_edges(facets: int) -> None:
    compared = 0
    for cones in planned(range(60), "margin", ("hard",)):
        expected = margin_of_edges(cones, facets)
        comparison = compare(cones, Request(facets, "highs"))
        assert comparison.rejected is (expected < cones.task.margin)
        if comparison.pyramids is not None:
            compared += 1
            assert comparison.pyramids.largest_margin == pytest.approx(expected, rel=1e-6, abs=1e-6)
    assert compared >= 5


@pytest.mark.parametrize("goal", ["effort", "torque", "peak_force", "margin"])
def test_pyramids_never_gain_and_their_plans_keep_the_true_cones(goal: str) -> None:
    found = rejected = 0
    for cones in planned(range(30), goal):
        comparison = compare(cones, Request(4, "highs"))
        assert comparison.rejected is not None
        rejected += comparison.rejected
        assert (comparison.pyramids is None) == comparison.rejected
        if comparison.pyramids is None:
            assert (comparison.effort_ratio, comparison.peak_ratio, comparison.margin) == (None, None, None)
            continue
        found += 1
        assert comparison.pyramids.margins.min() >= cones.task.margin - 1e-6
        assert comparison.pyramids.verdict == "feasible"
        assert all(check.passed for check in comparison.pyramids.checks)
        losses = {
            "effort": comparison.effort_ratio, "torque": comparison.effort_ratio, "peak_force": comparison.peak_ratio,
            "margin": 1 + float(cones.margins.min()) - float(comparison.pyramids.largest_margin or 0.0),
        }  # fmt: skip
        assert losses[goal] is not None
        assert losses[goal] >= 1 - 1e-6
    assert found >= 5
    assert rejected >= 1


def test_a_margin_between_that_of_the_pyramids_and_that_of_the_cones_is_rejected() -> None:
    best = bundled("barrett-ball-hold", 'goal={maximise="margin"}')
    within = compare(best, Request(8, "highs")).pyramids
    assert within is not None
    assert within.largest_margin is not None
    assert best.largest_margin is not None
    assert within.largest_margin < best.largest_margin
    limits = 'limits={{margin="{} N", joint_torque="hand", normal_force=["0 N", "20 N"]}}'
    for margin, rejected in ((within.largest_margin - 1e-3, False), (within.largest_margin + 1e-3, True)):
        for goal in ('{minimise="effort"}', '{maximise="margin"}'):
            cones = bundled("barrett-ball-hold", f"goal={goal}", limits.format(margin))
            assert compare(cones, Request(8, "highs")).rejected is rejected


def test_with_many_facets_nothing_is_lost() -> None:
    for name in ("barrett-ball-hold", "pinch-soft"):
        cones = bundled(name, 'task.between="report"') if name.startswith("barrett") else bundled(name)
        comparison = compare(cones, Request(64))
        assert comparison.effort_ratio == pytest.approx(1, abs=5e-3)
        assert comparison.effort_ratio is not None
        assert comparison.effort_ratio >= 1 - 1e-9
        assert comparison.answer is not None
        assert comparison.answer.verified
        assert comparison.answer.gap < 1e-6


def test_the_effort_compared_is_the_one_that_the_goals_name() -> None:
    cones = bundled("barrett-ball-hold", 'goal={minimise="torque"}')
    comparison = compare(cones, Request(8))
    assert comparison.effort == "torque"
    assert comparison.pyramids is not None
    sums = [float((p.motion.torques**2).sum()) for p in (comparison.pyramids, cones)]
    assert comparison.effort_ratio == pytest.approx(sums[0] / sums[1], rel=1e-12)
    normals = [p.motion.forces[:, p.analysis.grasp.normal_rows].max() for p in (comparison.pyramids, cones)]
    assert comparison.peak_ratio == pytest.approx(normals[0] / normals[1], rel=1e-12)
    assert compare(replace(cones, task=replace(cones.task, goals=goals("actuator"))), Request(8)).effort == "actuator"


@pytest.mark.parametrize("seeds", [range(20), range(20, 40)])
def test_every_answer_is_judged_and_what_is_verified_and_optimal_is_the_certified_plan(seeds: range) -> None:
    for cones in planned(seeds, "effort"):
        comparison = compare(cones, Request(8, "osqp"))
        answer = comparison.answer
        assert answer is not None
        if comparison.rejected:
            assert not answer.verified
        else:
            assert answer.verified, answer
            assert answer.gap < 1e-6


def test_other_cones_leave_no_quadratic_program_but_their_price_is_known() -> None:
    cones = bundled("barrett-ball-hold", 'limits.elastic_motion="2 mm"')
    comparison = compare(cones, Request(8))
    assert comparison.other_cones == ("limits.elastic_motion",)
    assert (comparison.answer, comparison.time_ratio) == (None, None)
    assert comparison.effort_ratio is not None
    assert comparison.effort_ratio > 1.01


def lying(program: Program, x: np.ndarray) -> Solution:
    return Solution(Claim.OPTIMAL, frozen(x), frozen(np.zeros(len(program.b))), "liar", "solved", 1, 0.0)


def test_a_friction_reserve_is_a_friction_cone_too() -> None:
    cones = bundled("barrett-ball-hold", "limits.safety_factor=1.1")
    comparison = compare(cones, Request(8))
    assert comparison.other_cones == ()
    assert comparison.answer is not None
    assert comparison.answer.verified
    assert comparison.pyramids is not None
    factors = [friction_factors(p) for p in (cones, comparison.pyramids)]
    assert min(factors) >= 1.1 - 1e-6
    assert comparison.effort_ratio is not None
    assert comparison.effort_ratio > 1.1


def friction_factors(outcome: Plan) -> float:
    """The smallest mu n / ||(t, o)|| of all contacts and knots."""
    grasp, forces = outcome.analysis.grasp, outcome.motion.forces
    pairs = zip(grasp.contacts, grasp.rows, strict=True)
    return min(
        float((c.friction * forces[:, rows][:, 0] / np.linalg.norm(forces[:, rows][:, 1:], axis=1)).min())
        for c, rows in pairs
    )


@pytest.mark.parametrize("size", [3.0, 1e300, np.nan, np.inf, -1e-3])
def test_a_liar_is_not_verified_and_changes_no_figure(size: float, monkeypatch: pytest.MonkeyPatch) -> None:
    cones = bundled("barrett-ball-hold")
    honest = compare(cones, Request(8))
    monkeypatch.setattr(qpsolvers_, "solve", lambda program, *_: lying(program, np.full(len(program.q), size)))
    comparison = compare(cones, Request(8))
    assert figures(comparison) == figures(honest)
    assert comparison.answer is not None
    assert comparison.answer.status == "solved"
    assert not comparison.answer.verified
    assert honest.answer is not None
    assert honest.answer.verified


def figures(comparison: Comparison) -> tuple[object, ...]:
    return comparison.rejected, comparison.effort_ratio, comparison.peak_ratio, comparison.margin


def test_one_that_has_given_up_is_heard_all_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its status decides nothing either way: good references under a bad word are good references."""
    cones = bundled("barrett-ball-hold")
    solve = qpsolvers_.solve
    monkeypatch.setattr(
        qpsolvers_, "solve", lambda *a: replace(solve(*a), claim=Claim.NOTHING, status="maximum iterations reached")
    )
    answer = compare(cones, Request(8)).answer
    assert answer is not None
    assert (answer.status, answer.verified) == ("maximum iterations reached", True)


def test_requests_are_checked_all_at_once() -> None:
    assert requested(8, "osqp") == Request(8, "osqp")
    for facets in (3, 64):
        assert requested(facets).facets == facets
    with pytest.raises(InputError) as caught:
        requested(2, "osqq")
    keys = [issue.key for issue in caught.value.issues]
    assert keys == ["--pyramids", "--qp-solver"]
    assert "3 to 64 facets" in str(caught.value)
    assert "did you mean 'osqp'" in str(caught.value)
    with pytest.raises(InputError, match="got 65"):
        requested(65)
