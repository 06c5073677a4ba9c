"""What a solver says of a program. A claim, nothing more: the certificate decides."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from synergrip.linalg import Array
from synergrip.values import Value


class Claim(StrEnum):
    """What the solver claims."""

    OPTIMAL = "optimal"
    INFEASIBLE = "infeasible"
    UNBOUNDED = "unbounded"
    NOTHING = "nothing"


@dataclass(frozen=True, eq=False, repr=False)
class Solution(Value):
    """A solver's claim with its numbers."""

    claim: Claim
    x: Array
    """(n,) unknowns."""
    z: Array
    """(m,) multipliers of ``b - A x`` in the cone, themselves in the dual cone; the ray when infeasible."""
    solver: str
    """Solver and version."""
    status: str
    """The solver's own word."""
    iterations: int
    seconds: float
    runs: int = 1
    """How often solvers were run for it."""
    closest: float = 0.0
    """The least tolerance that any iterate kept: with the same settings and one below it the solver ends in the same.
    0 where that is not known."""


@dataclass(frozen=True)
class Settings:
    """How hard to try; each retry changes something that matters to an interior-point method."""

    tolerance: float = 1e-9
    max_iterations: int = 200
    equilibrate: bool = False
    regularisation: float = 1e-8
    step: float = 0.99
    structured: bool = True
    """Whether a method that suits the program's structure is tried first, where there is one."""
