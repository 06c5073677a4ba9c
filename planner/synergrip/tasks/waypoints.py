"""The wanted motion through waypoints: from rest to rest between them, in straight lines, or along a smooth spline."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.linalg import Array
from synergrip.tasks.marks import Marks
from synergrip.tasks.profiles import PROFILES, WaypointProfile


@dataclass(frozen=True, eq=False)
class Waypoints:
    """Where the object is wanted at some instants, the first of them the start, and the way between them."""

    times: Array  # (K,) [s]
    poses: Array
    """(K, 6) displacement about B [m, rad], or (K, m) coordinates of Gamma_ucs [m]; zero at the start."""
    profile: WaypointProfile

    def at(self, times: Array) -> Array:
        """Return the wanted motion (T, m) at any times (T,) [s]; after the last waypoint the object stays there.

        Every component by itself: a rotation is interpolated as the vector that it is written as.
        """
        inside = np.clip(times, self.times[0], self.times[-1])
        if self.profile == "spline":
            from scipy.interpolate import CubicSpline

            return np.asarray(CubicSpline(self.times, self.poses, bc_type="clamped")(inside))
        segment = np.clip(np.searchsorted(self.times, inside, side="right") - 1, 0, len(self.times) - 2)
        share = (inside - self.times[segment]) / np.diff(self.times)[segment]
        gone = np.asarray(PROFILES[self.profile](share))[:, None]
        return np.asarray(self.poses[segment] * (1 - gone) + self.poses[segment + 1] * gone)

    @property
    def marks(self) -> Marks:
        """The waypoints, and the way between them."""
        return Marks(self.times, () if self.profile == "linear" else ((float(self.times[0]), float(self.times[-1])),))
