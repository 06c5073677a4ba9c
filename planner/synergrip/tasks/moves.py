"""Named moves of the object over the time of the task."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.linalg import Array
from synergrip.tasks.marks import Marks, together
from synergrip.tasks.profiles import Rise


@dataclass(frozen=True, eq=False)
class Moves:
    """Motions that add up."""

    parts: tuple[tuple[Rise, Array], ...]
    """The profile of each, and where it leads: (6,) displacement about B [m, rad], or (m,) coordinates of Gamma_ucs."""
    along_modes: bool

    def at(self, times: Array) -> Array:
        """Return the wanted motion (T, 6) or (T, m) at any times (T,) [s]."""
        return np.asarray(sum(np.outer(profile.at(times), whole) for profile, whole in self.parts))

    @property
    def marks(self) -> Marks:
        """Those of their profiles."""
        return together(profile.marks for profile, _ in self.parts)
