"""The method that suits a program's structure, and Clarabel where none does or what it finds does not verify."""

from __future__ import annotations

from dataclasses import replace

from synergrip.conic.decide import judge, rank_of
from synergrip.conic.program import Program
from synergrip.conic.solution import Claim, Settings, Solution
from synergrip.conic.solvers import clarabel_, some_cones

FEWEST = 100
"""Knots below which no structure is looked for, and no method for it loaded."""


def solve(program: Program, settings: Settings) -> Solution:
    """Solve a program by the method that suits it; by Clarabel where that does not verify, and in every retry.

    Where neither verifies, the better of the two comes back, with the runs of both.

    Raises:
        KeyboardInterrupt: somebody interrupted it.
    """
    found = _by_its_structure(program, settings) if settings.structured else None
    if found is not None:
        certificate = judge(program, found)
        if certificate.verified or certificate.rounded:
            return found
    whole = clarabel_.solve(program, settings)
    if found is None:
        return whole
    ranked = sorted((whole, found), key=lambda each: rank_of(judge(program, each)))
    seconds, iterations = found.seconds + whole.seconds, found.iterations + whole.iterations
    return replace(
        ranked[0], runs=found.runs + whole.runs, seconds=seconds, iterations=iterations, closest=whole.closest
    )


def _by_its_structure(program: Program, settings: Settings) -> Solution | None:
    if program.knots < FEWEST:
        return None
    if some_cones.suits(program):
        return some_cones.solve(program, settings, _small)
    from synergrip.conic.solvers import banded_

    return banded_.solve(program, settings) if banded_.suits(program) else None


def _small(program: Program, settings: Settings) -> Solution:
    """Solve a program that has no structure: one with thin room, of which Clarabel leaves more violated."""
    from synergrip.conic.solvers import banded_

    found = banded_.solve(program, settings) if banded_.solvable(program) else None
    return clarabel_.solve(program, settings) if found is None or found.claim is Claim.NOTHING else found
