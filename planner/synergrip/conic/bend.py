"""What happens between the knots: loads and wishes that leave the straight line."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from synergrip.linalg import Array, interpolated

SAMPLES = 16
"""Instants looked at in each interval between two knots."""
ALLOWANCE = 1.0 + 8.0 / SAMPLES**2
"""What lies between two samples of a curve that is a parabola in each interval exceeds them by less than this."""


@dataclass(frozen=True)
class Bend:
    """Loads and wishes between the knots, at `SAMPLES` instants in each interval."""

    times: Array  # (J,) [s]
    interval: NDArray[np.intp]  # (J,) number of the knot before
    wrench: Array  # (J, 6) external wrench
    wanted: Array  # (J, 6) wanted displacement of the object

    def departures(self, times: Array, wrench: Array, wanted: Array) -> tuple[Array, Array]:
        """Return what wrench and wish (J, 6) depart by from straight lines between their values at knots `times`."""
        return (
            self.wrench - interpolated(self.times, times, wrench),
            self.wanted - interpolated(self.times, times, wanted),
        )


def instants(times: Array) -> tuple[Array, NDArray[np.intp]]:
    """Return `SAMPLES` inner instants of each interval (J,) and the number of the knot before each (J,)."""
    shares = np.arange(1, SAMPLES + 1) / (SAMPLES + 1)
    inner = times[:-1, None] + np.diff(times)[:, None] * shares
    return inner.ravel(), np.repeat(np.arange(len(times) - 1), SAMPLES)
