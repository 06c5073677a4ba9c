"""The least change of the contact forces over time: a grip that is not felt to move."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from synergrip.conic.formulation import Formulation
from synergrip.conic.goals.differences import RESCALED, STIFFEST, differences
from synergrip.conic.goals.goal import Objective
from synergrip.conic.rows import Rows


@dataclass(frozen=True)
class SteadyForces:
    """Minimise the sum over the steps of ``||lambda_k - lambda_(k-1)||^2 / h_k``.

    Forces count in the force unit and moments, too, divided by the length of the grasp; time in durations of the task,
    and the sum times the number of knots, so that weights mean the same for any number. It says nothing of a squeeze
    that stays, nor of what moves no force: both are for the next goal.
    """

    exact: bool = False
    """Whether the factor before the goal counts, as in a weighted sum, or may be chosen for the solver's sake."""
    stiffest: float = STIFFEST
    """What that factor makes of the largest entry of the Hessian, at most."""
    name: str = "least change of forces"

    @property
    def rescaled(self) -> Self | None:
        """The same goal looked at less closely; None when there is no such way."""
        return None if self.exact or self.stiffest <= RESCALED else replace(self, stiffest=RESCALED)

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return none."""
        return ()

    def objective(self, formulation: Formulation) -> Objective:
        """Return the squares of the rates of the forces; nothing for a single knot."""
        if formulation.knots < 2:
            return Objective()
        unit = formulation.force_unit / formulation.response.scale.force
        stiffest = np.inf if self.exact else self.stiffest
        return Objective((differences(formulation.force, unit, formulation.times, 1, stiffest),))
