"""The palm on the path of an arm: poses at some instants, and a smooth way between them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from synergrip.documents.naming import naming_arguments
from synergrip.documents.quantities import in_mm, plain
from synergrip.documents.time_table import MOTION, read_table
from synergrip.linalg import Array, frozen
from synergrip.tasks.arguments import Numbers, Rows, TaskArguments, keep
from synergrip.tasks.inertia import Inertia, inertia
from synergrip.tasks.marks import SAME_TIME
from synergrip.tasks.palm_in_world import acceleration_of
from synergrip.tasks.profiles import SHORTEST
from synergrip.tasks.stated import Load, Setting

if TYPE_CHECKING:
    from scipy.interpolate import CubicSpline
    from scipy.spatial.transform import Rotation

LEAST_LINES, LEAST_LINES_WITH_INERTIA = 2, 4
"""A cubic spline through fewer than 4 points is a parabola or a line: its acceleration is made up."""
LARGEST_TURN = np.pi / 2
"""From one line to the next [rad]. Beyond half a turn it would count as the smaller one the other way round, and near
that the way between the lines is a guess; this leaves room for both."""


@naming_arguments
@dataclass(frozen=True, eq=False)
class PalmPath(Load):
    """The palm goes through poses, as on an arm, with gravity fixed in the world.

    Args:
        times: (K,) increasing instants that cover the task [s].
        poses: (K, 6) position [m] and rotation vector [rad] of the palm frame in any fixed frame.
        inertia: whether the object loads the grasp by its inertia.

    Raises:
        InputError: too few poses, poses that are less than a microsecond apart, or a turn between two poses that is
            too large to tell which way it goes.

    Example:
        >>> PalmPath([0.0, 1.0], [[0, 0, 0, 0, 0, 0], [0, 0, 0.2, 0, 0, 0]])
        PalmPath(2 poses from 0 s to 1 s)
    """

    times: Numbers
    poses: Rows
    inertia: bool = False
    moving = True

    def __post_init__(self) -> None:
        """Judge the arguments, and the way between the poses."""
        judge = TaskArguments("PalmPath")
        times = judge.times("times", self.times)
        poses = judge.rows("poses", self.poses, (len(times), 6), "x, y, z [m] and a rotation vector [rad] in each row")
        judge.flag("inertia", self.inertia)
        if not judge.issues:
            _judge_path(judge, times, poses, self.inertia)
        keep(self, judge, times=times, poses=poses)

    def __repr__(self) -> str:
        """Return one line."""
        kind = ", inertia=True" if self.inertia else ""
        return f"PalmPath({len(self.times)} poses from {self.times[0]:g} s to {self.times[-1]:g} s{kind})"

    @classmethod
    def from_csv(cls, path: str | Path, *, inertia: bool = False, key: str = "") -> PalmPath:
        """Return the path in a CSV file with the header ``t_s,x_m,y_m,z_m,rx_rad,ry_rad,rz_rad``.

        Args:
            path: the file.
            inertia: whether the object loads the grasp by its inertia.
            key: what names the file, for errors.

        Raises:
            InputError: no such file, or one that is no such table, with line and column.
        """
        table = read_table(Path(path), MOTION, key)
        return cls(table.times, table.values, inertia)

    @property
    def lines(self) -> Array:
        """The instants of its poses."""
        return np.asarray(self.times)

    @property
    def curved(self) -> bool:
        """True: it is a spline between its poses."""
        return True

    def stretched(self, factor: float) -> PalmPath:
        """Return the same way at times that are multiplied: accelerations are divided by the square of the factor."""
        return replace(self, times=factor * np.asarray(self.times))

    def motion(self, start: float, end: float) -> PalmSpline:
        """Return the motion in a task from `start` to `end` [s]."""
        return spline(np.asarray(self.times), np.asarray(self.poses), start, end)

    def over(self, setting: Setting) -> Inertia | None:
        """Return the load by inertia at any time; None without inertia.

        Raises:
            InputError: it needs a mass, or time to move.
        """
        return inertia(setting.body, self.motion(setting.start, setting.end)) if self.inertia else None


@dataclass(frozen=True, eq=False)
class PalmSpline:
    """The pose of the palm in some fixed frame, as a spline; only what it does from the start of the task counts.

    A point p of the palm is at ``R_0' (x - x_0) + R_0' R p`` in the palm frame at the start.
    """

    poses: CubicSpline
    """(T, 7): position of the origin [m], and a quaternion (vector, scalar) whose direction is the rotation R."""
    corners: Array  # (K,) [s] start and end of the task, and the lines between them
    upright: Array  # (3, 3) R_0, the rotation at the start

    @property
    def in_words(self) -> str:
        """How far from its start the palm gets at the lines of its path."""
        from scipy.spatial.transform import Rotation

        poses = self.poses(self.corners)
        shift = np.linalg.norm(poses[:, :3] - poses[0, :3], axis=1).max()
        turned = Rotation.from_quat(poses[:, 3:]) * Rotation.from_quat(poses[0, 3:]).inv()
        turn = float(np.degrees(turned.magnitude().max()))
        return f"goes up to {in_mm(float(shift))} and {plain(turn, 3)} deg from its start, on a path"

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

    def velocity(self, point: Array, times: Array) -> Array:
        """Return the velocity (T, 3) [m/s], in the palm frame, of a point (3,) [m] fixed to the palm."""
        omega, _ = self.rotation_rates(times)
        return self._from_file(self.poses(times, 1)[:, :3], times) + np.cross(omega, point)

    def _from_file(self, vectors: Array, times: Array) -> Array:
        """Return vectors (3,) or (T, 3) of the frame of the file in the palm frame (T, 3): ``R' v``."""
        from scipy.spatial.transform import Rotation

        return np.asarray(Rotation.from_quat(self.poses(times)[:, 3:]).inv().apply(vectors))


def spline(times: Array, given: Array, start: float, end: float) -> PalmSpline:
    """Return the motion of the palm through poses (K, 6) at `times` (K,), in a task from `start` to `end` [s].

    The quaternions are a spline component by component, like the position. The same path in another frame has
    quaternions that are turned as vectors, so that its spline is the same path, too.
    """
    # Not scipy's RotationSpline: at both ends it takes the mean rate of the first and last interval for the rate there,
    # which makes the angular acceleration wrong by more than its own size, however close the lines are.
    from scipy.interpolate import CubicSpline
    from scipy.spatial.transform import Rotation

    poses = CubicSpline(times, np.hstack([given[:, :3], _quaternions(rotations_of(given))]))
    inside = times[(times > start) & (times < end)]
    upright = Rotation.from_quat(poses(start)[3:]).as_matrix()
    return PalmSpline(poses, frozen([start, *inside, end]), frozen(upright))


def rotations_of(poses: Array) -> Rotation:
    """Return the rotations (K,) of the palm in the frame that its poses (K, 6) are given in."""
    from scipy.spatial.transform import Rotation

    return Rotation.from_rotvec(poses[:, 3:].copy())  # it refuses arrays that are read-only


def as_rows(poses: Array) -> Array:
    """Return poses (K, 6), positions and rotation vectors, of poses (K, 7), positions and quaternions."""
    from scipy.spatial.transform import Rotation

    return np.hstack([poses[:, :3], Rotation.from_quat(poses[:, 3:]).as_rotvec()])


def _quaternions(rotations: Rotation) -> Array:
    """Return quaternions (K, 4), vector first; of p and -p, the same rotation, each time the nearer to the last one."""
    found = rotations.as_quat()
    signs = np.where(np.sum(found[1:] * found[:-1], axis=1) < 0, -1.0, 1.0)
    return np.asarray(found * np.cumprod([1.0, *signs])[:, None])


def _vector_between(p: Array, r: Array) -> Array:
    """Return the vector part (T, 3) of the product ``p* r`` of quaternions (T, 4), vector first."""
    return np.asarray(p[:, 3:] * r[:, :3] - r[:, 3:] * p[:, :3] - np.cross(p[:, :3], r[:, :3]))


def _judge_path(judge: TaskArguments, times: Array, poses: Array, inertia: bool) -> None:
    """Note what does not say how the palm moves between its poses."""
    if len(times) < (LEAST_LINES_WITH_INERTIA if inertia else LEAST_LINES):
        needed = f"a path takes at least {LEAST_LINES} lines"
        if inertia:
            needed = f"the load by inertia needs accelerations, which take at least {LEAST_LINES_WITH_INERTIA} lines"
        judge.refuse("times", f"{needed} of a pose each, got {len(times)}")
        return
    steps, rotations = np.diff(times), rotations_of(poses)
    if steps.min() < SHORTEST:
        at = times[steps.argmin()]
        judge.refuse("times", f"lines must be at least 1 us apart; after {at:g} s it is {1e6 * steps.min():.3g} us")
    turns = np.atleast_1d((rotations[:-1].inv() * rotations[1:]).magnitude())
    if turns.max() > LARGEST_TURN * (1 + SAME_TIME):
        index = int(turns.argmax())
        message = (
            f"the palm turns by {np.degrees(turns[index]):.3g} deg from {times[index]:g} s to "
            f"{times[index + 1]:g} s, and which way is not clear; write lines between them, so that it is at "
            "most 90 deg from one to the next"
        )
        judge.refuse("poses", message)
