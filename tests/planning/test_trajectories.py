"""Random trajectories with every limit, goal and tracking: answers judged anew at and between knots, and by CVXPY.

`python tests/judged_trajectories.py` judges longer ones, and more of them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from elastic_grasp import course
from goal_values import goal_value
from judged_trajectories import Judged, excesses, judged
from named_goals import name_of, names_of, weights_of
from random_trajectories import ORDERS, random_trajectory

from synergrip.conic.limits.actuator_effort import ActuatorEffort
from synergrip.conic.limits.elastic_motion import ElasticMotion
from synergrip.conic.limits.joint_range import JointRange
from synergrip.conic.limits.joint_torque import JointTorque
from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.limits.object_error import ObjectError
from synergrip.conic.limits.synergy_acceleration import SynergyAcceleration
from synergrip.conic.limits.synergy_rate import SynergyRate
from synergrip.conic.limits.synergy_reference import SynergyReference
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import frozen
from synergrip.planning.outcome import Infeasible, Plan
from synergrip.planning.planning import plan_of_start_posture as plan
from synergrip.planning.solvers import SOLVERS
from synergrip.problems.problem import load_problem
from synergrip.referee.judge import referee
from synergrip.statics.analysis import analyse
from synergrip.tasks.timed_task import TimedTask

COUNT, CHUNK = 40, 8
ONE_FOR_ALL: dict[str, Callable[[Grasp, float], Limit]] = {
    "limits.normal_force": lambda grasp, bound: NormalForce(-np.inf, bound),
    "limits.joint_torque": lambda grasp, bound: JointTorque(frozen(np.full(grasp.n_q, bound))),
    "limits.actuator_effort": lambda grasp, bound: ActuatorEffort(frozen(np.full(grasp.n_z, bound))),
    "limits.synergy_reference": lambda grasp, bound: SynergyReference(frozen(np.full(grasp.n_z, bound))),
    "limits.synergy_rate": lambda grasp, bound: SynergyRate(frozen(np.full(grasp.n_z, bound))),
    "limits.synergy_acceleration": lambda grasp, bound: SynergyAcceleration(frozen(np.full(grasp.n_z, bound))),
    "limits.joint_range": lambda grasp, bound: JointRange(
        frozen(np.zeros(grasp.n_q)), frozen(np.full(grasp.n_q, -bound)), frozen(np.full(grasp.n_q, bound))
    ),
    "limits.elastic_motion": lambda grasp, bound: ElasticMotion(bound),
    "limits.drift": lambda grasp, bound: ObjectError(bound),
}


@cache
def chunk_of(start: int) -> tuple[Judged, ...]:
    """Judge `CHUNK` trajectories of 50 to 80 knots."""
    knots = np.random.default_rng(0).integers(50, 81, COUNT)
    return tuple(judged(seed, int(knots[seed])) for seed in range(start, start + CHUNK))


@pytest.mark.parametrize("start", range(0, COUNT, CHUNK))
def test_every_answer_stands_at_every_knot_and_between(start: int) -> None:
    wrong = [f"seed {each.seed}, {each.verdict}: {line}" for each in chunk_of(start) for line in each.wrong]
    assert not wrong, "\n".join(wrong)
    assert {each.verdict for each in chunk_of(start)} == {"feasible", "infeasible"}


def test_the_trajectories_ask_for_everything_there_is() -> None:
    tasks = [random_trajectory(seed, 12)[1] for seed in range(COUNT)]
    keys = [{limit.key for limit in task.limits} for task in tasks]
    assert all(sum(name in each for each in keys) >= 3 for name in ONE_FOR_ALL)
    assert {names_of(task.goals) for task in tasks} == set(ORDERS)
    kinds = [(task.tracking, len(task.axes) < 6, task.target.kind) for task in tasks]
    for kind in (("rigid", False, "hold"), ("rigid", False, "modes"), ("rigid", False, "motion"),
                 ("rigid", True, "motion"), ("compliant", False, "motion"), ("compliant", True, "motion")):  # fmt: skip
        assert kinds.count(kind) >= 2, kind


@pytest.mark.parametrize("seed", [0, 8, 14, 24])
def test_the_judgement_and_the_limits_see_the_same_use(seed: int) -> None:
    """With a bound 1% above what the planner's own limit sees of a plan the judgement passes; 1% below it does not."""
    grasp, task = random_trajectory(seed, 50)
    outcome = plan(grasp, task)
    assert isinstance(outcome, Plan)
    found = course(grasp, task.times, outcome.motion.dz_r, task.wrench)
    for key, limit in ONE_FOR_ALL.items():
        peak = float(np.abs(limit(grasp, 1e9).usage(outcome.formulation, outcome.motion).value).max())
        for factor, passes in ((1.01, True), (0.99, False)):
            bound = replace(outcome, task=replace(task, limits=(limit(grasp, factor * peak),)))
            excess = excesses(bound, found)[key]
            assert (excess < 0) is passes, (key, factor)
            assert abs(excess) > 1e-3, (key, factor)


def test_least_references_leave_nothing_open_to_any_other_goal() -> None:
    """Forces, redundancy and rigid motion are all functions of the references: no further program is solved."""
    problem = load_problem("human-ball-near")
    outcome = plan(problem.grasp, problem.task)
    assert isinstance(outcome, Plan)
    assert outcome.formulation.n_v > outcome.alpha.shape[1]
    assert [decision.goal for decision in outcome.decisions] == ["least motion"]


def _coupled(task: TimedTask) -> bool:
    """Whether one knot of the program speaks of another."""
    keys, goals = {limit.key for limit in task.limits}, {name_of(task.goal), *weights_of(task.goals)}
    return bool(keys & {"limits.synergy_rate", "limits.synergy_acceleration"} or goals & {"travel", "smooth"})


def _compared(seed: int) -> bool:
    """Compare both formulations on one trajectory; return whether both found an optimum over coupled knots."""
    grasp, task = random_trajectory(seed, 10)
    if not _coupled(task):
        return False
    one, two = plan(grasp, task), plan(grasp, task, SOLVERS["cvxpy"])
    answer = referee(analyse(grasp), task)
    assert {two.verdict, answer.verdict} - {"unknown"} == {one.verdict}, seed
    if isinstance(one, Infeasible):
        assert one.certificate.verified
    if not (isinstance(one, Plan) and isinstance(two, Plan)):
        return False
    units = one.formulation.stated
    first, second = (
        goal_value(
            name_of(task.goal), grasp, task, course(grasp, task.times, each.motion.dz_r, task.wrench),
            (units.force, units.reference),
        )
        for each in (one, two)
    )  # fmt: skip
    # what a margin or a peak gives up to the next goal; a travel or intersample that is not needed at all
    rounding = {"margin": 1e-7 * units.force, "peak_force": 1e-7 * units.force, "travel": 1e-12, "smooth": 1e-12}
    assert first == pytest.approx(second, rel=1e-6, abs=rounding.get(name_of(task.goal), 0.0)), (seed, task.goal)
    return True


@pytest.mark.parametrize("start", range(0, 36, 12))
def test_the_optimum_over_coupled_knots_is_that_of_cvxpy(start: int) -> None:
    assert sum(_compared(seed) for seed in range(start, start + 12)) >= 4
