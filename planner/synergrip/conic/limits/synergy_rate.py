"""|change of dz_r| between knots within a rate for every synergy."""

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
class SynergyRate(Differences):
    """``|z_k - z_(k-1)| <= h_k limit`` for each synergy. The first knot is not bounded by it.

    Args:
        limit: rate [synergy units / s] for all synergies, or one for each; infinity for none.

    Raises:
        InputError: no numbers greater than 0.

    Example:
        ``SynergyRate(1.0)``
    """

    key = "limits.synergy_rate"
    title = "synergy rate"
    cause = "rate"
    of_references_alone = True

    def differences(self, times: Array) -> tuple[Array, Array]:
        """Return the steps between knots, and what each takes from the knot before."""
        return np.diff(times), -np.ones((len(times) - 1, 1))

    def reached(self, motion: Motion) -> Array:
        """Return the rates (T, n_z), each at the knot where its step ends."""
        rates = np.zeros_like(motion.dz_r)
        rates[1:] = np.diff(motion.dz_r, axis=0) / np.diff(motion.times)[:, None]
        return rates

    def unit(self, grasp: Grasp) -> str:
        """Return the unit of a rate."""
        return "synergy units/s"


IN_FILE = FileKey(
    "synergy_rate", SynergyRate, References, "largest change of a synergy reference per second, one or one per synergy",
)  # fmt: skip
