"""The largest slip margin that all contacts keep at all knots."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from synergrip.conic.formulation import Formulation
from synergrip.conic.goals.goal import Goal, Objective
from synergrip.conic.limits.friction_cone import FRICTION, FrictionCone, friction_rows
from synergrip.conic.rows import Rows
from synergrip.documents.naming import naming_arguments


@naming_arguments
@dataclass(frozen=True)
class LargestMargin(Goal):
    """Maximise s with ``slip margin >= s`` everywhere. It stands in the place of the friction-cone limit.

    Example:
        >>> Task(duration=1.0, goals=[LargestMargin(), LeastEffort()]).goals[0].name
        'largest margin'
    """

    name = "largest margin"
    watches = "forces"
    has_scalar = True
    maximises = True

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return the friction cones with s in the margin's place."""
        return friction_rows(formulation, 0.0, -1.0, FRICTION)

    def objective(self, formulation: Formulation) -> Objective:
        """Return -s."""
        return Objective(epigraph=-1.0)

    def keeps(self, best: float, slack: float) -> FrictionCone:
        """Return the limit that keeps a margin of `best` less `slack` [N]."""
        return FrictionCone(best - slack)


IN_FILE = {"margin": LargestMargin()}
