"""One question to a solver: limits and a goal over a situation. Here a solver's name becomes a function."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from synergrip.conic.build import build
from synergrip.conic.decide import Decision, decide
from synergrip.conic.goals.goal import Goal
from synergrip.conic.limits.limit import Limit
from synergrip.conic.program import Program
from synergrip.conic.situation import Situation
from synergrip.conic.solution import Settings, Solution
from synergrip.conic.solvers import clarabel_
from synergrip.errors import InputError, one_of


@dataclass(frozen=True)
class Question:
    """What is asked, in the terms in which a program is built."""

    situation: Situation
    limits: tuple[Limit, ...]
    goal: Goal

    def program(self) -> Program:
        """Return the program of this question."""
        return build(self.situation, self.limits, self.goal)


Answerer = Callable[[Question, Program, Settings], Solution]


def _clarabel(question: Question, program: Program, settings: Settings) -> Solution:
    return clarabel_.solve(program, settings)


def _cvxpy(question: Question, program: Program, settings: Settings) -> Solution:
    from synergrip.plans import referee

    return referee.solve(question, program, settings)


SOLVERS: dict[str, Answerer] = {"clarabel": _clarabel, "cvxpy": _cvxpy}
"""Name on the command line -> who answers. "cvxpy" writes the question down by itself, independently of `build`."""


def answerer(name: str) -> Answerer:
    """Return the solver of that name or raise an `InputError` that lists them."""
    if name not in SOLVERS:
        raise InputError.at("--solver", one_of(name, SOLVERS))
    return SOLVERS[name]


def ask(situation: Situation, limits: Sequence[Limit], goal: Goal, solver: Answerer) -> Decision:
    """Build the program of a question, have it solved and verified."""
    question = Question(situation, tuple(limits), goal)
    return decide(goal.name, question.program(), lambda program, settings: solver(question, program, settings))
