"""|tau| within the limit of every joint (6)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from synergrip.conic.formulation import Affine, Formulation
from synergrip.conic.limits.file_key import Efforts, FileKey, or_of_hand
from synergrip.conic.limits.symmetric import Symmetric
from synergrip.documents.naming import naming_arguments
from synergrip.hands.units import joint_kinds, torque_unit
from synergrip.linalg import Array, frozen
from synergrip.statics.motion import Motion

if TYPE_CHECKING:
    from synergrip.grasps.grasp import Grasp
    from synergrip.grasps.held import Held


@naming_arguments
@dataclass(frozen=True, eq=False)
class JointTorque(Symmetric):
    """``|tau| <= limit`` for each joint.

    Args:
        limit: torque [N m] (of a slide force [N]) for all joints, or one for each; infinity for none; "hand" for what
            the hand states.

    Raises:
        InputError: no numbers greater than 0.

    Example:
        ``JointTorque(1.5)``, ``JointTorque([1.5, 1.5, 0.8])``, ``JointTorque("hand")``
    """

    key = "limits.joint_torque"
    watches = "forces"
    of = "joint"
    title = "joint torque"
    cause = "torque"
    hand_states = True

    def value(self, formulation: Formulation) -> Affine:
        """Return the torques."""
        return formulation.torque

    def reached(self, motion: Motion) -> Array:
        """Return the torques (T, n_q)."""
        return motion.torques

    def unit(self, grasp: Grasp) -> str:
        """Return "N m", "N" when all joints slide, nothing when some turn and some slide."""
        return unit_of_torques(grasp)

    def of_hand(self, held: Held) -> Array:
        """Return the torque limits of a hand's joints."""
        return frozen([joint.torque_limit for joint in held.hand.joints])


def unit_of_torques(grasp: Grasp) -> str:
    """Return "N m", "N" when all joints slide, nothing when some turn and some slide."""
    return torque_unit(joint_kinds(grasp.held.hand.joints).values()) if grasp.held is not None else "N m"


IN_FILE = FileKey(
    "joint_torque", JointTorque, Efforts,
    "largest torque of a joint in N m, force of a slide in N, one or one per joint; "
    '"hand": as the hand says', or_of_hand(JointTorque), efforts_of="joint",
)  # fmt: skip
