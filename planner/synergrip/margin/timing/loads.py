"""The load along a path as what it is at rest, and what speed and acceleration add to it: affine in both.

With the length s along the path the palm has the velocity ``x' ds/dt`` and the acceleration ``x' a + x'' b``, where
``b = (ds/dt)^2`` and ``a = d^2 s / dt^2``; likewise ``alpha = omega' a + alpha' b``, with the rates omega', alpha' of a
motion at unit speed. Centripetal and gyroscopic terms go with b. So ``w = at_rest + of_a a + of_b b``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, frozen
from synergrip.margin.timing.by_length import Leg
from synergrip.tasks.inertia import Inertia, inertia
from synergrip.tasks.palm_motion import Palm
from synergrip.tasks.palm_path import PalmPath
from synergrip.tasks.stated import Setting
from synergrip.tasks.task import Task
from synergrip.values import Value


@dataclass(frozen=True, eq=False, repr=False)
class LoadAlong(Value):
    """The load at some points of a path."""

    at_rest: Array  # (T, 6) [N, N m]
    of_a: Array  # (T, 6) for each m/s^2
    of_b: Array  # (T, 6) for each m^2/s^2

    def wrench(self, a: Array, b: Array) -> Array:
        """Return the load (T, 6) at accelerations (T,) [m/s^2] and squares of speeds (T,) [m^2/s^2] along the path."""
        return frozen(self.at_rest + self.of_a * a[:, None] + self.of_b * b[:, None])

    def and_then(self, other: LoadAlong) -> LoadAlong:
        """Return both one after the other."""
        pairs = ((self.at_rest, other.at_rest), (self.of_a, other.of_a), (self.of_b, other.of_b))
        return LoadAlong(*(frozen(np.concatenate(pair)) for pair in pairs))


def load_along(grasp: Grasp, task: Task, leg: Leg, at: Array) -> LoadAlong:
    """Return the load at lengths (T,) of a leg.

    Args:
        grasp: whose object is carried.
        task: whose loads are not bound to time.
        leg: of the path.
        at: [m].

    Raises:
        InputError: inertia without a mass.
    """
    body = None if grasp.held is None else grasp.held.body
    setting = Setting(0.0, leg.length, body, leg.palm)
    rest = np.zeros((len(at), 6))
    for load in task.loads:
        profile = None if isinstance(load, Palm | PalmPath) else load.over(setting)
        if profile is not None:
            rest = rest + profile.at(at)
    moving = inertia(body, leg.palm)
    factor = task.load_factor
    return LoadAlong(frozen(factor * rest), frozen(factor * _of_a(moving, leg, at)), frozen(factor * moving.at(at)))


def _of_a(moving: Inertia, leg: Leg, at: Array) -> Array:
    """Return what an acceleration along the path adds (T, 6): ``-m x'`` at the centre, and ``-I omega'``."""
    omega, _ = leg.palm.rotation_rates(at)
    return np.hstack([-moving.mass * leg.palm.velocity(moving.centre, at), -(omega @ moving.tensor.T)])
