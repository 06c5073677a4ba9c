"""The smallest effort: sum of squared contact forces, joint torques or actuator efforts."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

from synergrip.conic.formulation import Formulation
from synergrip.conic.goals.goal import Goal, Objective, squares_of, weighed
from synergrip.documents.naming import naming_arguments
from synergrip.errors import InputError, one_of

Effort = Literal["contact", "torque", "actuator"]


@naming_arguments
@dataclass(frozen=True)
class LeastEffort(Goal):
    """Minimise the sum over knots of ``||lambda||^2``, ``||tau||^2`` or ``||sigma||^2``.

    Moments and torques are divided by the length of the grasp. Each determines the internal force: one that the
    synergies control, ``lambda = N J S z`` with N positive semidefinite, has ``S' J' lambda = 0`` only if it is 0.

    Args:
        of: "contact" forces, joint "torque" or "actuator" effort.

    Raises:
        InputError: `of` is none of these.

    Example:
        ``LeastEffort(of="torque")``
    """

    in_natural_units = True
    of: Effort = "contact"
    watches = "forces"
    settles_forces = True

    def __post_init__(self) -> None:
        """Judge the kind of effort."""
        if self.of not in get_args(Effort):
            raise InputError.at("LeastEffort.of", one_of(self.of, get_args(Effort)))

    @property
    def name(self) -> str:
        """Name in messages."""
        return f"least {self.of} effort"

    def objective(self, formulation: Formulation) -> Objective:
        """Return the squares, in units of the force unit (times the length for torques)."""
        scale, unit = formulation.response.scale, formulation.force_unit
        if self.of == "contact":
            return Objective((weighed(formulation.force, scale.force / unit),))
        value = formulation.torque if self.of == "torque" else formulation.effort
        return Objective((squares_of(value, 1 / (unit * scale.length)),))


IN_FILE = {"effort": LeastEffort(), "torque": LeastEffort("torque"), "actuator": LeastEffort("actuator")}
