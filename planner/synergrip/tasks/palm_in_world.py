"""How a palm moves in the world, as what it holds sees it."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from synergrip.linalg import Array
from synergrip.tasks.marks import Marks


class PalmInWorld(Protocol):
    """How the palm moves, seen from the palm itself: all vectors are in its axes at each instant."""

    @property
    def corners(self) -> Array:
        """Start and end of the motion (K,) [s], and between them the instants where its acceleration has a corner."""

    @property
    def in_words(self) -> str:
        """What the palm does, such as "turns 90 deg about x"."""

    def seen(self, vectors: Array, times: Array) -> Array:
        """Return vectors (T, 3) that are given, (3,) or (T, 3), in the palm frame at the start."""

    def rotation_rates(self, times: Array) -> tuple[Array, Array]:
        """Return angular velocity (T, 3) [rad/s] and acceleration (T, 3) [rad/s^2]."""

    def acceleration(self, point: Array, times: Array) -> Array:
        """Return the acceleration (T, 3) [m/s^2] of a point (3,) [m] fixed to the palm."""


def marks_of(palm: PalmInWorld) -> Marks:
    """Return the marks of a load by a palm that moves: it is curved from the start of the motion to its end."""
    return Marks(palm.corners, ((float(palm.corners[0]), float(palm.corners[-1])),))


def acceleration_of(point: Array, origin: Array, omega: Array, alpha: Array) -> Array:
    """Return the acceleration (T, 3) of a point (3,) or (T, 3) of a body: of its origin, tangential, centripetal.

    ``a + alpha x p + omega x (omega x p)``, all of it in the axes of the body (T, 3).
    """
    return np.asarray(origin + np.cross(alpha, point) + np.cross(omega, np.cross(omega, point)))
