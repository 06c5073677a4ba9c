"""Values over the time of a task, to be had at any instant: profiles from 0 to 1, constants, tables, and their sums."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, Protocol

import numpy as np
from numpy.polynomial import Polynomial

from synergrip.documents.time_table import Table
from synergrip.linalg import Array, frozen, interpolated
from synergrip.tasks.marks import SAME_TIME, Jump, Marks, together

ProfileName = Literal["min-jerk", "cubic", "linear"]
WaypointProfile = Literal["min-jerk", "cubic", "linear", "spline"]
SHORTEST = 1e-6
"""Shortest task, and shortest way from one waypoint to the next [s]."""
PROFILES: dict[ProfileName, Polynomial] = {
    "linear": Polynomial([0, 1]),
    "cubic": Polynomial([0, 0, 3, -2]),
    "min-jerk": Polynomial([0, 0, 0, 10, -15, 6]),
}
"""Rise from 0 to 1 over the share of the time that has passed."""


class Profile(Protocol):
    """Values over time."""

    def at(self, times: Array) -> Array:
        """Return the values (T, m) at any times (T,) [s]."""

    @property
    def marks(self) -> Marks:
        """Where they have corners and jumps, and where they are curved."""


@dataclass(frozen=True)
class Rise:
    """A profile from 0 at its start to 1 at its end; at rest before and after."""

    name: ProfileName
    start: float  # [s]
    end: float  # [s]

    def at(self, times: Array, derivative: int = 0) -> Array:
        """Return the profile (T,), or a derivative of it [1/s^derivative]; without any time to go it is at its end.

        At the two ends a derivative is the one from inside.
        """
        span = self.end - self.start
        if span <= 0:
            return np.full(len(times), 1.0 if derivative == 0 else 0.0)
        share = (times - self.start) / span
        values = np.asarray(PROFILES[self.name].deriv(derivative)(np.clip(share, 0.0, 1.0)) / span**derivative)
        outside = (share < -SAME_TIME) | (share > 1 + SAME_TIME)
        return values if derivative == 0 else np.where(outside, 0.0, values)

    @property
    def marks(self) -> Marks:
        """Start and end, and the way between them."""
        if self.end <= self.start:
            return Marks()
        return Marks(np.array([self.start, self.end]), () if self.name == "linear" else ((self.start, self.end),))


@dataclass(frozen=True, eq=False)
class Constant:
    """The same values at all times."""

    values: Array
    """(m,)"""

    def at(self, times: Array) -> Array:
        """Return the values (T, m)."""
        return np.repeat(self.values[None], len(times), axis=0)

    @property
    def marks(self) -> Marks:
        """None."""
        return Marks()


@dataclass(frozen=True, eq=False)
class Tabled:
    """A table, read linearly between its lines; before the first and after the last it stays as it is there."""

    table: Table

    def at(self, times: Array) -> Array:
        """Return the values (T, m)."""
        return interpolated(times, self.table.times, self.table.values)

    @property
    def marks(self) -> Marks:
        """Every line."""
        return Marks(self.table.times)


@dataclass(frozen=True, eq=False)
class Profiles:
    """What acts on the object and where it is wanted, at any time of the task."""

    load: tuple[Profile, ...]
    """Wrenches (T, 6) about B [N, N m] that add up; none when nothing is said of the load."""
    target: Profile
    """What `Target.values` holds at the knots."""
    factor: float = 1.0
    """By which the whole load is multiplied."""
    motion_factor: float = 1.0
    """By which the wanted motion is multiplied."""

    def load_at(self, times: Array) -> Array | None:
        """Return the external wrench on the object (T, 6) at any times (T,) [s]; None when nothing is said of it."""
        if not self.load:
            return None
        return frozen(self.factor * sum((part.at(times) for part in self.load), np.zeros((len(times), 6))))

    def target_at(self, times: Array) -> Array:
        """Return the wanted motion (T, m) at any times (T,) [s], with the columns of `Target.values`."""
        return frozen(self.motion_factor * self.target.at(times))

    @property
    def marks(self) -> Marks:
        """Where load or target have corners, where the load jumps, and where one of them is curved."""
        found = together(part.marks for part in (*self.load, self.target))
        jumps = tuple(Jump(jump.time, jump.side, self.factor * jump.change) for jump in found.jumps)
        return Marks(found.corners, found.curved, jumps)
