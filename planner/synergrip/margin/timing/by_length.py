"""The path of a palm by its length, however it was timed, in legs between the points where it must stop."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from synergrip.linalg import Array, frozen
from synergrip.tasks.palm_motion import Palm, PalmMotion
from synergrip.tasks.palm_path import PalmPath, PalmSpline, as_rows, rotations_of, spline
from synergrip.values import Value

LOOKS = 4000
"""At how many instants a path is looked at, evenly spread over its lines."""
NEAR = 1e-4
"""Share of the path below which poses are the same: a palm that is at rest wavers by what its file is rounded to."""
CORNER = 0.5
"""Cosine of the turn from one step to the next from which on a path has a corner, at which the palm must stop."""
LEAST_PARTS = 16
"""Of a leg."""


@dataclass(frozen=True, eq=False, repr=False)
class Leg(Value):
    """A part of the path with a tangent everywhere: the palm starts and stops at its ends."""

    palm: PalmSpline
    """The pose over the length, in place of time: of a motion at unit speed."""
    at: Array  # (n + 1,) lengths of the grid, from 0 on [m]; rotations count by the grasp's length

    @property
    def length(self) -> float:
        """The whole of it [m]."""
        return float(self.at[-1])


def legs(load: Palm | PalmPath, start: float, end: float, unit: float, parts: int) -> tuple[Leg, ...]:
    """Return the path of a palm by its length; none where it stays where it is.

    The length is that of ``(x, 2 unit p)`` with the position x [m] and the unit quaternion p: along it both move by
    ``sqrt(|v|^2 + unit^2 |omega|^2)`` a second.

    Args:
        load: what moves the palm.
        start: of the task [s].
        end: of the task [s].
        unit: length by which rotations count [m].
        parts: into how many the path is divided, in all.
    """
    points = _apart(_points(load, start, end, unit))
    if len(points) < 2:
        return ()
    steps = np.diff(points, axis=0)
    lengths = np.linalg.norm(steps, axis=1)
    along = steps / lengths[:, None]
    corners = 1 + np.flatnonzero(np.sum(along[1:] * along[:-1], axis=1) < CORNER)
    total, found = float(lengths.sum()), list[Leg]()
    for first, last in pairwise([0, *corners.tolist(), len(points) - 1]):
        count = max(LEAST_PARTS, round(parts * float(lengths[first:last].sum()) / total))
        found.append(_leg(points[first : last + 1], unit, count))
    upright = found[0].palm.upright
    return tuple(replace(leg, palm=replace(leg.palm, upright=upright)) for leg in found)


def seconds_of(parts: Array, b: Array) -> Array:
    """Return (n,) how long each part takes [s]: lengths (n,) [m], squares of the speed (n + 1,) at their ends."""
    speeds = np.sqrt(b)
    return np.asarray(2 * parts / (speeds[:-1] + speeds[1:]))


def passed_as_given(load: Palm | PalmPath, start: float, end: float, unit: float, parts: int) -> Array:
    """Return (parts + 1,) which share of the way is passed after equal parts of the time that the task takes as asked.

    Arguments as of `legs`; `parts` of the time.
    """
    times = np.linspace(start, end, parts + 1)
    motion = load.motion(start, end)
    if isinstance(motion, PalmMotion):
        return frozen(motion.profile.at(times))
    dense = np.linspace(start, end, LOOKS + 1)
    poses = np.asarray(motion.poses(dense))
    poses[:, 3:] *= 2 * unit / np.linalg.norm(poses[:, 3:], axis=1, keepdims=True)
    lengths = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(poses, axis=0), axis=1))])
    return frozen(np.interp(times, dense, lengths / lengths[-1]))


def _points(load: Palm | PalmPath, start: float, end: float, unit: float) -> Array:
    """Return (K, 7) positions and quaternions times twice the unit on the way, as dense as it takes."""
    if isinstance(load, Palm):  # the same pose after the same share of the way, whatever the profile
        share = np.linspace(0.0, 1.0, LOOKS + 1)[:, None]
        shift = np.zeros(3) if load.shift is None else np.asarray(load.shift)
        turn = np.zeros(3) if load.axis is None else float(load.turn or 0.0) * np.asarray(load.axis)
        ends = np.hstack([share * shift, share * turn])
        quaternions = rotations_of(ends).as_quat()
        signs = np.where(np.sum(quaternions[1:] * quaternions[:-1], axis=1) < 0, -1.0, 1.0)
        poses = np.hstack([ends[:, :3], quaternions * np.cumprod([1.0, *signs])[:, None]])
    else:
        motion = load.motion(start, end)
        each = max(LOOKS // (len(motion.corners) - 1), 8)
        inner = [np.linspace(a, b, each, endpoint=False) for a, b in pairwise(motion.corners)]
        poses = np.asarray(motion.poses(np.append(np.concatenate(inner), end)))
        poses[:, 3:] /= np.linalg.norm(poses[:, 3:], axis=1, keepdims=True)
    return np.hstack([poses[:, :3], 2 * unit * poses[:, 3:]])


def _apart(points: Array) -> Array:
    """Return those of the points (K, 7) that are away from the one before, and the last one."""
    near = NEAR * float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())
    kept = [0]
    for i in range(1, len(points)):
        if np.linalg.norm(points[i] - points[kept[-1]]) > near:
            kept.append(i)
    if kept[-1] != len(points) - 1 and len(kept) > 1:
        kept[-1] = len(points) - 1
    return points[kept]


def _leg(points: Array, unit: float, parts: int) -> Leg:
    """Return the smooth way through points (K, 7), anew through poses that are evenly apart: at unit speed."""
    from scipy.interpolate import CubicSpline

    lengths = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    first = CubicSpline(lengths, points) if len(points) > 2 else lambda at: _straight(points, lengths, at)
    at = np.linspace(0.0, float(lengths[-1]), parts + 1)
    even = np.asarray(first(at))
    poses = as_rows(np.hstack([even[:, :3], even[:, 3:] / (2 * unit)]))
    return Leg(spline(at, poses, 0.0, float(at[-1])), frozen(at))


def _straight(points: Array, lengths: Array, at: Array) -> Array:
    share = (at / lengths[-1])[:, None]
    return np.asarray((1 - share) * points[0] + share * points[-1])
