"""The load that a moving palm puts on the object by its inertia."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.documents.documents import LARGEST_NUMBER
from synergrip.errors import InputError
from synergrip.grasps.objects import Object
from synergrip.linalg import Array, frozen
from synergrip.tasks.marks import Marks
from synergrip.tasks.palm_motion import Palm, marks_of

KEY = "task.palm.inertia"
LOOKS = 65
"""Evenly spaced instants at which the size of the load is looked at."""


@dataclass(frozen=True, eq=False)
class Inertia:
    """The inertial load on an object that is fixed to the palm."""

    mass: float  # [kg]
    centre: Array  # (3,) centre of mass in the palm frame [m]
    tensor: Array  # (3, 3) about the centre, axes of the palm [kg m^2]
    palm: Palm

    def at(self, times: Array) -> Array:
        """Return the wrench (T, 6) about B: force ``-m a``, moment ``-(I alpha + omega x I omega)`` (Euler)."""
        omega, alpha = self.palm.rotation_rates(times)
        force = -self.mass * self.palm.acceleration(self.centre, times)
        moment = -(alpha @ self.tensor.T + np.cross(omega, omega @ self.tensor.T))
        return np.hstack([force, moment])

    @property
    def marks(self) -> Marks:
        """Those of the motion of the palm."""
        return marks_of(self.palm)


def inertia(body: Object | None, mass: float, palm: Palm) -> Inertia:
    """Return the inertial load on a placed object; without one, on a point mass at the origin of the palm frame.

    Raises:
        InputError: there is no mass or no time to move in, or the load is beyond all numbers.
    """
    if mass == 0:
        message = "inertia needs the mass of the object: give object.mass (a grasp file has none: use task.wrench)"
        raise InputError.at(KEY, message)
    start, end = palm.corners[[0, -1]]
    if end <= start:
        raise InputError.at(KEY, f"the palm has no time to move: the task begins and ends at {end:g} s")
    centre = np.zeros(3) if body is None else body.position
    shape = None if body is None else body.shape
    found = Inertia(mass, frozen(centre), frozen(mass * (np.zeros((3, 3)) if shape is None else shape.inertia)), palm)
    _judge_size(found)
    return found


def _judge_size(load: Inertia) -> None:
    """Refuse a load that is beyond all numbers; the corners of the motion are looked at, too, where peaks are."""
    corners = load.palm.corners
    with np.errstate(over="ignore", invalid="ignore"):
        size = float(np.abs(load.at(np.union1d(corners, np.linspace(corners[0], corners[-1], LOOKS)))).max())
    if not size < LARGEST_NUMBER:
        message = f"an inertial load of the order of {size:.1e} N or N m is too large; check task.duration"
        raise InputError.at(KEY, message)
