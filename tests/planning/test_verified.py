"""The physical check of a plan: each statement fails when what it states is broken."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.errors import SelfCheckError
from synergrip.linalg import frozen
from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan_of_start_posture as plan
from synergrip.planning.stages import Stage
from synergrip.planning.verified import identities, verified_plan
from synergrip.problems.problem import load_problem
from synergrip.tasks.timed_task import TimedTask


def tripod() -> Plan:
    problem = load_problem("tripod")
    outcome = plan(problem.grasp, problem.task)
    assert isinstance(outcome, Plan)
    return outcome


@pytest.mark.parametrize(
    ("name", "size", "broken"),
    [
        ("wrench", 1e-3, {"equilibrium", "internal force", "forces from alpha"}),
        ("forces", 1e-3, {"equilibrium", "internal force", "forces from alpha"}),
        ("dz_r", 1e-5, {"references", "forward maps"}),
    ],
)
def test_a_broken_motion_fails(name: str, size: float, broken: set[str]) -> None:
    outcome = tripod()
    wanted = (outcome.alpha, outcome.beta, outcome.gamma)
    assert all(check.passed for check in identities(outcome.analysis, outcome.motion, wanted))
    array = np.array(getattr(outcome.motion, name))
    array[5, 0] += size
    bad = replace(outcome.motion, **{name: frozen(array)})
    assert {check.name for check in identities(outcome.analysis, bad, wanted) if not check.passed} == broken


def test_a_plan_that_breaks_a_limit_never_gets_out() -> None:
    outcome = tripod()
    task: TimedTask = replace(outcome.task, margin=outcome.margins.min() + 0.1)
    with pytest.raises(SelfCheckError, match="slip margin"):
        verified_plan(task, outcome.analysis, Stage(outcome.formulation, (), LeastEffort(), outcome.decisions), None)


@pytest.mark.parametrize(("share", "passes"), [(0.5e-6, True), (3e-6, False)])
def test_the_plans_own_tolerance_is_a_millionth_of_what_a_contact_carries(share: float, passes: bool) -> None:
    outcome = tripod()
    k, i = np.unravel_index(outcome.margins.argmin(), outcome.margins.shape)
    rows = outcome.analysis.grasp.rows[i]
    carried = max(float(np.abs(outcome.motion.forces[k, rows]).max()), outcome.formulation.load_size)
    asked = replace(outcome.task, margin=float(outcome.margins.min()) + share * carried)
    stage = Stage(outcome.formulation, (), LeastEffort(), outcome.decisions)
    if passes:
        assert verified_plan(asked, outcome.analysis, stage, None).verdict == "feasible"
    else:
        with pytest.raises(SelfCheckError, match="slip margin"):
            verified_plan(asked, outcome.analysis, stage, None)
