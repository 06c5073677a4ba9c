"""The smallest use of redundancy: the last word, so that nothing is left arbitrary."""

from __future__ import annotations

from dataclasses import dataclass

from synergrip.conic.formulation import Formulation
from synergrip.conic.goals.goal import Goal, Objective, squares_of


@dataclass(frozen=True)
class LeastReconfiguration(Goal):
    """Minimise ``sum ||gamma||^2 + ||beta - what is given||^2`` over what the goals before it left open.

    Both count in the units in which weights are stated.
    """

    in_natural_units = True
    name = "least reconfiguration"

    def objective(self, formulation: Formulation) -> Objective:
        """Return the squares of the unknowns but for the forces."""
        units = formulation.stated
        parts = [squares_of(formulation.gamma, 1 / units.reference)] if formulation.frees_gamma else []
        if formulation.frees_beta:
            beyond = formulation.beta.plus(-formulation.whole.beta.constant)
            parts.append(squares_of(beyond, 1 / units.motion))
        return Objective(tuple(parts))
