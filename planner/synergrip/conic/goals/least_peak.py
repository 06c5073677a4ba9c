"""The smallest peak normal force, for fragile objects."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from synergrip.conic.formulation import Formulation
from synergrip.conic.goals.goal import Goal, Objective
from synergrip.conic.limits.normal_force import NormalForce, normal_selection
from synergrip.conic.rows import Rows, below_scalar
from synergrip.documents.naming import naming_arguments


@naming_arguments
@dataclass(frozen=True)
class LeastPeak(Goal):
    """Minimise s with ``normal force <= s`` at all contacts and knots.

    Example:
        >>> Task(duration=1.0, goals=[LeastPeak()]).goals[0].has_scalar
        True
    """

    name = "least peak normal force"
    watches = "forces"
    has_scalar = True

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return ``s - n >= 0`` for every contact."""
        names = formulation.response.grasp.contact_names
        value = formulation.force.after(normal_selection(formulation) / formulation.force_unit)
        return [below_scalar("goal.minimise", names, value)]

    def objective(self, formulation: Formulation) -> Objective:
        """Return s."""
        return Objective(epigraph=1.0)

    def keeps(self, best: float, slack: float) -> NormalForce:
        """Return the limit that keeps a peak of `best` plus `slack` [N]."""
        return NormalForce(-np.inf, max(best + slack, 0.0), "goal.minimise")


IN_FILE = {"peak_force": LeastPeak()}
