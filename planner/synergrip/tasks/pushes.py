"""Pushes: forces on the object for some time, and the wrench about B that each of them is."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np

from synergrip.linalg import Array, frozen
from synergrip.tasks.marks import SAME_TIME, Jump, Marks

PushProfile = Literal["step", "trapezoid", "half-sine"]
HALF_SINE_PARTS = 16
"""Into how many parts knots divide a half sine: straight lines between them fall short by 0.5 % of the force."""


@dataclass(frozen=True, eq=False)
class Push:
    """A wrench that comes and goes."""

    wrench: Array  # (6,) about B at the full force [N, N m]
    profile: PushProfile
    start: float  # [s]
    end: float  # [s]
    ramp: float  # [s]

    def at(self, times: Array) -> Array:
        """Return the wrench (T, 6) about B at any times (T,) [s]; a step is on at its start and its end."""
        return np.outer(self.share(times), self.wrench)

    def share(self, times: Array) -> Array:
        """Return the share (T,) of the full force."""
        slack = SAME_TIME * max(self.end, 1.0)
        inside = (times >= self.start - slack) & (times <= self.end + slack)
        if self.profile == "step":
            return np.where(inside, 1.0, 0.0)
        if self.profile == "trapezoid":
            nearest = np.minimum(times - self.start, self.end - times)  # to either end
            return np.clip(nearest / self.ramp, 0.0, 1.0)
        share = (times - self.start) / (self.end - self.start)
        return np.where(inside, np.maximum(np.sin(np.pi * np.clip(share, 0.0, 1.0)), 0.0), 0.0)

    @property
    def marks(self) -> Marks:
        """Its corners; a step jumps at its start and its end, a half sine is curved between them."""
        corners = np.array([time for _, time in self.corners])
        if self.profile == "step":
            off = frozen(-self.wrench)
            return Marks(corners, jumps=(Jump(self.start, -1, off), Jump(self.end, 1, off)))
        return Marks(corners, ((self.start, self.end),) if self.profile == "half-sine" else ())

    @property
    def corners(self) -> Iterator[tuple[str, float]]:
        """The times at which there must be a knot [s], each with the key that says so."""
        yield "start", self.start
        yield "end", self.end
        if self.profile == "trapezoid":
            yield from (("ramp", self.start + self.ramp), ("ramp", self.end - self.ramp))
        if self.profile == "half-sine":
            yield "profile", (self.start + self.end) / 2

    @property
    def knots(self) -> Array:
        """The times at which the push is looked at when nobody says how many there are [s]."""
        if self.profile == "half-sine":
            return np.linspace(self.start, self.end, HALF_SINE_PARTS + 1)
        return np.array([time for _, time in self.corners])
