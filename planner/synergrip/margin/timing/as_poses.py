"""A timing as poses at instants: a path of the palm that is planned like any other."""

from __future__ import annotations

import numpy as np

from synergrip.linalg import Array, frozen
from synergrip.margin.timing.by_length import Leg, seconds_of
from synergrip.tasks.palm_path import PalmPath, as_rows

LEAST_LINES = 12
"""Of a leg."""
TURN = np.radians(5)
"""By which the palm turns from one line to the next, on the average, at most."""
MOST_LINES = 400


def as_poses(path: tuple[Leg, ...], b: Array, fewest: int) -> tuple[PalmPath, Array]:
    """Return the path over time, and the length passed at each of its lines.

    Acceleration jumps in a timing, and in a spline through poses it does not. At each line it is therefore the mean
    over a step of time around it, and in between it is linear: the speed at the ends of steps is that of the timing,
    the way differs by the square of a step, and what is missing of it is made up by going on a little longer.

    Args:
        path: legs between stops.
        b: (n + 1,) squares of the speed at the grid points [m^2/s^2].
        fewest: lines of the whole path; more where the palm turns far.
    """
    speeds, first = np.sqrt(b), 0
    seconds = seconds_of(np.concatenate([np.diff(leg.at) for leg in path]), b)
    count = _lines(path, fewest)
    times, poses, passed = [np.zeros(1)], [_poses(path[0], np.zeros(1))], [np.zeros(1)]
    for leg in path:
        last = first + len(leg.at) - 1
        own = np.concatenate([[0.0], np.cumsum(seconds[first:last])])
        lines = max(LEAST_LINES, round(count * own[-1] / seconds.sum()))
        at, way = _smooth(own, speeds[first : last + 1], leg.length, lines)
        times.append(times[-1][-1] + at[1:])
        passed.append(passed[-1][-1] + way[1:])
        poses.append(_poses(leg, way[1:]))
        first = last
    return PalmPath(np.concatenate(times), np.vstack(poses), inertia=True), frozen(np.concatenate(passed))


def _lines(path: tuple[Leg, ...], fewest: int) -> int:
    turned = sum(float(np.linalg.norm(leg.palm.rotation_rates(leg.at)[0], axis=1).mean()) * leg.length for leg in path)
    return int(np.clip(turned / TURN, fewest, MOST_LINES))


def _smooth(times: Array, speeds: Array, length: float, count: int) -> tuple[Array, Array]:
    """Return instants from 0 on, evenly spaced, and the length passed at each of them.

    Args:
        times: (k,) from 0 on [s].
        speeds: (k,) linear between these, 0 at both ends [m/s].
        length: of the whole way [m].
        count: of steps.
    """
    at = np.linspace(0.0, float(times[-1]), count + 1)
    step = at[1]
    edges = np.concatenate([[0.0], at[:-1] + step / 2, at[-1:]])
    mean = np.diff(np.interp(edges, times, speeds)) / np.diff(edges)
    speed = np.concatenate([[0.0], np.cumsum(step * (mean[:-1] + mean[1:]) / 2)])
    way = np.concatenate([[0.0], np.cumsum(speed[:-1] * step + step**2 * (2 * mean[:-1] + mean[1:]) / 6)])
    longer = length / way[-1]  # the same accelerations over a way and a time that are longer
    return at * np.sqrt(longer), np.clip(way * longer, 0.0, length)


def _poses(leg: Leg, at: Array) -> Array:
    return as_rows(np.asarray(leg.palm.poses(at)))
