"""Every limit, goal and solver of the registries against the second formulation: row by row, to rounding."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from named_goals import goals
from random_formulations import KNOTS, LIMITS, random_formulation

from synergrip.conic.build import build
from synergrip.conic.decide import decide
from synergrip.conic.formulation import Formulation
from synergrip.conic.goals.goal import Goal
from synergrip.conic.goals.kept_scalar import KeptScalar
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.goals.registry import GOALS
from synergrip.conic.intersample import Looks
from synergrip.conic.limits.friction_cone import FrictionCone
from synergrip.conic.limits.joint_range import JointRange
from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.question import Question
from synergrip.conic.rows import Item
from synergrip.linalg import Array, frozen
from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan
from synergrip.planning.solvers import SOLVERS
from synergrip.problems.problem import load_problem
from synergrip.referee.formulas import write_goal, write_limit
from synergrip.referee.judge import _written
from synergrip.referee.model import Cone, Model

SCALAR = 0.37
"""Of a goal that has one, in the units of its rows."""


def value_of(expression: object) -> Array:
    """The value of an expression, or of an array."""
    return np.asarray(getattr(expression, "value", expression), dtype=float)


def model_at(formulation: Formulation, v: Array) -> Model:
    """The second formulation, with the references of unknowns v."""
    looks = Looks(formulation.times, formulation.wrench, formulation.target)
    return _written(formulation, looks, formulation.reference.at(v))


def rows_of(cones: tuple[Cone, ...]) -> dict[Item, Array]:
    """What must lie in a cone, (K, d), by what it is about."""
    found: dict[Item, Array] = {}
    for cone in cones:
        head = value_of(cone.head)
        if cone.tail is None:
            found |= {item: column[:, None] for item, column in zip(cone.items, head.T, strict=True)}
        else:
            found[cone.items[0]] = np.column_stack([head.reshape(-1, 1), value_of(cone.tail)])
    return found


def compared(formulation: Formulation, limits: list[Limit], goal: Goal, seed: int) -> tuple[dict[Item, Array], ...]:
    """The rows of the program and those of the second formulation at random unknowns; the goal is worth the same."""
    v, scalar = np.random.default_rng(seed).normal(size=(KNOTS, formulation.n_v)), SCALAR if goal.has_scalar else None
    program, model = build(formulation, limits, goal), model_at(formulation, v)
    x = program.solution(v, scalar)
    slack, direct = program.b - program.A @ x, {}
    for block, rows in program.slices():
        parts = slack[rows].reshape(block.knots, len(block.items), block.dim)
        direct |= {item: parts[:, i] for i, item in enumerate(block.items)}
    written = write_goal(model, goal)
    if written.scalar is not None:
        written.scalar.value = scalar
    cost = float(value_of(written.cost)) / (1.0 if goal.has_scalar else formulation.divisor)
    assert program.objective(x) == pytest.approx(cost, rel=1e-9)
    cones = [cone for limit in limits for cone in write_limit(model, limit)]
    return direct, rows_of((*cones, *written.cones))


def agree(direct: dict[Item, Array], second: dict[Item, Array]) -> None:
    """Assert the same rows, about the same, in the same units; the axes behind a norm may be turned."""
    assert direct.keys() == second.keys()
    for item, found in second.items():
        size = max(float(np.abs(direct[item]).max()), 1.0)
        np.testing.assert_allclose(found[:, 0], direct[item][:, 0], rtol=0, atol=1e-9 * size, err_msg=str(item))
        norms = [np.linalg.norm(rows[:, 1:], axis=1) for rows in (found, direct[item])]
        np.testing.assert_allclose(*norms, rtol=0, atol=1e-9 * size, err_msg=str(item))


@pytest.mark.parametrize("name", LIMITS)
@pytest.mark.parametrize("seed", range(3))
def test_rows_of_a_limit_are_those_of_its_formula(name: str, seed: int) -> None:
    formulation = random_formulation(seed)[1]
    limit = LIMITS[name](formulation.response.grasp)
    direct, second = compared(formulation, [limit], LeastEffort(), seed)
    assert second
    agree(direct, second)


@pytest.mark.parametrize("name", GOALS)
@pytest.mark.parametrize("seed", range(3))
def test_a_goal_is_worth_what_its_formula_says(name: str, seed: int) -> None:
    formulation = random_formulation(seed)[1]
    n_q = formulation.response.grasp.n_q
    start, half = np.full(n_q, 0.1), np.linspace(0.4, 0.7, n_q)
    ranges = JointRange(frozen(start), frozen(start - half), frozen(start + 1.1 * half))
    (goal,) = goals(name, ranges=ranges)
    direct, second = compared(formulation, [], goal, seed)
    assert bool(second) is goal.has_scalar
    agree(direct, second)


SCALARS = [name for name, goal in GOALS.items() if goal.has_scalar]


@pytest.mark.parametrize("name", SCALARS)
@pytest.mark.parametrize("seed", range(3))
def test_a_scalar_that_is_kept_is_kept_in_the_second_formulation(name: str, seed: int) -> None:
    """Whatever the units were in which it was found."""
    formulation = random_formulation(seed)[1]
    kept = KeptScalar(GOALS[name], SCALAR, replace(formulation.units, force=2.3))
    agree(*compared(formulation, [kept], LeastEffort(), seed))


@pytest.mark.parametrize("name", SCALARS)
def test_both_solvers_keep_a_scalar_by_its_own_rows(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """As those of a goal that has no limit to be kept by."""
    problem, effort = load_problem("pinch-soft"), []
    goals = [GOALS[name], LeastEffort()]
    for kept in (GOALS[name].keeps, lambda best, slack: None):
        monkeypatch.setattr(type(GOALS[name]), "keeps", lambda _, best, slack, kept=kept: kept(best, slack))
        for solver in SOLVERS.values():
            found = plan(problem.grasp, problem.task.replace(goals=goals), solver)
            assert isinstance(found, Plan)
            assert len(found.decisions) == 2
            effort.append(np.sum(found.forces**2))
    assert effort == pytest.approx([effort[0]] * len(effort), rel=1e-5)


@pytest.mark.parametrize("name", SOLVERS)
def test_a_solver_finds_the_optimum_or_the_proof(name: str) -> None:
    """With room enough and with none; what it says is verified, and its optimum is Clarabel's."""
    kinds = set()
    for seed in range(4):
        formulation = random_formulation(seed)[1]
        for margin, most in ((0.0, 0.01), (-300.0, 300.0)):
            unit = formulation.force_unit
            limits = (FrictionCone(margin * unit), NormalForce(-np.inf, most * unit))
            question = Question(formulation, limits, LeastEffort())
            found, expected = (
                decide("effort", question.program(), partial(SOLVERS[each], question)) for each in (name, "clarabel")
            )
            assert found.certificate.verified, (seed, most, found.solution.status)
            assert found.certificate.kind == expected.certificate.kind
            kinds.add(found.certificate.kind)
            if found.certificate.kind == "optimal":
                values = [each.program.objective(each.solution.x) for each in (found, expected)]
                assert values[0] == pytest.approx(values[1], rel=1e-6)
    assert kinds == {"optimal", "infeasible"}
