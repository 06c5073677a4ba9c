"""What a long solve tells while it runs, on standard error."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import TYPE_CHECKING

from synergrip.cli.beside import over, tell

if TYPE_CHECKING:
    from synergrip.conic.program import Program
    from synergrip.conic.question import Question
    from synergrip.conic.solution import Settings, Solution
    from synergrip.planning.solvers import Answerer

LONG = 50_000
"""Rows of a program from which on it takes seconds."""
PATIENCE = 2.0
"""[s] after which every program is told, however small."""
_begun = 0.0


def telling(answer: Answerer) -> Answerer:
    """Return the same solver, which says what it is about to solve when that, or what came before, takes long."""
    from synergrip.conic.decide import ALONG, ATTEMPTS
    from synergrip.problems.in_short import many

    begun = time.monotonic()

    def told(question: Question, program: Program, settings: Settings) -> Solution:
        rows, unknowns = program.A.shape
        if rows >= LONG or time.monotonic() - begun > PATIENCE:
            along = question.formulation.along_path
            where, attempts = (" along the motion", ALONG) if along else ("", ATTEMPTS)
            size = f"{many(unknowns, 'variable')}, {many(rows, 'row')}"
            what = f"{question.goal.name}{where}, {many(program.knots, 'knot')}: {size}"
            attempt = attempts.index(settings) + 1 if settings in attempts else 1
            again = f", attempt {attempt} of {len(attempts)}" if attempt > 1 else ""
            tell(f"solving  {what}{again} ...")
        return answer(question, program, settings)

    return told


def tell_what_takes_long() -> None:
    """Tell on standard error what else takes seconds, as it begins; what is short by itself when it is late."""
    import logging

    from synergrip.log import LONG

    global _begun
    _begun = time.monotonic()

    class Teller(logging.Handler):
        def emit(self, record: logging.LogRecord) -> None:
            if record.levelno >= logging.INFO or time.monotonic() - _begun > PATIENCE:
                tell(f"{record.getMessage()} ...")

    if not LONG.handlers:
        LONG.addHandler(Teller())
        LONG.setLevel(logging.DEBUG)


def counted(done: int, of: int, what: str) -> None:
    """Tell on a terminal how much of a long work is done, on one line that is written over and wiped at the end."""
    over(f"{done} of {of} {what}" if done < of else "")


TENTHS = 10
"""Parts of a long work that are told one by one where they cannot be written over."""


def shares() -> Callable[[str, float], None]:
    """Return what tells how far a work is: on a terminal on a line that is written over, else by tenths.

    A tenth that is done sooner after the line before than `PATIENCE` is not told.
    """
    tenths, last = dict[str, int](), [0.0]

    def told(what: str, share: float) -> None:
        if sys.stderr.isatty():
            over(f"{what} ... {share:.0%}" if share < 1 else "")
            return
        tenth, now = int(TENTHS * share + 1e-9), time.monotonic()
        begins = what not in tenths
        if begins or (tenths[what] < tenth < TENTHS and now - last[0] >= PATIENCE):
            tell(f"{what} ..." + ("" if begins else f" {tenth / TENTHS:.0%}"))
            tenths[what], last[0] = tenth, now

    return told
