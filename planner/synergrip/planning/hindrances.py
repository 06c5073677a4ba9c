"""What kept a pass along the motion from being taken: a limit that binds, or a hand that does not go on."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

from synergrip.conic.conflicts import conflicts
from synergrip.conic.decide import Decision
from synergrip.equilibrium.execution import Execution
from synergrip.values import Value

STEP = "step"
"""Key of what keeps a pass short, which is no limit of the task."""


@dataclass(frozen=True, repr=False)
class Hindrance(Value):
    """Why a pass was not taken."""

    key: str = ""
    """The limit that carries most of the proof that there is no such pass; empty when that is not the reason."""
    items: tuple[str, ...] = ()
    """Whom it binds, the heaviest first."""
    friction: bool = False
    """Whether it is the friction cones that carry most of it."""
    execution: str = ""
    """Why the execution of what was found ended early; empty when it did not."""

    @classmethod
    def of(cls, decision: Decision, executed: Execution | None) -> Self:
        """Return it from what was answered, and from the execution of that, if there was any."""
        if executed is not None:
            return cls(execution=executed.why)
        ray = decision.certificate.y if decision.infeasible else None
        found = [] if ray is None else [each for each in conflicts(decision.program, ray) if each.key != STEP]
        chief = next((each for each in found if not each.friction), None) or next(iter(found), None)
        return cls() if chief is None else cls(chief.key, chief.items, chief.friction)
