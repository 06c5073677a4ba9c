"""Named moves of the object over the time of the task."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.linalg import Array
from synergrip.tasks.marks import Marks, together
from synergrip.tasks.profiles import Course


@dataclass(frozen=True, eq=False)
class Moves:
    """Motions that add up."""

    parts: tuple[tuple[Course, Array], ...]
    """The course of each, and where it leads: (6,) displacement about B [m, rad], or (m,) coordinates of Gamma_ucs."""
    along_modes: bool

    def at(self, times: Array) -> Array:
        """Return the wanted motion (T, 6) or (T, m) at any times (T,) [s]."""
        return np.asarray(sum(np.outer(course.at(times), whole) for course, whole in self.parts))

    @property
    def marks(self) -> Marks:
        """Those of their courses."""
        return together(course.marks for course, _ in self.parts)
