"""The load that a moving palm puts on the object by its inertia."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.documents.documents import LARGEST_NUMBER
from synergrip.errors import InputError
from synergrip.grasps.objects import Object
from synergrip.linalg import Array, frozen
from synergrip.tasks.marks import Marks
from synergrip.tasks.palm_in_world import PalmInWorld, marks_of

KEY = "inertia"
LOOKS = 65
"""Evenly spaced instants at which the size of the load is looked at."""


@dataclass(frozen=True, eq=False)
class Inertia:
    """The inertial load on an object that is fixed to the palm."""

    mass: float  # [kg]
    centre: Array  # (3,) centre of mass in the palm frame [m]
    tensor: Array  # (3, 3) about the centre, axes of the palm [kg m^2]
    palm: PalmInWorld

    def at(self, times: Array) -> Array:
        """Return the wrench (T, 6) about B: force ``-m a``, moment ``-(I alpha + omega x I omega)`` (Euler)."""
        omega, alpha = self.palm.rotation_rates(times)
        force = -self.mass * self.palm.acceleration(self.centre, times)
        return np.hstack([force, inertial_moment(self.tensor, omega, alpha)])

    @property
    def marks(self) -> Marks:
        """Those of the motion of the palm."""
        return marks_of(self.palm)


def inertial_moment(tensor: Array, omega: Array, alpha: Array) -> Array:
    """Return the moment (T, 3) by which a body resists its rotation: ``-(I alpha + omega x I omega)`` (Euler).

    Args:
        tensor: (3, 3) about its centre, or (T, 3, 3), in the axes of the others [kg m^2].
        omega: (T, 3) angular velocity [rad/s].
        alpha: (T, 3) angular acceleration [rad/s^2].
    """
    spin, slow = ((tensor @ each[..., None])[..., 0] for each in (omega, alpha))
    return np.asarray(-(slow + np.cross(omega, spin)))


def inertia(body: Object | None, palm: PalmInWorld) -> Inertia:
    """Return the inertial load on a placed object.

    Raises:
        InputError: there is no mass or no time to move in, or the load is beyond all numbers.
    """
    if body is None or not body.mass:
        given = "a grasp given as matrices has none, give the wrench itself" if body is None else "give object.mass"
        raise InputError.at(KEY, f"inertia needs the mass of the object: {given}")
    start, end = palm.corners[[0, -1]]
    if end <= start:
        raise InputError.at(KEY, f"the palm has no time to move: the task begins and ends at {end:g} s")
    tensor = np.zeros((3, 3)) if body.shape is None else body.shape.inertia
    found = Inertia(body.mass, frozen(body.position), frozen(body.mass * tensor), palm)
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
