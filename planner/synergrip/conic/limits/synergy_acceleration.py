"""|second difference of dz_r| over the knots within an acceleration for every synergy."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from synergrip.conic.limits.differences import Differences
from synergrip.conic.limits.file_key import FileKey, References
from synergrip.documents.naming import naming_arguments
from synergrip.linalg import Array
from synergrip.statics.motion import Motion

if TYPE_CHECKING:
    from synergrip.grasps.grasp import Grasp


@naming_arguments
@dataclass(frozen=True, eq=False)
class SynergyAcceleration(Differences):
    """A bound on how fast the rate of each synergy changes.

    The acceleration at knot k - 1 is that of the parabola through knots k - 2, k - 1, k:
    ``2 ((z_k - z_(k-1)) / h_k - (z_(k-1) - z_(k-2)) / h_(k-1)) / (h_k + h_(k-1))``, whatever the steps h.

    Args:
        limit: acceleration [synergy units / s^2] for all synergies, or one for each; infinity for none.

    Raises:
        InputError: no numbers greater than 0.

    Example:
        ``SynergyAcceleration(4.0)``
    """

    key = "limits.synergy_acceleration"
    title = "synergy acceleration"
    cause = "acceleration"
    of_references_alone = True

    def differences(self, times: Array) -> tuple[Array, Array]:
        """Return h_k (h_k + h_(k-1)) / 2, and with r = h_k / h_(k-1) the weights -(1 + r) and r."""
        h = np.diff(times)
        ratio = h[1:] / h[:-1]
        return h[1:] * (h[1:] + h[:-1]) / 2, np.column_stack([-(1 + ratio), ratio])

    def reached(self, motion: Motion) -> Array:
        """Return the accelerations (T, n_z), each at its knot; 0 at the first and the last."""
        found = np.zeros_like(motion.dz_r)
        if len(motion.times) > 2:
            h = np.diff(motion.times)[:, None]
            rates = np.diff(motion.dz_r, axis=0) / h
            found[1:-1] = 2 * np.diff(rates, axis=0) / (h[1:] + h[:-1])
        return found

    def unit(self, grasp: Grasp) -> str:
        """Return the unit of an acceleration."""
        return "synergy units/s²"


IN_FILE = FileKey(
    "synergy_acceleration", SynergyAcceleration, References,
    "largest acceleration of a synergy reference, per s^2, one or one per synergy",
)  # fmt: skip
