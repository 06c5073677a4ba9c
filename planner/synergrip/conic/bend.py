"""What happens between the knots: loads and wishes that leave the straight line."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.linalg import Array, interpolated

MOST_SAMPLES, LEAST_SAMPLES, SAMPLES_IN_ALL = 16, 4, 4_000
"""Instants looked at in each interval between two knots: fewer in a task of many intervals, which bend less."""


@dataclass(frozen=True)
class Bend:
    """Loads and wishes between the knots, at the same number of instants in each interval."""

    samples: int
    """Instants in each interval."""
    times: Array  # (J,) [s], one interval after the other
    wrench: Array  # (J, 6) external wrench
    wanted: Array  # (J, 6) wanted displacement of the object

    @property
    def allowance(self) -> float:
        """Factor by which a curve that is a parabola in each interval exceeds its samples there at most."""
        return 1.0 + 8.0 / self.samples**2

    def needed(self, values: Array) -> Array:
        """Return for every knot (T, ...) the most that values (J, ...) >= 0 can be in the two intervals beside it."""
        of_interval = self.allowance * values.reshape(-1, self.samples, *values.shape[1:]).max(axis=1, initial=0.0)
        end = np.zeros((1, *values.shape[1:]))
        return np.asarray(np.maximum(np.concatenate([end, of_interval]), np.concatenate([of_interval, end])))

    def departures(self, times: Array, wrench: Array, wanted: Array) -> tuple[Array, Array]:
        """Return what wrench and wish (J, 6) depart by from straight lines between their values at knots `times`."""
        return (
            self.wrench - interpolated(self.times, times, wrench),
            self.wanted - interpolated(self.times, times, wanted),
        )


def instants(times: Array) -> tuple[int, Array]:
    """Return how many instants lie in each interval, and all of them (J,)."""
    intervals = len(times) - 1
    samples = int(np.clip(SAMPLES_IN_ALL // intervals, LEAST_SAMPLES, MOST_SAMPLES))
    shares = np.arange(1, samples + 1) / (samples + 1)
    inner = times[:-1, None] + np.diff(times)[:, None] * shares
    return samples, inner.ravel()
