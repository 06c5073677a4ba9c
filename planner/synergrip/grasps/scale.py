"""The length that makes newtons and newton metres, metres and radians comparable.

Ranks and norms must depend neither on the units nor on where the user put the object frame
(docs/theory.md). So moments and rotations are scaled by the mean distance of the contacts
from their centroid, and twists and wrenches are taken about that centroid.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.grasps.contacts.kind import is_moment
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, cross, frozen
from synergrip.values import ByContent

SMALLEST = 1e-12
"""A characteristic length below this is rounding [m]."""


@dataclass(frozen=True, eq=False)
class Scale(ByContent):
    """Scaled coordinates, marked ~: ``u~ = motion u``, ``w~ = motion^-T w``, ``lambda~ = force lambda``."""

    length: float
    """Characteristic length [m]."""
    centroid: Array
    """(3,) centroid of the contacts from B [m]."""
    motion: Array
    """(6, 6): velocity of the centroid, and rotation times length [m]."""
    force: Array
    """(n_l,) diagonal: 1 for forces, 1 / length for moments."""

    def wrench(self, w: Array) -> Array:
        """Return wrenches (..., 6) in scaled coordinates [N]."""
        return np.asarray(np.linalg.solve(self.motion.T, np.asarray(w).T).T)

    def largest_force(self, forces: Array) -> float:
        """Return the largest component of contact forces (..., n_l), spin moments divided by the length [N]."""
        return float(np.abs(forces * self.force).max(initial=0.0))

    def twist(self, u: Array) -> Array:
        """Return twists (..., 6) in scaled coordinates [m]."""
        return np.asarray(np.asarray(u) @ self.motion.T)


def scale_of(grasp: Grasp) -> Scale:
    """Return the scale of a grasp from its contact points."""
    points = np.array([contact.point for contact in grasp.contacts])
    centroid = points.mean(axis=0)
    length = float(np.linalg.norm(points - centroid, axis=1).mean())
    if not length > max(SMALLEST, 1e-9 * float(np.linalg.norm(centroid))):
        length = 1.0  # all contacts on one spot: no length to speak of
    motion = np.eye(6)
    motion[:3, 3:] = -cross(centroid)
    motion[3:] *= length
    force = [1.0 / length if is_moment(component) else 1.0 for _, component in grasp.components]
    return Scale(length, frozen(centroid), frozen(motion), frozen(force))
