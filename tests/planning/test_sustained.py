"""What motors carry for long: against integrals, closed forms, and a program that knows nothing of this one."""

from __future__ import annotations

from dataclasses import replace

import cvxpy as cp
import numpy as np
import pytest
from random_formulations import random_formulation
from random_tasks import hand_like_grasp
from small_grasps import pinch

import synergrip as sg
from synergrip.conic.build import build
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import frozen
from synergrip.planning.outcome import Infeasible, Plan
from synergrip.planning.planning import plan
from synergrip.statics.analysis import Analysis, analyse
from synergrip.statics.motion import forces_at_start, forward
from synergrip.tasks.timed_task import Target, TimedTask, still

TIMES = frozen([0.0, 0.3, 0.5, 1.1])
MEAN = np.zeros((4, 4))
"""tau' MEAN tau is the mean of the squares of what is straight between values tau at TIMES."""
for _k, _h in enumerate(np.diff(TIMES)):
    MEAN[_k : _k + 2, _k : _k + 2] += _h / (6 * TIMES[-1]) * np.array([[2, 1], [1, 2]])


@pytest.mark.parametrize("seed", range(4))
def test_rows_and_usage_are_the_integral_of_squares(seed: int) -> None:
    rng, formulation = random_formulation(seed)
    limit = sg.SustainedEffort(0.7)
    program = build(formulation, [limit], LeastEffort())
    v = rng.normal(size=(4, formulation.n_v))
    slack, n_z = program.b - program.A @ program.solution(v), formulation.response.grasp.n_z
    cones = slack.reshape(n_z, -1)
    whole = formulation.effort.at(v)
    fine = np.linspace(0, TIMES[-1], 20_001)
    squares = np.column_stack([np.interp(fine, TIMES, column) for column in whole.T]) ** 2
    roots = np.sqrt(np.trapezoid(squares, fine, axis=0) / TIMES[-1])
    np.testing.assert_array_equal(cones[:, 0], 1.0)
    np.testing.assert_allclose(np.linalg.norm(cones[:, 1:], axis=1) * 0.7, roots, rtol=1e-6)
    response = formulation.response
    motion = forward(response, TIMES, formulation.reference.at(v), formulation.wrench)
    usage = limit.usage(formulation, motion)
    np.testing.assert_allclose(usage.value[-1], roots, rtol=1e-6)
    assert np.all(np.diff(usage.value, axis=0) >= 0)
    np.testing.assert_array_equal(usage.value[0], 0.0)


def held(*loads: float, **limits: float) -> TimedTask:
    """A pinch that holds a load [N] on each knot, one second apart; every finger presses with load / (2 mu)."""
    times = frozen(np.arange(len(loads), dtype=float))
    wrench = np.zeros((len(loads), 6))
    wrench[:, 2] = -np.array(loads)
    parts = tuple(getattr(sg, name)(value) for name, value in limits.items())
    return TimedTask(times, frozen(wrench), still(times), 0.0, parts, (LeastEffort(),))


HELD = {
    "one knot": ((3.0,), 3.0),
    "the same all the time": ((3.0, 3.0, 3.0), 3.0),
    "a load that comes: the last one": ((1.0, 2.0, 3.0), 3.0),
    "a load that goes: the mean": ((3.0, 1.0), np.sqrt((9 + 3 + 1) / 3)),
}


@pytest.mark.parametrize("loads", HELD)
def test_a_hold_counts_its_mean_and_its_last_value(loads: str) -> None:
    """Both fingers are closed by one actuator: sigma = 2 n = load / mu."""
    given, counts = HELD[loads]
    least = counts / 0.5
    made = plan(pinch(0.5), held(*given, SustainedEffort=1.0001 * least))
    assert isinstance(made, Plan)
    np.testing.assert_allclose(made.usages["sustained effort"].value[-1], least, rtol=1e-6)
    refused = plan(pinch(0.5), held(*given, SustainedEffort=0.9999 * least))
    assert isinstance(refused, Infeasible)
    assert refused.certificate.verified
    assert "limits.sustained_effort" in {conflict.key for conflict in refused.conflicts}
    (repair,) = (each for each in refused.repairs if each.key == "limits.sustained_effort")
    assert repair.cause == "effort"
    assert repair.to == pytest.approx(least, rel=1e-3)


def least_sustained(analysis: Analysis, task: TimedTask) -> float:
    """The least number that bounds the root of the mean square of every joint's torque, from the maps alone."""
    response, grasp = analysis.response, analysis.grasp
    n_alpha, n_beta, _ = analysis.coordinates.dimensions
    z, most = cp.Variable((4, grasp.n_z)), cp.Variable()
    known = forces_at_start(response) + (task.wrench - grasp.w_0) @ response.dlambda_dw.T
    force = known + z @ response.dlambda_dzr.T
    torque, root = force @ grasp.J, np.linalg.cholesky(MEAN).T
    kept = [z @ analysis.coordinates.M[n_alpha : n_alpha + n_beta].T == task.target.values]
    for contact, rows in zip(grasp.contacts, grasp.rows, strict=True):
        own = force[:, rows]
        weights = [1.0, 1.0]
        if contact.n_rows == 4:
            weights.append(contact.friction / contact.kind.spin_friction)
        kept.append(cp.norm(own[:, 1:] @ np.diag(weights), axis=1) <= contact.friction * own[:, 0])
    kept += [cp.norm(root @ torque[:, j]) <= most for j in range(grasp.n_q)]
    problem = cp.Problem(cp.Minimize(most), kept)
    problem.solve(solver="CLARABEL")
    return float(most.value) if problem.status == "optimal" else np.inf


def moving(rng: np.random.Generator) -> tuple[Grasp, Analysis, TimedTask, float]:
    """A grasp, a task that moves the object under loads that change, and the least sustained torque of it."""
    while True:
        grasp = hand_like_grasp(rng)
        analysis = analyse(grasp)
        beta = 1e-4 * rng.normal(size=(4, analysis.spaces.Gamma_ucs.shape[1]))
        beta[0] = 0.0
        wrench = rng.normal(size=(4, 6)) * [1, 1, 1, 0.01, 0.01, 0.01]
        if not beta.size or analysis.response.free.size:
            continue
        task = TimedTask(TIMES, frozen(wrench), Target("modes", frozen(beta)), 0.0, (), (LeastEffort(),))
        least = least_sustained(analysis, task)
        if np.isfinite(least):
            return grasp, analysis, task, least


@pytest.mark.parametrize("seed", range(6))
def test_a_moved_object_may_take_as_much_as_an_independent_program_finds(seed: int) -> None:
    grasp, _, task, least = moving(np.random.default_rng([43, seed]))
    for solver in ("clarabel", "cvxpy") if seed < 2 else ("clarabel",):
        made = plan(grasp, replace(task, limits=(sg.SustainedTorque(1.0001 * least),)), solver)  # type: ignore[arg-type]
        assert isinstance(made, Plan)
        np.testing.assert_array_less(np.einsum("ij,ik,jk->k", MEAN, *[made.motion.torques] * 2), (1.00011 * least) ** 2)
        assert plan(grasp, replace(task, limits=(sg.SustainedTorque(0.9999 * least),)), solver).verdict == "infeasible"  # type: ignore[arg-type]


def test_a_hand_keeps_it_along_the_motion() -> None:
    problem = sg.load_problem("gripper-box", ["task.knots=11", "limits.sustained_effort=0.55"])
    made = sg.plan(problem.grasp, problem.task)
    assert isinstance(made, sg.Plan)
    assert made.executed is not None
    usage = made.usages["sustained effort"]
    assert usage.violation <= 1e-6
    h, sigma = np.diff(made.time)[:, None], made.motion.efforts
    squares = (h * (sigma[1:] ** 2 + sigma[1:] * sigma[:-1] + sigma[:-1] ** 2) / 3).sum(axis=0) / made.time[-1]
    np.testing.assert_allclose(usage.value[-1], np.sqrt(squares), rtol=1e-6)
    assert np.abs(sigma).max() > 0.55 > np.sqrt(squares.max())
