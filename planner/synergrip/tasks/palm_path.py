"""The palm on the path of an arm: poses at some instants, and a smooth way between them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from synergrip.documents.time_table import Table
from synergrip.linalg import Array, frozen
from synergrip.tasks.palm_motion import acceleration_of

if TYPE_CHECKING:
    from scipy.interpolate import CubicSpline
    from scipy.spatial.transform import Rotation


@dataclass(frozen=True, eq=False)
class PalmPath:
    """The pose of the palm in some fixed frame, as a spline; only what it does from the start of the task counts.

    A point p of the palm is at ``R_0' (x - x_0) + R_0' R p`` in the palm frame at the start.
    """

    poses: CubicSpline
    """(T, 7): position of the origin [m], and a quaternion (vector, scalar) whose direction is the rotation R."""
    corners: Array  # (K,) [s] start and end of the task, and the lines between them
    upright: Array  # (3, 3) R_0, the rotation at the start

    def seen(self, vectors: Array, times: Array) -> Array:
        """Return vectors (3,) or (T, 3) of the palm frame at the start in the palm frame (T, 3): ``R' R_0 v``."""
        return self._from_file(vectors @ self.upright.T, times)

    def rotation_rates(self, times: Array) -> tuple[Array, Array]:
        """Return angular velocity (T, 3) [rad/s] and acceleration (T, 3) [rad/s^2], in the palm frame.

        For a quaternion p of any size, ``omega = 2 vec(p* p') / |p|^2``. As p'* p' has no vector part, the derivative
        is ``alpha = 2 vec(p* p'') / |p|^2 - 2 (p . p') / |p|^2 omega``.
        """
        p, rate, bend = (self.poses(times, derivative)[:, 3:] for derivative in range(3))
        square = np.sum(p * p, axis=1, keepdims=True)
        omega = 2 * _vector_between(p, rate) / square
        alpha = 2 * (_vector_between(p, bend) - np.sum(p * rate, axis=1, keepdims=True) * omega) / square
        return omega, alpha

    def acceleration(self, point: Array, times: Array) -> Array:
        """Return the acceleration (T, 3) [m/s^2], in the palm frame, of a point (3,) [m] fixed to the palm."""
        origin = self._from_file(self.poses(times, 2)[:, :3], times)
        return acceleration_of(point, origin, *self.rotation_rates(times))

    def _from_file(self, vectors: Array, times: Array) -> Array:
        """Return vectors (3,) or (T, 3) of the frame of the file in the palm frame (T, 3): ``R' v``."""
        from scipy.spatial.transform import Rotation

        return np.asarray(Rotation.from_quat(self.poses(times)[:, 3:]).inv().apply(vectors))


def palm_path(table: Table, start: float, end: float) -> PalmPath:
    """Return the motion of the palm along a table with the columns `MOTION`, in a task from `start` to `end` [s].

    The quaternions are a spline component by component, like the position. The same path in another frame has
    quaternions that are turned as vectors, so that its spline is the same path, too.
    """
    # Not scipy's RotationSpline: at both ends it takes the mean rate of the first and last interval for the rate there,
    # which makes the angular acceleration wrong by more than its own size, however close the lines are.
    from scipy.interpolate import CubicSpline
    from scipy.spatial.transform import Rotation

    poses = CubicSpline(table.times, np.hstack([table.values[:, :3], _quaternions(rotations_of(table))]))
    inside = table.times[(table.times > start) & (table.times < end)]
    upright = Rotation.from_quat(poses(start)[3:]).as_matrix()
    return PalmPath(poses, frozen([start, *inside, end]), frozen(upright))


def rotations_of(table: Table) -> Rotation:
    """Return the rotations (K,) of the palm in the frame of the file."""
    from scipy.spatial.transform import Rotation

    return Rotation.from_rotvec(table.values[:, 3:].copy())  # it refuses arrays that are read-only


def _quaternions(rotations: Rotation) -> Array:
    """Return quaternions (K, 4), vector first; of p and -p, the same rotation, each time the nearer to the last one."""
    found = rotations.as_quat()
    signs = np.where(np.sum(found[1:] * found[:-1], axis=1) < 0, -1.0, 1.0)
    return np.asarray(found * np.cumprod([1.0, *signs])[:, None])


def _vector_between(p: Array, r: Array) -> Array:
    """Return the vector part (T, 3) of the product ``p* r`` of quaternions (T, 4), vector first."""
    return np.asarray(p[:, 3:] * r[:, :3] - r[:, 3:] * p[:, :3] - np.cross(p[:, :3], r[:, :3]))
