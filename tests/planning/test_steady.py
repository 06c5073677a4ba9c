"""The goal "steady": the next goal is the best that the same forces allow, by a program of the test's own."""

from __future__ import annotations

from dataclasses import replace

import cvxpy as cp
import numpy as np
import pytest
from named_goals import goals
from random_tasks import moving_random_task
from scipy import sparse

from synergrip.conic.limits.joint_range import JointRange
from synergrip.conic.limits.joint_torque import JointTorque
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.linalg import Array
from synergrip.planning import stages
from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan_of_start_posture as plan
from synergrip.planning.solvers import SOLVERS
from synergrip.planning.stages import LOOSE
from synergrip.problems.problem import load_problem
from synergrip.statics.motion import forces_at_start

KNOTS = 41


def set_down(order: str) -> Plan:
    """The plan of the glass that is set down, with another order of goals."""
    problem = load_problem("human-glass-set-down", [f"goal.order={order}"])
    outcome = plan(problem.grasp, problem.task)
    assert isinstance(outcome, Plan)
    assert all(decision.certificate.verified for decision in outcome.decisions)
    return outcome


def least_references(found: Plan) -> float:
    """Return the least sum of squared references among plans whose forces change as those of a plan do.

    Limits have as much room for rounding as the planner gives them once goals have fixed a part of the plan.
    """
    analysis, task, unit = found.analysis, found.task, found.formulation.force_unit
    response, grasp, coordinates = analysis.response, analysis.grasp, analysis.coordinates
    n_alpha, n_beta, n_gamma = coordinates.dimensions
    of_alpha, _, of_gamma = np.split(np.linalg.inv(coordinates.M), [n_alpha, n_alpha + n_beta], axis=1)
    more, ones = 1 + LOOSE, np.ones((KNOTS, 1))
    z = found.motion.dz_r + unit * ones @ cp.Variable((1, n_alpha)) @ of_alpha.T
    z = z + 0.1 * cp.Variable((KNOTS, n_gamma)) @ of_gamma.T
    force = forces_at_start(response) + (task.wrench - grasp.w_0) @ response.dlambda_dw.T + z @ response.dlambda_dzr.T
    asked = []
    for contact, rows in zip(grasp.contacts, grasp.rows, strict=True):
        at = force[:, rows] / unit
        head = contact.friction * at[:, 0] - task.margin * (1 - LOOSE) / unit
        asked.append(cp.SOC(head, at[:, 1:], axis=1))
    for limit in task.limits:
        if isinstance(limit, NormalForce):
            asked.append(force[:, grasp.normal_rows] / limit.upper <= more)
        elif isinstance(limit, JointTorque):
            asked.append(cp.abs(force @ grasp.J @ np.diag(1 / limit.limit)) <= more)
        else:
            assert isinstance(limit, JointRange)
            middle, half = (limit.upper + limit.lower) / 2, (limit.upper - limit.lower) / 2
            known = limit.start + (task.wrench - grasp.w_0) @ response.dq_dw.T - middle
            asked.append(cp.abs((known + z @ response.dq_dzr.T) @ np.diag(1 / half)) <= more)
    problem = cp.Problem(cp.Minimize(cp.sum_squares(z)), asked)
    # to a tenth of what is compared; rows are in the units of their limits already, and not brought to one size again
    problem.solve(solver="CLARABEL", tol_gap_abs=1e-7, tol_gap_rel=1e-7, tol_feas=1e-8, equilibrate_enable=False)
    assert problem.status == "optimal"
    return float(problem.value)


def changes(forces: Array) -> Array:
    """Changes of forces from knot to knot."""
    return np.diff(forces, axis=0)


def test_the_next_goal_is_as_good_as_the_same_changes_of_force_allow(monkeypatch: pytest.MonkeyPatch) -> None:
    found = set_down('["steady", "references"]')
    value = float((found.motion.dz_r**2).sum())
    assert value == pytest.approx(least_references(found), rel=1e-6)

    def directions_times_courses(squares: object, knots: int, n_v: int) -> sparse.csc_matrix:
        """All directions, constant in time: the only product that holds what no change of force sees."""
        return sparse.csc_matrix(sparse.kron(sparse.csr_array(np.ones((knots, 1))), np.eye(n_v)))

    monkeypatch.setattr(stages, "free_basis", directions_times_courses)
    product = set_down('["steady", "references"]')
    np.testing.assert_allclose(changes(product.motion.forces), changes(found.motion.forces), atol=1e-6)
    assert float((product.motion.dz_r**2).sum()) > value * (1 + 1e-3)


def test_a_steady_grip_changes_less_and_the_goals_after_it_keep_its_changes() -> None:
    first, second, other = (set_down(order) for order in ('["steady"]', '["steady", "references"]', '["effort"]'))
    total = [float((changes(each.motion.forces) ** 2).sum()) for each in (first, second, other)]
    assert total[0] < 0.9 * total[2]
    np.testing.assert_allclose(changes(second.motion.forces), changes(first.motion.forces), atol=1e-6)


@pytest.mark.parametrize("solver", ["clarabel", "cvxpy"])
@pytest.mark.parametrize("order", [("steady",), ("steady", "torque"), ("peak_force", "steady"), ("weighted",)])
@pytest.mark.parametrize("seed", [2, 3, 5])
def test_both_formulations_agree_about_it(seed: int, order: tuple[str, ...], solver: str) -> None:
    rng = np.random.default_rng(seed)
    grasp, task = moving_random_task(rng)
    weights = {"effort": 0.3, "steady": 2.0} if order == ("weighted",) else {}
    task = replace(task, goals=goals(*order, weights=weights), margin=0.0)
    outcome = plan(grasp, task, SOLVERS[solver])
    assert isinstance(outcome, Plan), outcome
    scale, h = outcome.analysis.response.scale, np.diff(task.times)[:, None]
    forces = outcome.motion.forces * scale.force
    steady = float((changes(forces) ** 2 / h).sum())
    expected = plan(grasp, task)
    assert isinstance(expected, Plan)
    other = float((changes(expected.motion.forces * scale.force) ** 2 / h).sum())
    assert steady == pytest.approx(other, rel=1e-5)
    step = plan(grasp, replace(task, goals=goals("effort")))
    assert isinstance(step, Plan)
    if order[0] == "steady":
        assert steady <= float((changes(step.motion.forces * scale.force) ** 2 / h).sum()) * (1 + 1e-6)
