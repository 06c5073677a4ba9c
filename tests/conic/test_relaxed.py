"""By how much a program's cones must be widened at least, and the proofs that its multipliers are."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy import sparse

from synergrip.conic.certificate import judge_infeasible
from synergrip.conic.program import Block, Program
from synergrip.conic.relaxed import proven, relaxed
from synergrip.conic.rows import Kind, items_of
from synergrip.conic.solution import Claim, Settings
from synergrip.conic.solvers import clarabel_
from synergrip.linalg import frozen
from synergrip.planning.outcome import Infeasible
from synergrip.planning.planning import plan_of_start_posture as plan
from synergrip.problems.problem import load_problem


def program_of(A: list[list[float]], b: list[float], *cones: tuple[Kind, int]) -> Program:
    blocks = tuple(Block("test", kind, dim, items_of(["item"]), 0, 1) for kind, dim in cones)
    n = len(A[0])
    return Program(
        sparse.csc_matrix((n, n)), frozen(np.zeros(n)), sparse.csc_matrix(A), frozen(b), blocks, 1, n,
        frozen(np.full(n, 1e6)),
    )  # fmt: skip


BOUND = Kind.NONNEGATIVE, 1


@pytest.mark.parametrize(("gap", "least"), [(2.0, 1.0), (0.5, 0.25), (-1.0, -0.5), (-5.0, -1.0)])
def test_bounds_that_are_apart_are_widened_by_half_of_it(gap: float, least: float) -> None:
    """From x >= 0 and x <= -gap: each by gap / 2; with room, down to -1 and no further."""
    found = clarabel_.solve(relaxed(program_of([[-1.0], [1.0]], [0.0, -gap], BOUND, BOUND)), Settings())
    assert found.x[-1] == pytest.approx(least, abs=1e-7)


def test_a_ball_beside_a_plane_is_widened_in_its_head_and_an_equality_is_not() -> None:
    """From ``||(x, y)|| <= 1``, ``x >= 4`` and ``y = 0``: the radius grows by 1.5 and the plane comes by as much."""
    rows = [[0.0, 0.0], [-1.0, 0.0], [0.0, -1.0], [-1.0, 0.0], [0.0, 1.0]]
    program = program_of(rows, [1.0, 0.0, 0.0, -4.0, 0.0], (Kind.SECOND_ORDER, 3), BOUND, (Kind.ZERO, 1))
    found = clarabel_.solve(relaxed(program), Settings())
    assert found.x == pytest.approx([2.5, 0.0, 1.5], abs=1e-6)
    assert judge_infeasible(program, found.z[:-1]).verified


def test_a_ray_that_proves_nothing_is_replaced_by_one_that_does() -> None:
    program = program_of([[-1.0], [1.0]], [0.0, -1.0], BOUND, BOUND)
    blunt = replace(clarabel_.solve(program, Settings()), z=frozen([1.0, 1.0001]))  # leaves 1e-4 of x, up to 1e6
    assert blunt.claim is Claim.INFEASIBLE
    assert not judge_infeasible(program, blunt.z).verified
    sharp = proven(blunt, program, clarabel_.solve, Settings())
    assert judge_infeasible(program, sharp.z).verified
    assert sharp.iterations > blunt.iterations
    assert proven(sharp, program, clarabel_.solve, Settings()) is sharp


def test_no_program_that_has_an_answer_is_proven_to_have_none() -> None:
    program = program_of([[-1.0], [1.0]], [0.0, 1.0], BOUND, BOUND)
    liar = replace(clarabel_.solve(program, Settings()), claim=Claim.INFEASIBLE)
    assert not judge_infeasible(program, proven(liar, program, clarabel_.solve, Settings()).z).verified


def test_a_sag_that_nothing_counters_is_proven_without_any_limit() -> None:
    """A push across two fingers, which no synergy moves sideways: only the tolerance forbids it."""
    push = "task.push=[{force='3 N', direction='y', start='0.4 s', end='0.8 s', profile='half-sine'}]"
    for tolerance, verdict in (("0.1 mm", "infeasible"), ("0.3 mm", "feasible")):
        overrides = [push, "limits={}", "goal={minimise='effort'}", f"task.tolerance='{tolerance}'"]
        problem = load_problem("gripper-peg", overrides)
        outcome = plan(problem.grasp, problem.task)
        assert outcome.verdict == verdict
        if isinstance(outcome, Infeasible):
            assert {conflict.key for conflict in outcome.conflicts} == {"task.tolerance"}
