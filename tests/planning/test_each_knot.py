"""Goals one after the other on a grasp that changes from knot to knot, whoever solves."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from random_formulations import KNOTS, random_formulation

from synergrip.conic.formulate import formulate
from synergrip.conic.formulation import Formulation
from synergrip.conic.goals.goal import Goal
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.goals.least_motion import LeastMotion
from synergrip.conic.goals.steady_forces import SteadyForces
from synergrip.conic.limits.friction_cone import FrictionCone
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.question import Question
from synergrip.linalg import frozen
from synergrip.planning.solvers import SOLVERS, ask
from synergrip.planning.stages import Stage, through
from synergrip.statics.analysis import analyse

GOALS = {
    "effort": LeastEffort(),
    "steady": SteadyForces(),
    "references": LeastMotion(),
    "travel": LeastMotion("rates"),
}


def changing(seed: int) -> Formulation:
    """A task on a grasp that gets stiffer, and whose synergies get stronger, from knot to knot."""
    once = random_formulation(seed)[1]
    grasp = once.response.grasp
    stretch = np.linspace(0.1, 0.3, grasp.n_z)
    each = [
        analyse(replace(grasp, S=frozen(grasp.S * (1 + k * stretch)), C_s=frozen(grasp.C_s * (1 + 0.2 * k))))
        for k in range(KNOTS)
    ]
    return formulate(
        once.response, once.spaces, once.coordinates, times=once.times, wrench=0.1 * once.wrench,
        beta=once.beta.constant, units=once.units, redundancy=True, each=each,
    )  # fmt: skip


def staged(formulation: Formulation, goals: list[Goal], solver: str) -> Stage:
    """The stage after some goals, none of them with limits that cannot be kept."""
    first, *rest = goals
    limits = (NormalForce(-np.inf, 500.0),)
    answered = ask(Question(formulation, limits, first), SOLVERS[solver])
    assert answered.decision.optimal
    stage = Stage(answered.question.formulation, limits, first, (answered.decision,))
    return through(stage, rest, (), SOLVERS[solver])


@pytest.mark.parametrize("order", ["effort references", "steady references", "travel effort", "steady travel effort"])
@pytest.mark.parametrize("seed", [0, 1, 2])
def test_each_goal_keeps_what_those_before_it_reached(seed: int, order: str) -> None:
    formulation = changing(seed)
    goals = [GOALS[name] for name in order.split()]
    direct, second = (staged(formulation, goals, solver) for solver in ("clarabel", "cvxpy"))
    assert all(decision.certificate.verified for stage in (direct, second) for decision in stage.decisions)
    references = [stage.formulation.reference.at(stage.v) for stage in (direct, second)]
    inverse = np.array([at.coordinates.M for at in formulation.each or ()])
    size = formulation.column_units(formulation.units)
    for k, goal in enumerate(goals):
        best = staged(formulation, goals[: k + 1], "clarabel")
        worth = [
            goal.objective(formulation).squared((inverse @ z[:, :, None])[:, :, 0][:, _order(formulation)] / size)
            for z in (*references, best.formulation.reference.at(best.v))
        ]
        # plans whose value is within a gap g of the best lie within its root of each other, and so do later values
        close = 1e-5 if k == 0 else 1e-4
        assert worth[0] == pytest.approx(worth[2], rel=1e-5, abs=1e-8)
        assert worth[1] == pytest.approx(worth[2], rel=close, abs=1e-8)


def _order(formulation: Formulation) -> list[int]:
    """Which coordinates (alpha, beta, gamma) the unknowns are, in their order: alpha and gamma."""
    n_alpha, n_beta, n_gamma = formulation.coordinates.dimensions
    return [*range(n_alpha), *range(n_alpha + n_beta, n_alpha + n_beta + n_gamma)]


def test_cones_of_a_changing_grasp_are_kept_at_every_knot() -> None:
    found = 0
    for seed in range(6):
        formulation = changing(seed)
        question = Question(formulation, (FrictionCone(0.1), NormalForce(0.0, 500.0)), LeastEffort())
        answers = [ask(question, SOLVERS[solver]) for solver in ("clarabel", "cvxpy")]
        kinds = {answer.decision.certificate.kind for answer in answers}
        assert len(kinds) == 1
        if kinds != {"optimal"}:
            continue
        found += 1
        answer = answers[0]
        forces = answer.question.formulation.force.at(answer.v)
        grasp = formulation.response.grasp  # the contacts are the same at all knots
        for contact, rows in zip(grasp.contacts, grasp.rows, strict=True):
            assert contact.slip_margin(forces[:, rows]).min() >= 0.1 - 1e-6
    assert found
