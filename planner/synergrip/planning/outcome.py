"""What planning ends in: a plan, a proof that there is none, or the admission that neither is certain."""

from __future__ import annotations

from dataclasses import dataclass

from synergrip.conic.certificate import Certificate
from synergrip.conic.conflicts import Conflict
from synergrip.conic.decide import Decision
from synergrip.conic.formulation import Formulation
from synergrip.conic.limits.limit import Usage
from synergrip.conic.program import Program
from synergrip.errors import Refusal
from synergrip.linalg import Array
from synergrip.planning.between import Between
from synergrip.statics.analysis import Analysis
from synergrip.statics.motion import Motion
from synergrip.tasks.timed_task import TimedTask


@dataclass(frozen=True)
class Check:
    """One statement about a plan, recomputed from the grasp's matrices in SI units."""

    name: str
    error: float
    """Size of the violation, relative to what the statement is measured against."""
    tolerance: float

    @property
    def passed(self) -> bool:
        """True when the error is within the tolerance."""
        return bool(self.error <= self.tolerance)


@dataclass(frozen=True)
class Plan:
    """A verified answer: references to send, and all that follows from them."""

    task: TimedTask
    analysis: Analysis
    formulation: Formulation
    motion: Motion
    alpha: Array  # (T, dim E_s) [N]
    beta: Array  # (T, dim Gamma_ucs) [m]
    gamma: Array  # (T, dim Gamma_zr)
    elastic_motion: Array  # (T, 6) what the references move beyond Gamma_ucs beta, sag excluded
    margins: Array  # (T, n_c) slip margins [N]
    usages: tuple[Usage, ...]
    """What the plan uses of every limit, friction cones first."""
    checks: tuple[Check, ...]
    decisions: tuple[Decision, ...]
    """The programs solved, in order; the last one is the plan's."""
    largest_margin: float | None
    """The largest margin [N] when it was asked for."""
    notes: tuple[str, ...] = ()
    """What the plan is not, although its goal would have it so."""
    between: Between | None = None
    """The plan between its knots; None when nothing is known of it."""

    interrupted: bool = False
    """Whether somebody stopped it before all goals were through; the plan holds all the same."""

    verdict = "feasible"

    @property
    def exit_code(self) -> int:
        """0, or 130 when interrupted."""
        return 130 if self.interrupted else 0


@dataclass(frozen=True)
class Infeasible:
    """A proof that no plan exists."""

    task: TimedTask
    analysis: Analysis | None
    """None when the grasp does not restrain the object."""
    stage: str
    """"restraint", "count", "direction" or "magnitude" (docs/theory.md)."""
    why: str
    refusal: Refusal | None
    """What was refused before any program was solved."""
    certificate: Certificate
    """The verified proof: a free twist, a direction outside Gamma_ucs, or the ray of the program."""
    program: Program | None
    decisions: tuple[Decision, ...]
    largest_margin: float | None
    """The largest margin [N] that the other limits allow, when that is what falls short."""
    conflicts: tuple[Conflict, ...] = ()
    """The limits that the proof rests on, when the program itself is infeasible."""
    hints: tuple[str, ...] = ()
    """What in the problem may not say what its author means, and what would come of it; computed, not guessed."""

    verdict = "infeasible"
    exit_code = 1


@dataclass(frozen=True)
class Unknown:
    """Nothing could be verified either way."""

    task: TimedTask
    analysis: Analysis
    why: str
    decisions: tuple[Decision, ...]

    verdict = "unknown"
    exit_code = 3


Outcome = Plan | Infeasible | Unknown
