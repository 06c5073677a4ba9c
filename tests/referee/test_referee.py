"""The second formulation: its answers carry certificates of the program it never saw, and equal the direct path's."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import pytest
from named_goals import goals
from random_grasps import random_grasp
from random_tasks import hand_like_grasp, random_task_on_grasp
from scipy import sparse

from synergrip.conic.decide import decide, judge
from synergrip.conic.formulate import formulate
from synergrip.conic.formulation import Formulation
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.goals.least_peak import LeastPeak
from synergrip.conic.goals.least_reconfiguration import LeastReconfiguration
from synergrip.conic.limits.actuator_effort import ActuatorEffort
from synergrip.conic.limits.friction_cone import FrictionCone
from synergrip.conic.limits.joint_torque import JointTorque
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.limits.synergy_rate import SynergyRate
from synergrip.conic.limits.synergy_reference import SynergyReference
from synergrip.conic.question import Question
from synergrip.conic.solution import Claim, Settings
from synergrip.conic.solvers import clarabel_
from synergrip.errors import InputError, SelfCheckError, SynergripError
from synergrip.grasps.contacts.hard_finger import HardFinger
from synergrip.linalg import frozen
from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan
from synergrip.planning.solvers import SOLVERS
from synergrip.planning.stages import LOOSE
from synergrip.referee.judge import referee, solve
from synergrip.statics.analysis import analyse
from synergrip.tasks.scaling import units_of
from synergrip.tasks.timed_task import TimedTask, still
from synergrip.tasks.tracking import rigid_coordinates

REDUNDANT = (89, 130, 146, 213, 296)
"""Seeds whose reference limits force the plan to use its redundancy."""


def _task(seed: int) -> tuple[Formulation, TimedTask]:
    grasp, task = random_task_on_grasp(np.random.default_rng(seed))
    analysis = analyse(grasp)
    return formulate(
        analysis.response, analysis.spaces, analysis.coordinates, times=task.times, wrench=task.wrench,
        beta=rigid_coordinates(analysis, task), units=units_of(analysis, task), redundancy=task.watches_references,
    ), task  # fmt: skip


def _questions(seeds: range) -> Iterator[tuple[int, Question]]:
    for seed in seeds:
        formulation, task = _task(seed)
        yield seed, Question(formulation, task.limits, LargestMargin())
        for goal in (LeastEffort(), LeastEffort("torque"), LeastPeak()):
            yield seed, Question(formulation, (FrictionCone(task.margin), *task.limits), goal)


@pytest.mark.parametrize("start", [0, 10, 20])
def test_certificates_verify_and_both_paths_agree(start: int) -> None:
    kinds = set()
    for seed, question in _questions(range(start, start + 10)):
        program = question.program()
        direct, second = clarabel_.solve(program, Settings()), solve(question, program, Settings())
        certificate = judge(program, second)
        assert certificate.verified, (seed, question.goal.name, second.status, certificate)
        assert certificate.kind == judge(program, direct).kind, (seed, question.goal.name)
        kinds.add(certificate.kind)
        if certificate.kind == "infeasible":
            continue
        assert program.objective(second.x) == pytest.approx(program.objective(direct.x), rel=1e-7, abs=1e-7), seed
        if isinstance(question.goal, LeastEffort):  # strictly convex in alpha
            n = question.formulation.coordinates.dimensions[0]
            alpha, expected = program.unknowns(second.x)[:, :n], program.unknowns(direct.x)[:, :n]
            assert np.abs(alpha - expected).max() <= 1e-5 * np.abs(expected).max(), seed
    assert kinds == {"optimal", "infeasible"}


@pytest.mark.parametrize("seed", REDUNDANT)
def test_redundancy_is_settled_alike(seed: int) -> None:
    outcome = plan(*random_task_on_grasp(np.random.default_rng(seed)))
    assert isinstance(outcome, Plan)
    formulation = outcome.formulation
    v = np.hstack([outcome.alpha / formulation.force_unit, np.zeros_like(outcome.gamma)])
    n_alpha = outcome.alpha.shape[1]
    open_ = sparse.kron(sparse.eye_array(len(v)), np.eye(formulation.n_v)[:, n_alpha:], format="csc")
    formulation = formulation.around(v, sparse.csc_matrix(open_))
    watching = [limit for limit in outcome.task.limits if isinstance(limit, SynergyReference | SynergyRate)]
    loosened = tuple(limit.loosened(LOOSE) for limit in watching)
    question = Question(formulation, loosened, LeastReconfiguration())
    program = question.program()
    direct = decide("redundancy", program, clarabel_.solve).solution
    second = decide("redundancy", program, lambda program, settings: solve(question, program, settings)).solution
    assert judge(program, second).verified
    assert judge(program, second).kind == "optimal"
    assert np.abs(program.unknowns(direct.x)).max() > 1e-4
    np.testing.assert_allclose(second.x, direct.x, atol=1e-6)


@pytest.mark.parametrize("seed", [*range(40, 46), *REDUNDANT[:3]])
def test_a_plan_by_cvxpy_is_the_plan_by_clarabel(seed: int) -> None:
    grasp, task = random_task_on_grasp(np.random.default_rng(seed))
    direct, second = plan(grasp, task), plan(grasp, task, SOLVERS["cvxpy"])
    assert direct.verdict == second.verdict
    assert all("CVXPY" in decision.solution.solver for decision in second.decisions)


def test_every_limit_has_an_effect() -> None:
    """With and without each limit, the referee and the program move together."""
    formulation, _ = _task(8)
    grasp = formulation.response.grasp
    tight = [
        NormalForce(0.05, 2.0 * formulation.force_unit),
        JointTorque(frozen(np.full(grasp.n_q, 0.02 * formulation.force_unit))),
        ActuatorEffort(frozen(np.full(grasp.n_z, 0.02 * formulation.force_unit))),
    ]
    for limit in tight:
        for goal in (LargestMargin(), LeastPeak()):
            question = Question(formulation, (limit, NormalForce(-np.inf, 20.0 * formulation.force_unit)), goal)
            program = question.program()
            direct, second = clarabel_.solve(program, Settings()), solve(question, program, Settings())
            assert judge(program, second).verified, limit
            assert judge(program, second).kind == judge(program, direct).kind


def test_rates_are_compared_between_uneven_knots() -> None:
    seed = next(s for s in range(100) if len(_task(s)[0].times) >= 3 and _task(s)[0].coordinates.dimensions[0] >= 3)
    formulation, _ = _task(seed)
    grasp = formulation.response.grasp
    for rate in (1e-3, 0.1, 10.0):
        limits = (
            SynergyRate(frozen(np.full(grasp.n_z, rate))),
            SynergyReference(frozen(np.full(grasp.n_z, 5.0))),
            NormalForce(0.0, 10 * formulation.force_unit),
        )
        question = Question(formulation, limits, LargestMargin())
        program = question.program()
        direct, second = clarabel_.solve(program, Settings()), solve(question, program, Settings())
        assert judge(program, second).verified, rate
        assert judge(program, second).kind == judge(program, direct).kind, rate


def test_two_limits_under_one_key_keep_their_multipliers_apart() -> None:
    formulation, task = _task(0)
    question = Question(formulation, (FrictionCone(0.1), FrictionCone(task.margin), *task.limits), LeastEffort())
    program = question.program()
    assert judge(program, solve(question, program, Settings())).verified


def test_frictionless_contacts_are_known() -> None:
    grasp = random_grasp(np.random.default_rng(3), kinds=["hard", "soft", "frictionless", "hard"], n_q=8, n_z=5)
    times = frozen([0.5])
    limits = (NormalForce(upper=20.0), JointTorque(frozen(np.full(8, 2.0))))
    task = TimedTask(times, frozen([[0, 0, -1.0, 0, 0, 0]]), still(times), 0.0, limits, goals("margin"))
    outcome, second = plan(grasp, task), plan(grasp, task, SOLVERS["cvxpy"])
    assert outcome.verdict == second.verdict == referee(analyse(grasp), task).verdict


@dataclass(frozen=True)
class _Strange:
    name: str = "strange"
    key: str = "limits.strange"


class _Sticky(HardFinger):
    name = "sticky"


def test_what_has_no_formula_is_refused_by_name() -> None:
    formulation, task = _task(0)
    program = Question(formulation, task.limits, LargestMargin()).program()
    for question in (Question(formulation, (_Strange(),), LargestMargin()), Question(formulation, (), _Strange())):
        with pytest.raises(SynergripError, match="_Strange") as refused:
            solve(question, program, Settings())
        assert isinstance(refused.value, InputError)


def test_a_contact_kind_without_formula_is_refused_by_name() -> None:
    grasp, task = random_task_on_grasp(np.random.default_rng(0))
    analysis = analyse(grasp)
    odd = replace(grasp, contacts=(replace(grasp.contacts[0], kind=_Sticky(friction=0.5)), *grasp.contacts[1:]))
    with pytest.raises(SynergripError, match="contact kind _Sticky"):
        referee(replace(analysis, response=replace(analysis.response, grasp=odd)), task)


def test_a_program_of_another_question_is_refused() -> None:
    formulation, task = _task(0)
    program = Question(formulation, task.limits[:1], LargestMargin()).program()
    with pytest.raises(SelfCheckError, match=r"limits\.joint_torque"):
        solve(Question(formulation, task.limits, LargestMargin()), program, Settings())


def test_an_unbounded_margin_is_claimed_as_such() -> None:
    grasp = hand_like_grasp(np.random.default_rng(0))
    times = frozen([0.5])
    task = TimedTask(times, frozen(np.zeros((1, 6))), still(times), 0.0, (), goals("margin"))
    analysis = analyse(grasp)
    formulation = formulate(
        analysis.response, analysis.spaces, analysis.coordinates, times=times, wrench=task.wrench,
        beta=rigid_coordinates(analysis, task), units=units_of(analysis, task), redundancy=False,
    )  # fmt: skip
    question = Question(formulation, (), LargestMargin())
    assert solve(question, question.program(), Settings()).claim is Claim.UNBOUNDED
