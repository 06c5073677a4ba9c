"""The smallest effort: sum of squared contact forces, joint torques or actuator efforts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from synergrip.conic.formulation import Formulation
from synergrip.conic.goals.goal import Objective, squares_of
from synergrip.conic.rows import Rows


@dataclass(frozen=True)
class LeastEffort:
    """Minimise the sum over knots of ``||lambda||^2``, ``||tau||^2`` or ``||sigma||^2``.

    Moments and torques are divided by the length of the grasp. Each determines the internal force: one that the
    synergies control, ``lambda = N J S z`` with N positive semidefinite, has ``S' J' lambda = 0`` only if it is 0.
    """

    of: Literal["contact", "torque", "actuator"] = "contact"

    @property
    def name(self) -> str:
        """Name in messages."""
        return f"least {self.of} effort"

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return none."""
        return ()

    def objective(self, formulation: Formulation) -> Objective:
        """Return the squares, in units of the force unit (times the length for torques)."""
        scale, unit = formulation.response.scale, formulation.force_unit
        if self.of == "contact":
            return Objective((squares_of(formulation.force, scale.force / unit),))
        value = formulation.torque if self.of == "torque" else formulation.effort
        return Objective((squares_of(value, 1 / (unit * scale.length)),))
