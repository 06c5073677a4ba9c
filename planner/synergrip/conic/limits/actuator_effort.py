"""|sigma| within the limit of every synergy actuator, sigma = S' tau."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from synergrip.conic.formulation import Affine, Formulation
from synergrip.conic.limits.file_key import Efforts, FileKey, or_of_hand
from synergrip.conic.limits.symmetric import SYNERGY_UNITS, Symmetric
from synergrip.documents.naming import naming_arguments
from synergrip.hands.units import joint_kinds, synergy_kinds, unit_of
from synergrip.linalg import Array
from synergrip.statics.motion import Motion

if TYPE_CHECKING:
    from synergrip.grasps.grasp import Grasp
    from synergrip.grasps.held import Held


@naming_arguments
@dataclass(frozen=True, eq=False)
class ActuatorEffort(Symmetric):
    """``|sigma| <= limit`` for each synergy.

    Args:
        limit: effort for all synergies, or one for each; infinity for none; "hand" for what the hand states.

    Raises:
        InputError: no numbers greater than 0.

    Example:
        ``ActuatorEffort(2.0)``
    """

    key = "limits.actuator_effort"
    watches = "forces"
    title = "actuator effort"
    cause = "effort"
    hand_states = True

    def value(self, formulation: Formulation) -> Affine:
        """Return the efforts."""
        return formulation.effort

    def reached(self, motion: Motion) -> Array:
        """Return the efforts (T, n_z)."""
        return motion.efforts

    def unit(self, grasp: Grasp) -> str:
        """Return "N m", "N" when all synergies move slides alone, synergy units when nobody knows or they differ."""
        return unit_of_efforts(grasp)

    def of_hand(self, held: Held) -> Array:
        """Return the effort limits of a hand's synergies."""
        return held.synergies.effort_limits


def unit_of_efforts(grasp: Grasp) -> str:
    """Return "N m", "N" when all synergies move slides alone, synergy units when nobody knows or they differ."""
    if grasp.held is None:
        return SYNERGY_UNITS
    kinds = synergy_kinds(grasp.held.synergies, joint_kinds(grasp.held.hand.joints).values())
    return unit_of(kinds.values(), "N m", "N") or SYNERGY_UNITS


IN_FILE = FileKey(
    "actuator_effort", ActuatorEffort, Efforts,
    'largest effort of a synergy, one or one per synergy; "hand": as the hand says', or_of_hand(ActuatorEffort),
    efforts_of="synergy",
)  # fmt: skip
