"""The length that makes newtons and newton metres, metres and radians comparable.

Ranks and norms must depend neither on the units nor on where the user put the object frame
(docs/theory.md). So moments and rotations are scaled by the mean distance of the contacts
from their centroid, and twists and wrenches are taken about that centroid.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from synergrip.grasps.contacts.kind import is_moment
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, frozen
from synergrip.values import Value

SMALLEST = 1e-12
"""A characteristic length below this is rounding [m]."""


@dataclass(frozen=True, eq=False, repr=False)
class Metric(Value):
    """Scaled coordinates, marked ~, of one grasp or of many (leading axes ...): ``u~ = motion u``.

    Of wrenches and contact forces ``w~ = motion^-T w``, ``lambda~ = force lambda``.
    """

    motion: Array
    """(..., 6, 6): velocity of the centroid, and rotation times length [m]."""
    force: Array
    """(..., n_l) diagonal: 1 for forces, 1 / length for spin moments."""

    @property
    def motion_sizes(self) -> Array:
        """(..., 6): 1 for velocities, the length [m] for rotations."""
        return np.asarray(np.diagonal(self.motion, axis1=-2, axis2=-1))

    def scaled_wrenches(self, w: Array) -> Array:
        """Return wrenches (..., 6), one for each grasp, in scaled coordinates [N]: ``motion^-T w``."""
        about = w[..., 3:] - (self.motion[..., :3, 3:].mT @ w[..., :3, None])[..., 0]
        return np.concatenate([w[..., :3], about / self.motion[..., 3:4, 3]], axis=-1)

    def taken(self, places: Any) -> Metric:
        """Return the coordinates of some grasps of a stack."""
        return Metric(self.motion[places], self.force[places])

    def scaled_rows(self, rows: Array) -> Array:
        """Return `rows` (..., n_l, n), which make contact motions of n numbers, for scaled contact motions."""
        return rows / self.force[..., None]

    def scaled_grasp(self, G: Array) -> Array:
        """Return G' (..., n_l, 6) from scaled object motions to scaled contact motions; G is (..., 6, n_l)."""
        forces, moments, arm = G[..., :3, :].mT, G[..., 3:, :].mT, self.motion[..., :3, 3:]
        return self.scaled_rows(
            np.concatenate([forces, (moments - forces @ arm) / self.motion[..., 3:4, 3:4]], axis=-1)
        )


@dataclass(frozen=True, eq=False, repr=False)
class Scale(Metric):
    """The scaled coordinates of one grasp, and what they are made of."""

    length: float
    """Characteristic length [m]."""
    centroid: Array
    """(3,) centroid of the contacts from B [m]."""

    @cached_property
    def of_wrench(self) -> Array:
        """(6, 6) by which wrenches are multiplied from the right: ``motion^-1``."""
        return frozen(self.scaled_wrenches(np.eye(6)))

    def wrench(self, w: Array) -> Array:
        """Return wrenches (..., 6) in scaled coordinates [N]."""
        return np.asarray(w @ self.of_wrench)

    def largest_force(self, forces: Array) -> float:
        """Return the largest component of contact forces (..., n_l), spin moments divided by the length [N]."""
        return float(np.abs(forces * self.force).max(initial=0.0))

    def twist(self, u: Array) -> Array:
        """Return twists (..., 6) in scaled coordinates [m]."""
        return np.asarray(np.asarray(u) @ self.motion.T)


def scale_of(grasp: Grasp) -> Scale:
    """Return the scale of a grasp from its contact points."""
    points = np.array([contact.point for contact in grasp.contacts])
    metric, length, centroid = metric_of(points, [component for _, component in grasp.components])
    return Scale(frozen(metric.motion), frozen(metric.force), float(length), frozen(centroid))


def metric_of(points: Array, components: Sequence[str]) -> tuple[Metric, Array, Array]:
    """Return the scaled coordinates from contact points.

    Args:
        points: (..., n_c, 3) from B [m].
        components: which of `COMPONENTS` each of the n_l force components is.

    Returns:
        the coordinates, the characteristic lengths (...) [m] and the centroids (..., 3) from B [m].
    """
    centroid = points.mean(axis=-2)
    length = np.linalg.norm(points - centroid[..., None, :], axis=-1).mean(axis=-1)
    least = np.maximum(SMALLEST, 1e-9 * np.linalg.norm(centroid, axis=-1))
    length = np.where(length > least, length, 1.0)  # all contacts on one spot: no length to speak of
    motion = np.zeros((*length.shape, 6, 6))
    motion[..., range(3), range(3)] = 1.0
    motion[..., range(3, 6), range(3, 6)] = length[..., None]
    x, y, z = np.moveaxis(centroid, -1, 0)
    for row, column, arm in ((0, 4, z), (1, 5, x), (2, 3, y)):
        motion[..., row, column] = arm
        motion[..., column - 3, row + 3] = -arm
    spins = np.array([is_moment(component) for component in components])
    return Metric(motion, np.where(spins, 1.0 / length[..., None], 1.0)), length, centroid
