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


@dataclass(frozen=True)
class Settings:
    """How hard to try; each retry changes something that matters to an interior-point method."""

    tolerance: float = 1e-9
    max_iterations: int = 200
    equilibrate: bool = False
    regularisation: float = 1e-8
    step: float = 0.99
