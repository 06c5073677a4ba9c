"""How the palm moves in the world, and what stands still there as seen from the palm: gravity above all."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from synergrip.linalg import Array
from synergrip.tasks.marks import Marks
from synergrip.tasks.profiles import Rise


class Palm(Protocol):
    """How the palm moves, seen from the palm itself: all vectors are in its axes at each instant."""

    @property
    def corners(self) -> Array:
        """Start and end of the motion (K,) [s], and between them the instants where its acceleration has a corner."""

    def seen(self, vectors: Array, times: Array) -> Array:
        """Return vectors (T, 3) that are given, (3,) or (T, 3), in the palm frame at the start."""

    def rotation_rates(self, times: Array) -> tuple[Array, Array]:
        """Return angular velocity (T, 3) [rad/s] and acceleration (T, 3) [rad/s^2]."""

    def acceleration(self, point: Array, times: Array) -> Array:
        """Return the acceleration (T, 3) [m/s^2] of a point (3,) [m] fixed to the palm."""


@dataclass(frozen=True, eq=False)
class PalmMotion:
    """A turn about an axis through the origin of the palm frame and a shift of this origin, on one profile.

    The world frame is the palm frame at the start: a point p of the palm is at ``shift s + R(axis, turn s) p``.
    """

    axis: Array  # (3,) unit
    turn: float  # [rad]
    shift: Array  # (3,) [m]
    profile: Rise

    @property
    def corners(self) -> Array:
        """Start and end (2,) [s]; there are no corners on the way."""
        return np.array([self.profile.start, self.profile.end])

    def seen(self, vectors: Array, times: Array) -> Array:
        """Return vectors of the world (3,) or (T, 3) in the palm frame (T, 3): ``R(axis, -angle) v`` (Rodrigues)."""
        angle = -self.turn * self.profile.at(times)[:, None]
        along = (vectors @ self.axis)[..., None] * self.axis
        return np.asarray(
            vectors * np.cos(angle) + np.cross(self.axis, vectors) * np.sin(angle) + along * (1 - np.cos(angle))
        )

    def rotation_rates(self, times: Array) -> tuple[Array, Array]:
        """Return angular velocity (T, 3) [rad/s] and acceleration (T, 3) [rad/s^2]; the same in world and palm."""
        turn = self.turn * self.axis
        return np.outer(self.profile.at(times, 1), turn), np.outer(self.profile.at(times, 2), turn)

    def acceleration(self, point: Array, times: Array) -> Array:
        """Return the acceleration (T, 3) [m/s^2], in the palm frame, of a point (3,) [m] fixed to the palm."""
        origin = self.seen(np.outer(self.profile.at(times, 2), self.shift), times)
        return acceleration_of(point, origin, *self.rotation_rates(times))


@dataclass(frozen=True, eq=False)
class Weight:
    """The weight of the object, also in a palm that moves."""

    force: Array
    """(3,) in the palm frame at the start [N]."""
    palm: Palm | None
    """None when it stands still."""

    def at(self, times: Array) -> Array:
        """Return the wrench (T, 6) about B; the centre of mass is there."""
        force = np.tile(self.force, (len(times), 1)) if self.palm is None else self.palm.seen(self.force, times)
        return np.hstack([force, np.zeros((len(times), 3))])

    @property
    def marks(self) -> Marks:
        """Those of the motion of the palm."""
        return Marks() if self.palm is None else marks_of(self.palm)


def marks_of(palm: Palm) -> Marks:
    """Return the marks of a load by a palm that moves: it is curved from the start of the motion to its end."""
    return Marks(palm.corners, ((float(palm.corners[0]), float(palm.corners[-1])),))


def acceleration_of(point: Array, origin: Array, omega: Array, alpha: Array) -> Array:
    """Return the acceleration (T, 3) of a point (3,) fixed to a body: of its origin, tangential, centripetal.

    ``a + alpha x p + omega x (omega x p)``, all of it in the axes of the body (T, 3).
    """
    return np.asarray(origin + np.cross(alpha, point) + np.cross(omega, np.cross(omega, point)))
