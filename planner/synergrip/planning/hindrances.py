"""What kept a pass along the motion from being taken: limits that clash, or a hand that does not go on."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

from synergrip.conic.conflicts import Conflict, conflicts
from synergrip.conic.decide import Decision
from synergrip.equilibrium.execution import Execution
from synergrip.values import Value

STEP = "step"
"""Key of what keeps a pass short, which is no limit of the task."""
PLAYS_A_PART = 0.05
"""Share of a proof that a limit carries at least to be named."""


@dataclass(frozen=True, repr=False)
class Hindrance(Value):
    """Why a pass was not taken."""

    limits: tuple[Conflict, ...] = ()
    """Those that prove that there is no such pass, the heaviest first; empty when that is not the reason."""
    execution: str = ""
    """Why the execution of what was found ended early; empty when it did not."""

    @classmethod
    def of(cls, decision: Decision, executed: Execution | None) -> Self | None:
        """Return it from what was answered, and from its execution, if there was any; None when none is known."""
        if executed is not None:
            return cls(execution=executed.why) if executed.why else None
        if not decision.infeasible or decision.certificate.y is None:
            return None
        found = [each for each in conflicts(decision.program, decision.certificate.y) if each.key != STEP]
        return cls(tuple(each for each in found if each.share > PLAYS_A_PART) or tuple(found[:1]))
