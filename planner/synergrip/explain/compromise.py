"""The motion that breaks the limits of a task without a plan by as little as possible: what to look at."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.changes.asked import Posed
from synergrip.conic.limits.limit import Usage
from synergrip.explain.when import knots_of_rows, widened
from synergrip.linalg import Array, frozen
from synergrip.planning.verified import limit_usages
from synergrip.statics.motion import forward
from synergrip.values import Value


@dataclass(frozen=True, eq=False, repr=False)
class Compromise(Value):
    """Forces and references that miss the limits by as little as possible at every knot, in units of the load."""

    times: Array
    """(T,) [s]."""
    missing: Array
    """(T,) by how much all limits would have to be wider at each knot, relative to themselves or to the load."""
    usages: tuple[Usage, ...]
    """What it uses of every limit, friction cones first."""


def compromise(posed: Posed) -> Compromise | None:
    """Return the motion that breaks limits the least; None where none is found.

    Args:
        posed: a task without a plan.
    """
    program = posed.program()
    at = knots_of_rows(program)
    solution = widened(program, at, at >= 0).solution
    n = len(program.q)
    if len(solution.x) != n + program.knots or not np.all(np.isfinite(solution.x)):
        return None
    references = posed.analysis.coordinates.references(*posed.formulation.parts(program.unknowns(solution.x[:n])))
    motion = forward(posed.analysis.response, posed.timed.times, references, posed.timed.wrench)
    usages = limit_usages(posed.timed, posed.formulation, motion)
    return Compromise(posed.timed.times, frozen(np.maximum(solution.x[n:], 0.0)), usages)
