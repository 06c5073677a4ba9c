"""What keeps the scalar of a goal while later goals choose, when the goal does not say it better itself."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from synergrip.conic.formulation import Formulation, Units
from synergrip.conic.goals.goal import Goal
from synergrip.conic.limits.limit import Limit, Usage, Watches
from synergrip.conic.rows import Rows
from synergrip.linalg import frozen
from synergrip.statics.motion import Motion


@dataclass(frozen=True)
class KeptScalar(Limit):
    """The rows of a goal with its scalar fixed. It is asked for between two goals, and no plan is told of it."""

    goal: Goal
    scalar: float
    """In the units of the rows."""
    units: Units
    """In which the rows were when the scalar was found."""

    @property
    def key(self) -> str:
        """Key of the goal's rows."""
        return self.goal.name

    @property
    def watches(self) -> Watches:
        """What the goal depends on."""
        return self.goal.watches

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return the rows of the goal, whatever the units of the unknowns are by now."""
        return [
            replace(part, constant=frozen(part.constant + part.epigraph * self.scalar),
                    epigraph=frozen(np.zeros_like(part.epigraph)))
            for part in self.goal.rows(replace(formulation, units=self.units))
        ]  # fmt: skip

    def usage(self, formulation: Formulation, motion: Motion) -> Usage:
        """Refuse: a goal says nothing about motions."""
        raise NotImplementedError(f"'{self.goal.name}' is a goal; only limits are told of a plan")
