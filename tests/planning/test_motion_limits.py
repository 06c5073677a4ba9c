"""Limits on motion and compliant tracking: both formulations agree, every proof verifies, what is asked is kept."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from named_goals import name_of
from random_tasks import moving_random_task

from synergrip.conic.limits.elastic_motion import ElasticMotion
from synergrip.conic.limits.friction_reserve import FrictionReserve
from synergrip.conic.limits.joint_range import JointRange
from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.object_error import AXES, ObjectError, axis_weights
from synergrip.conic.limits.synergy_acceleration import SynergyAcceleration
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import frozen
from synergrip.planning.outcome import Infeasible, Plan
from synergrip.planning.planning import plan
from synergrip.referee.judge import referee
from synergrip.statics.analysis import analyse
from synergrip.tasks.timed_task import Target, TimedTask


def moving_task(seed: int) -> tuple[Grasp, TimedTask]:
    """A random task over several knots, with limits on motion and, for two seeds in three, other tracking."""
    rng = np.random.default_rng(seed)
    grasp, task = moving_random_task(rng)
    task = replace(task, limits=(*task.limits, *_motion_limits(rng, grasp)))
    if seed % 3 == 0:
        return grasp, task
    axes = tuple(axis for axis in AXES if rng.uniform() < 0.6) or AXES
    drift = float(rng.choice([1e-3, 1e-2])) if rng.uniform() < 0.7 else None
    if seed % 3 == 1:
        return grasp, replace(task, axes=axes, drift=drift)
    motion = frozen(1e-3 * np.outer(np.linspace(0, 1, 5), rng.normal(size=6) * [1, 1, 1, 20, 20, 20]))
    tolerance = float(10 ** rng.uniform(-4, -2.5))
    return grasp, replace(
        task, target=Target("motion", motion), tracking="compliant", tolerance=tolerance, axes=axes, drift=drift
    )


def _motion_limits(rng: np.random.Generator, grasp: Grasp) -> tuple[Limit, ...]:
    start = rng.uniform(-0.5, 0.5, grasp.n_q)
    room = 10 ** rng.uniform(-1.5, 0, (2, grasp.n_q))
    room[:, rng.uniform(size=grasp.n_q) < 0.2] = np.inf
    chosen: list[Limit] = [
        JointRange(frozen(start), frozen(start - room[0]), frozen(start + room[1])),
        SynergyAcceleration(frozen(10 ** rng.uniform(0, 1.5, grasp.n_z))),
        FrictionReserve(ratios=frozen(rng.uniform(0.5, 1.0, grasp.n_c))),
        ElasticMotion(float(10 ** rng.uniform(-3.5, -2))),
        ObjectError(float(10 ** rng.uniform(-2.5, -1.5))),
    ]
    return tuple(limit for limit in chosen if rng.uniform() < 0.5)


@pytest.mark.parametrize("start", range(0, 60, 15))
def test_both_formulations_agree_on_limits_of_motion(start: int) -> None:
    verdicts, compared = [], 0
    for seed in range(start, start + 15):
        grasp, task = moving_task(seed)
        outcome, answer = plan(grasp, task), referee(analyse(grasp), task)
        if answer.verdict == "unknown":
            continue  # the referee cannot tell: too close
        assert outcome.verdict == answer.verdict, (seed, outcome, answer.status)
        verdicts.append(outcome.verdict)
        if isinstance(outcome, Infeasible):
            assert outcome.certificate.verified
        elif isinstance(outcome, Plan):
            assert all(decision.certificate.verified for decision in outcome.decisions)
            if answer.objective is not None:  # CVXPY found it feasible, but did not finish its own optimum
                _judge(outcome, answer.objective)
                compared += 1
    assert {"feasible", "infeasible"} <= set(verdicts)
    assert compared >= len([verdict for verdict in verdicts if verdict == "feasible"]) - 1


def _judge(outcome: Plan, objective: float) -> None:
    """Compare the plan with what was asked, by formulas of its own."""
    task, scale, spaces = outcome.task, outcome.analysis.response.scale, outcome.analysis.spaces
    size = max(abs(objective), 1e-3)
    goal = name_of(task.goal)
    if goal in ("effort", "torque"):
        scaled = outcome.motion.forces * scale.force if goal == "effort" else outcome.motion.torques / scale.length
        assert (scaled**2).sum() == pytest.approx(objective, rel=1e-5, abs=1e-6 * size)
    elif goal == "margin":
        assert outcome.margins.min() == pytest.approx(objective, abs=1e-6 * max(size, np.abs(outcome.alpha).max()))
    rigid = outcome.beta @ spaces.Gamma_ucs.T
    reached = outcome.motion.du if task.tracking == "compliant" else rigid
    wanted = task.target.values if task.target.kind == "motion" else task.target.values @ spaces.Gamma_ucs.T
    error = np.linalg.norm((reached - wanted) @ axis_weights(task.axes, scale.length).T, axis=1).max()
    assert error <= task.tolerance * (1 + 1e-6) + 1e-9
    rest = [axis for axis in AXES if axis not in task.axes]
    if rest and task.drift is not None:
        drift = np.linalg.norm(reached @ axis_weights(rest, scale.length).T, axis=1).max()
        assert drift <= task.drift * (1 + 1e-6)
