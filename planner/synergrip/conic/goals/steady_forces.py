"""The least change of the contact forces over time: a grip that is not felt to move."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Literal, Self

import numpy as np

from synergrip.conic.arguments import judge_closeness
from synergrip.conic.formulation import Formulation
from synergrip.conic.goals.differences import RESCALED, STIFFEST, differences
from synergrip.conic.goals.goal import Goal, Objective
from synergrip.documents.naming import naming_arguments


@naming_arguments
@dataclass(frozen=True)
class SteadyForces(Goal):
    """Minimise the sum over the steps of ``||lambda_k - lambda_(k-1)||^2 / h_k``.

    Forces count in the force unit and moments, too, divided by the length of the grasp; time in durations of the task,
    and the sum times the number of knots, so that weights mean the same for any number. It says nothing of a squeeze
    that stays, nor of what moves no force: both are for the next goal.

    Args:
        exact: whether the factor before the goal counts, as in a weighted sum, or may be chosen for the solver's sake.
        stiffest: what that factor makes of the largest entry of the Hessian, at most.

    Raises:
        InputError: a value that is none.

    Example:
        ``SteadyForces()``
    """

    in_natural_units = True
    exact: bool = field(default=False, repr=False)
    stiffest: float = field(default=STIFFEST, repr=False)

    def __post_init__(self) -> None:
        """Judge how closely it is looked at."""
        judge_closeness("SteadyForces", self.exact, self.stiffest)

    @property
    def name(self) -> str:
        """Name in messages."""
        return "least change of forces"

    @property
    def watches(self) -> Literal["forces"]:
        """Forces alone."""
        return "forces"

    @property
    def rescaled(self) -> Self | None:
        """The same goal looked at less closely; None when there is no such way."""
        return None if self.exact or self.stiffest <= RESCALED else replace(self, stiffest=RESCALED)

    def weighed(self) -> Self:
        """Return it with the factor of its definition, which counts beside other goals."""
        return replace(self, exact=True)

    def objective(self, formulation: Formulation) -> Objective:
        """Return the squares of the rates of the forces; nothing for a single knot."""
        if formulation.knots < 2:
            return Objective()
        unit = formulation.force_unit / formulation.response.scale.force
        stiffest = np.inf if self.exact else self.stiffest
        return Objective((differences(formulation.force, unit, formulation.times, 1, stiffest),))


IN_FILE = {"steady": SteadyForces()}
