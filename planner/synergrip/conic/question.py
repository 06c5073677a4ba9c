"""One question to a solver: limits and a goal over a formulation, before any program is built."""

from __future__ import annotations

from dataclasses import dataclass

from synergrip.conic.build import Constraints, build, constraints
from synergrip.conic.certificate import TIGHT
from synergrip.conic.formulation import Formulation
from synergrip.conic.goals.goal import Goal
from synergrip.conic.limits.limit import Limit
from synergrip.conic.program import Program
from synergrip.values import Value


@dataclass(frozen=True, eq=False, repr=False)
class Question(Value):
    """What is asked, in the terms in which a program is built."""

    formulation: Formulation
    limits: tuple[Limit, ...]
    goal: Goal
    violation: float = TIGHT
    """Of a cone, below which an answer is not tried to be bettered."""
    worth: float = 1.0
    """What sums of squares are divided by, so that their value is near 1; it changes no answer."""

    def program(self) -> Program:
        """Return the program of this question."""
        return build(self.formulation, self.limits, self.goal, self.worth)

    def constraints(self) -> Constraints:
        """Return the rows of that program alone."""
        return constraints(self.formulation, self.limits, self.goal)
