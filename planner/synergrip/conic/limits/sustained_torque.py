"""What the torque of every joint is over the whole time: the root of its mean square."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from synergrip.conic.formulation import Affine, Formulation
from synergrip.conic.limits.file_key import FileKey, OwnEfforts
from synergrip.conic.limits.joint_torque import unit_of_torques
from synergrip.conic.limits.sustained import Sustained
from synergrip.documents.naming import naming_arguments
from synergrip.linalg import Array
from synergrip.statics.motion import Motion

if TYPE_CHECKING:
    from synergrip.grasps.grasp import Grasp


@naming_arguments
@dataclass(frozen=True, eq=False)
class SustainedTorque(Sustained):
    """``sqrt(integral of tau^2 dt / duration) <= limit`` for each joint, beside what `JointTorque` allows for a moment.

    tau is straight between the knots. Where the object is only held, |tau| at the end counts as well: a hold goes on.

    Args:
        limit: torque [N m] (of a slide force [N]) for all joints, or one for each; infinity for none.

    Raises:
        InputError: no numbers greater than 0.

    Example:
        ``SustainedTorque(0.5)``
    """

    key = "limits.sustained_torque"
    watches = "forces"
    of = "joint"
    title = "sustained torque"
    cause = "torque"

    def value(self, formulation: Formulation) -> Affine:
        """Return the torques."""
        return formulation.torque

    def reached(self, motion: Motion) -> Array:
        """Return the torques (T, n_q)."""
        return motion.torques

    def unit(self, grasp: Grasp) -> str:
        """Return "N m", "N" when all joints slide, nothing when some turn and some slide."""
        return unit_of_torques(grasp)


IN_FILE = FileKey(
    "sustained_torque", SustainedTorque, OwnEfforts,
    "root of the mean square over time of a joint's torque in N m, of a slide's force in N, one or one per joint; of "
    "what is only held, the last one, too", efforts_of="joint",
)  # fmt: skip
