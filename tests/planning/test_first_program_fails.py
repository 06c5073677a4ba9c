"""What becomes of a task whose first program has no verified optimum: proven another way, another plan, or unknown."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from synergrip.conic import relaxed
from synergrip.conic.certificate import judge_unbounded
from synergrip.conic.program import Program
from synergrip.conic.question import Question
from synergrip.conic.solution import Claim, Settings, Solution
from synergrip.errors import InputError
from synergrip.linalg import frozen
from synergrip.planning.outcome import Infeasible, Outcome, Plan, Unknown
from synergrip.planning.planning import plan_of_start_posture as plan
from synergrip.planning.solvers import SOLVERS
from synergrip.problems.problem import load_problem

TOO_MUCH = ("limits.margin=50 N", "limits.normal_force=20 N")
CLASHING = ("limits.normal_force=['10 N', '20 N']", "limits.joint_torque=0.001")


def planned(goal: str, spoil: dict[str, Callable[[Solution], Solution]], *overrides: str) -> Outcome:
    """Plan the tripod with a solver that spoils its answers to some goals."""

    def answer(question: Question, program: Program, settings: Settings) -> Solution:
        best = SOLVERS["clarabel"](question, program, settings)
        return spoil.get(question.goal.name, lambda same: same)(best)

    problem = load_problem("tripod", [f"goal={goal}", *overrides])
    return plan(problem.grasp, problem.task, answer)


def nothing(best: Solution) -> Solution:
    return replace(best, claim=Claim.NOTHING, x=frozen(0 * best.x), z=frozen(0 * best.z))


def wrong_ray(best: Solution) -> Solution:
    """A claim of infeasibility whose ray proves nothing."""
    return replace(best, claim=Claim.INFEASIBLE, z=frozen(np.ones_like(best.z)))


def unbounded(best: Solution) -> Solution:
    return replace(best, claim=Claim.UNBOUNDED)


@pytest.mark.parametrize("goal", ["effort", "peak_force"])
@pytest.mark.parametrize("spoil", [nothing, wrong_ray])
def test_a_margin_out_of_reach_is_proven_by_the_largest_there_is(
    goal: str, spoil: Callable[[Solution], Solution]
) -> None:
    outcome = planned(f"{{minimise='{goal}'}}", {NAMES[goal]: spoil}, *TOO_MUCH)
    assert isinstance(outcome, Infeasible)
    assert outcome.certificate.verified
    assert outcome.largest_margin is not None
    assert outcome.largest_margin < 50
    assert "the task asks for 50 N" in outcome.why


NAMES = {"effort": "least contact effort", "peak_force": "least peak normal force"}


def test_limits_that_clash_are_proven_by_the_largest_margin_without_an_answer() -> None:
    outcome = planned("{minimise='peak_force'}", {NAMES["peak_force"]: nothing}, *CLASHING)
    assert isinstance(outcome, Infeasible)
    assert (outcome.largest_margin, outcome.certificate.verified) == (None, True)
    assert [decision.goal for decision in outcome.decisions] == [NAMES["peak_force"], "largest margin"]


def test_without_the_least_peak_a_plan_of_least_effort_is_given() -> None:
    outcome, effort = (
        planned("{minimise='peak_force'}", {NAMES["peak_force"]: nothing}),
        planned("{minimise='effort'}", {}),
    )
    assert isinstance(outcome, Plan)
    assert isinstance(effort, Plan)
    assert any(note.startswith("'least peak normal force' was not verified") for note in outcome.notes)
    assert np.allclose(outcome.motion.forces, effort.motion.forces, rtol=1e-6, atol=1e-9)


@pytest.mark.parametrize("spoil", [nothing, wrong_ray])
def test_when_nothing_verifies_nothing_is_claimed(spoil: Callable[[Solution], Solution]) -> None:
    every = dict.fromkeys([*NAMES.values(), "largest margin"], spoil)
    for goal in ("{minimise='effort'}", "{minimise='peak_force'}", "{maximise='margin'}"):
        outcome = planned(goal, every)
        assert isinstance(outcome, Unknown)
        assert "nothing verifies" in outcome.why
        assert outcome.exit_code == 3


def test_a_shortfall_whose_multipliers_prove_nothing_is_unknown(monkeypatch: pytest.MonkeyPatch) -> None:
    """The largest margin stands, but not as a proof that more is out of reach."""
    limit = "limits.normal_force=20 N"
    best = planned("{maximise='margin'}", {}, limit)
    assert isinstance(best, Plan)
    assert best.largest_margin is not None
    more = f"limits.margin={best.largest_margin * (1 + 1e-6):.12g} N"
    assert isinstance(planned("{maximise='margin'}", {}, limit, more), Infeasible)
    spoil = {"largest margin": doubtful, "least contact effort": nothing}
    assert isinstance(planned("{maximise='margin'}", {"largest margin": doubtful}, limit, more), Infeasible)
    monkeypatch.setattr(relaxed, "polished", lambda _, ray: ray)
    outcome = planned("{maximise='margin'}", spoil, limit, more)
    assert isinstance(outcome, Unknown)
    assert "too close to the" in outcome.why


def doubtful(best: Solution) -> Solution:
    """An optimum that verifies as nearly the best only: its multipliers are a hair off, each in its own way."""
    return replace(best, z=frozen(best.z * (1 + 2e-5 * np.cos(np.arange(len(best.z))))))


def test_a_claim_that_nothing_bounds_the_margin_is_not_believed() -> None:
    outcome = planned("{maximise='margin'}", {"largest margin": unbounded}, "limits.normal_force=20 N")
    assert isinstance(outcome, Unknown)
    with pytest.raises(InputError, match="nothing bounds the largest margin"):
        planned("{maximise='margin'}", {}, "limits={}")


def test_a_far_limit_still_bounds_a_program() -> None:
    """The way to a larger margin stops at a limit, however far away."""
    problem = load_problem("tripod", ["goal={maximise='margin'}", "limits={normal_force='1e9 N'}"])
    outcome = plan(problem.grasp, problem.task)
    assert isinstance(outcome, Plan)
    program = outcome.decisions[0].program
    way = np.ones(len(program.q))
    assert not judge_unbounded(program, outcome.decisions[0].solution.x).verified
    assert not judge_unbounded(program, way).verified
    assert not judge_unbounded(program, 0 * way).verified


def test_the_largest_margin_is_asked_for_again_in_units_of_what_bounds_it() -> None:
    units: list[float] = []

    def answer(question: Question, program: Program, settings: Settings) -> Solution:
        units.append(question.formulation.force_unit)
        return nothing(SOLVERS["clarabel"](question, program, settings))

    problem = load_problem("tripod", ["goal.maximise=margin", "limits.normal_force=20000 N"])
    plan(problem.grasp, problem.task, answer)
    assert max(units) == pytest.approx(2e4)
