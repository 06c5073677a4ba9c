"""An interrupt along the motion ends it at once, and tells how far it had come where that is no plan."""

from __future__ import annotations

import pytest

from synergrip import Plan, Unknown, load_problem, plan
from synergrip.conic.program import Program
from synergrip.conic.question import Question
from synergrip.conic.solution import Settings, Solution
from synergrip.planning.outcome import Outcome
from synergrip.planning.solvers import SOLVERS

GROWN = ("gripper-box-draw", ("task.knots=9",))
"""What the linear model says no to, so that the motion is grown."""
SHORT = ("gripper-box", ("task.knots=11", "task.move[0].lift=40 mm"))
"""A motion that the hand cannot follow to its end."""
DIRECT = ("human-ball", ("task.knots=5",))


class Interrupted:
    """A solver that somebody interrupts at a program along the motion, and that counts what is asked of it."""

    def __init__(self, at: int) -> None:
        self.at, self.asked = at, 0

    def __call__(self, question: Question, program: Program, settings: Settings) -> Solution:
        self.asked += question.formulation.along_path
        if self.asked == self.at:
            raise KeyboardInterrupt
        return SOLVERS["clarabel"](question, program, settings)


def interrupted(name: str, overrides: tuple[str, ...], at: int) -> tuple[Outcome | str, int]:
    """Return the answer or what the interrupt tells, and how many programs along the motion were asked for."""
    problem, solver = load_problem(name, overrides), Interrupted(at)
    try:
        return plan(problem.grasp, problem.task, solver), solver.asked
    except KeyboardInterrupt as interrupt:
        return str(interrupt), solver.asked


@pytest.mark.parametrize(("name", "overrides"), [GROWN, SHORT, DIRECT])
def test_an_interrupt_at_any_program_ends_it_with_a_plan_or_with_how_far_it_had_come(
    name: str, overrides: tuple[str, ...]
) -> None:
    _, programs = interrupted(name, overrides, -1)
    assert programs > 1
    for at in range(1, programs + 1, max(1, programs // 12)):
        answer, asked = interrupted(name, overrides, at)
        assert asked == at, "programs were asked for after the interrupt"
        if isinstance(answer, Plan):
            assert answer.interrupted
            assert all(check.passed for check in answer.checks)
        else:
            assert not isinstance(answer, Unknown), answer
            assert "along the motion" in str(answer)


def test_what_the_best_path_so_far_misses_is_told() -> None:
    told, _ = interrupted(*DIRECT, at=1)
    assert isinstance(told, str)
    assert told.startswith("after 0 passes along the motion, at the true equilibrium limits are missed: slip margin -")


def test_until_when_a_motion_was_followed_is_told() -> None:
    told, _ = interrupted(*SHORT, at=8)
    assert isinstance(told, str)
    assert "passes along the motion, the object is where it is wanted until t = " in told
