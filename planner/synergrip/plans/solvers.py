"""Who answers questions: a solver's name on the command line made into a function. A new solver is listed here."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from synergrip.conic.decide import Decision, decide
from synergrip.conic.goals.least_motion import LeastMotion
from synergrip.conic.program import Program
from synergrip.conic.relaxed import proven
from synergrip.conic.solution import Settings, Solution
from synergrip.conic.solvers import clarabel_
from synergrip.errors import InputError, one_of
from synergrip.plans.question import Question

Answerer = Callable[[Question, Program, Settings], Solution]


def _clarabel(question: Question, program: Program, settings: Settings) -> Solution:
    return proven(clarabel_.solve(program, settings), program, clarabel_.solve, settings)


def _cvxpy(question: Question, program: Program, settings: Settings) -> Solution:
    from synergrip.plans.referee import judge as referee

    return referee.solve(question, program, settings)


SOLVERS: dict[str, Answerer] = {"clarabel": _clarabel, "cvxpy": _cvxpy}
""""cvxpy" writes the question down by itself, independently of the program's rows."""


def answerer(name: str) -> Answerer:
    """Return the solver of that name or raise an `InputError` that lists them."""
    if name not in SOLVERS:
        raise InputError.at("--solver", one_of(name, SOLVERS))
    return SOLVERS[name]


def ask(question: Question, solver: Answerer) -> Decision:
    """Build the program of a question, have it solved and verified; looked at less closely when nothing verifies."""
    decision = _decided(question, solver)
    if decision.optimal or decision.infeasible or not isinstance(question.goal, LeastMotion):
        return decision
    softer = question.goal.softer
    second = _decided(replace(question, goal=softer), solver) if softer is not None else decision
    return second if second.optimal else decision


def _decided(question: Question, solver: Answerer) -> Decision:
    return decide(question.goal.name, question.program(), lambda program, settings: solver(question, program, settings))
