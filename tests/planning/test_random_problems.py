"""Plans and the referee agree on random hand-like problems: verdict, largest margin, value of the goal."""

from __future__ import annotations

import numpy as np
import pytest
from named_goals import name_of
from random_tasks import USUAL, Shares, random_task_on_grasp

from synergrip.errors import SelfCheckError
from synergrip.grasps.contacts.kinds import KINDS
from synergrip.planning.outcome import Infeasible, Plan
from synergrip.planning.planning import plan
from synergrip.planning.stages import SLACKS
from synergrip.referee.judge import RefereeAnswer, referee
from synergrip.statics.analysis import analyse

CHUNK = 25
CHUNKS = 8
HARD = (1075, 1539)
"""Feasible; the forces of the first goal leave next to no room to the goal after it."""


def _value(outcome: Plan) -> float:
    """What the plan's own forces make of its goal, in the referee's units."""
    scale = outcome.analysis.response.scale
    if name_of(outcome.task.goal) == "effort":
        return float(np.sum((outcome.motion.forces * scale.force) ** 2))
    if name_of(outcome.task.goal) == "torque":
        return float(np.sum((outcome.motion.torques / scale.length) ** 2))
    if name_of(outcome.task.goal) == "peak_force":
        return float(outcome.motion.forces[:, [rows.start for rows in outcome.analysis.grasp.rows]].max())
    return float(outcome.margins.min())


def _same(found: float | None, expected: float | None, tolerance: float, more: float = 0.0) -> bool:
    if found is None or expected is None:
        return found is expected
    return abs(found - expected) <= tolerance * max(1.0, abs(expected)) + more


def _differences(outcome: Plan | Infeasible, answer: RefereeAnswer) -> list[str]:
    wrong = []
    if name_of(outcome.task.goal) == "margin" and not _same(outcome.largest_margin, answer.largest_margin, 1e-6):
        wrong.append(f"largest margin {outcome.largest_margin} against {answer.largest_margin}")
    if isinstance(outcome, Infeasible):
        if outcome.stage != "magnitude" or outcome.certificate is None or not outcome.certificate.verified:
            wrong.append(f"stage {outcome.stage}, certificate {outcome.certificate}")
        return wrong
    wrong += [f"check {check}" for check in outcome.checks if not check.passed]
    wrong += [f"certificate {d.certificate}" for d in outcome.decisions[-1:] if not d.optimal]
    given_up = 2 * max(SLACKS) * outcome.formulation.force_unit  # to the effort, in "margin" and "peak_force"
    if not _same(_value(outcome), answer.objective, 2e-6, given_up):
        wrong.append(f"{outcome.task.goal.name} {_value(outcome)} against {answer.objective}")
    return wrong


def _judge(seed: int, kinds: Shares = USUAL) -> tuple[RefereeAnswer, list[str]]:
    """Return the referee's answer and what is wrong with the plan, each line with its seed."""
    grasp, task = random_task_on_grasp(np.random.default_rng(seed), kinds)
    answer = referee(analyse(grasp), task)
    try:
        outcome = plan(grasp, task)
    except SelfCheckError as error:
        return answer, [f"seed {seed}: {error}; the referee says {answer.verdict}"]
    if outcome.verdict != answer.verdict or not isinstance(outcome, Plan | Infeasible):
        return answer, [f"seed {seed}: {outcome.verdict}, the referee says {answer}"]
    return answer, [f"seed {seed}: {difference}" for difference in _differences(outcome, answer)]


@pytest.mark.parametrize("chunk", range(CHUNKS))
def test_plan_agrees_with_the_referee(chunk: int) -> None:
    judged = [_judge(seed) for seed in range(chunk * CHUNK, (chunk + 1) * CHUNK)]
    wrong = [line for _, lines in judged for line in lines]
    assert not wrong, "\n".join(wrong)
    feasible = sum(answer.verdict == "feasible" for answer, _ in judged)
    assert CHUNK // 5 <= feasible <= CHUNK - CHUNK // 5, "the problems are to be about half feasible"


@pytest.mark.parametrize("name", sorted(KINDS.keys() - {*USUAL, "frictionless"}))
def test_plan_agrees_with_the_referee_on_every_other_kind_of_contact(name: str) -> None:
    """Hard fingers in half of the places."""
    judged = [_judge(seed, {"hard": 0.5, name: 0.5}) for seed in range(12)]
    wrong = [line for _, lines in judged for line in lines]
    assert not wrong, "\n".join(wrong)
    assert 3 <= sum(answer.verdict == "feasible" for answer, _ in judged) <= 17


@pytest.mark.parametrize("seed", HARD)
def test_plan_agrees_where_the_second_goal_has_hardly_any_room(seed: int) -> None:
    assert not _judge(seed)[1]
