"""What the effort of every synergy actuator is over the whole time: the root of its mean square."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from synergrip.conic.formulation import Affine, Formulation
from synergrip.conic.limits.actuator_effort import unit_of_efforts
from synergrip.conic.limits.file_key import FileKey, OwnEfforts
from synergrip.conic.limits.sustained import Sustained
from synergrip.documents.naming import naming_arguments
from synergrip.linalg import Array
from synergrip.statics.motion import Motion

if TYPE_CHECKING:
    from synergrip.grasps.grasp import Grasp


@naming_arguments
@dataclass(frozen=True, eq=False)
class SustainedEffort(Sustained):
    """``sqrt(integral of sigma^2 dt / duration) <= limit`` for each synergy, beside what `ActuatorEffort` allows.

    sigma = S' tau is straight between the knots. Where the object is only held, |sigma| at the end counts as well: a
    hold goes on.

    Args:
        limit: effort for all synergies, or one for each; infinity for none.

    Raises:
        InputError: no numbers greater than 0.

    Example:
        ``SustainedEffort(1.2)``
    """

    key = "limits.sustained_effort"
    watches = "forces"
    title = "sustained effort"
    cause = "effort"

    def value(self, formulation: Formulation) -> Affine:
        """Return the efforts."""
        return formulation.effort

    def reached(self, motion: Motion) -> Array:
        """Return the efforts (T, n_z)."""
        return motion.efforts

    def unit(self, grasp: Grasp) -> str:
        """Return that of `ActuatorEffort`."""
        return unit_of_efforts(grasp)


IN_FILE = FileKey(
    "sustained_effort", SustainedEffort, OwnEfforts,
    "root of the mean square over time of a synergy's effort, one or one per synergy; of what is "
    "only held, the last one, too",
    efforts_of="synergy",
)  # fmt: skip
