"""What a long solve tells while it runs, on standard error."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from synergrip.conic.program import Program
    from synergrip.conic.solution import Settings, Solution
    from synergrip.plans.question import Question
    from synergrip.plans.solvers import Answerer

LONG = 50_000
"""Rows of a program from which on it takes seconds."""


def telling(answer: Answerer) -> Answerer:
    """Return the same solver, which says what it is about to solve when that takes long."""

    def told(question: Question, program: Program, settings: Settings) -> Solution:
        rows, unknowns = program.A.shape
        if rows >= LONG:
            what = f"{question.goal.name}, {program.knots} knots: {unknowns} variables, {rows} rows"
            print(f"solving  {what} ...", file=sys.stderr, flush=True)
        return answer(question, program, settings)

    return told
