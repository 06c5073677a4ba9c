"""The method that suits a program's structure, and Clarabel where none does or what it finds does not verify."""

from __future__ import annotations

from dataclasses import replace

from synergrip.conic.decide import judge
from synergrip.conic.program import Program
from synergrip.conic.solution import Settings, Solution
from synergrip.conic.solvers import clarabel_, some_cones


def solve(program: Program, settings: Settings) -> Solution:
    """Solve a program: with some of its cones where it has few unknowns and many cones, else as a whole.

    Raises:
        KeyboardInterrupt: somebody interrupted it.
    """
    tried = 0
    if some_cones.suits(program):
        found = some_cones.solve(program, settings, clarabel_.solve)
        if found is not None and judge(program, found).verified:
            return found
        tried += 1
    whole = clarabel_.solve(program, settings)
    return replace(whole, runs=whole.runs + tried)
