"""The least motion of the synergy references: away from the start, from knot to knot, or in its bends."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Literal, Self, get_args

import numpy as np

from synergrip.conic.arguments import judge_closeness
from synergrip.conic.formulation import Formulation
from synergrip.conic.goals.differences import RESCALED, STIFFEST, differences
from synergrip.conic.goals.goal import Goal, Objective, squares_of
from synergrip.documents.judging import is_word
from synergrip.documents.naming import naming_arguments
from synergrip.errors import InputError, one_of

Motion = Literal["references", "rates", "accelerations"]


@naming_arguments
@dataclass(frozen=True)
class LeastMotion(Goal):
    """Minimise the sum of squares of the synergy references, of their rates, or of their accelerations.

    "references": ``||dz_r||^2`` at every knot, so that the hand stays near the posture in which it starts. "rates":
    of the steps between knots over their durations, averaged over time: the least travel. "accelerations": of the
    second differences, averaged over time: smooth references. Time counts in durations of the task, and averages
    times the number of knots, so that weights mean the same for any number. Rates and accelerations say nothing
    about where the references are, or how fast they go; what they leave open is for the next goal.

    Args:
        of: "references", "rates" or "accelerations".
        exact: whether the factor before the goal counts, as in a weighted sum, or may be chosen for the solver's sake.
        stiffest: what that factor makes of the largest entry of the Hessian, at most.

    Raises:
        InputError: `of` is none of these, or another value is none.

    Example:
        ``LeastMotion(of="rates")``
    """

    in_natural_units = True
    of: Motion = "references"
    exact: bool = field(default=False, repr=False)
    stiffest: float = field(default=STIFFEST, repr=False)

    def __post_init__(self) -> None:
        """Judge the kind of motion."""
        if not is_word(self.of, get_args(Motion)):
            raise InputError.at("LeastMotion.of", one_of(self.of, get_args(Motion)))
        judge_closeness("LeastMotion", self.exact, self.stiffest)

    @property
    def name(self) -> str:
        """Name in messages."""
        return {"references": "least motion", "rates": "least travel", "accelerations": "smoothest references"}[self.of]

    @property
    def rescaled(self) -> Self | None:
        """The same goal looked at less closely; None when there is no such way."""
        if self.exact or self.of == "references" or self.stiffest <= RESCALED:
            return None
        return replace(self, stiffest=RESCALED)

    def weighed(self) -> Self:
        """Return it with the factor of its definition, which counts beside other goals."""
        return replace(self, exact=True)

    def objective(self, formulation: Formulation) -> Objective:
        """Return the squares, in reference units over the duration of the task."""
        unit = formulation.units.reference
        if self.of == "references":
            return Objective((squares_of(formulation.reference, 1 / unit),))
        order = 1 if self.of == "rates" else 2
        if formulation.knots <= order:
            return Objective()
        stiffest = np.inf if self.exact else self.stiffest
        return Objective((differences(formulation.reference, unit, formulation.times, order, stiffest),))


IN_FILE = {
    "references": LeastMotion(),
    "travel": LeastMotion("rates"),
    "smooth": LeastMotion("accelerations"),
}
