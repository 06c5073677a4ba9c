"""Named moves of the object and turns of the palm, over the time of the task."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.polynomial import Polynomial

from synergrip.errors import InputError
from synergrip.linalg import Array, frozen
from synergrip.plans.reading.task_file import MoveTable, PalmTable
from synergrip.plans.task import Wanted

PROFILES = {
    "linear": Polynomial([0, 1]),
    "cubic": Polynomial([0, 0, 3, -2]),
    "min-jerk": Polynomial([0, 0, 0, 10, -15, 6]),
}
"""Course from 0 to 1 over the share of the time that has passed."""


def profile(name: str, times: Array) -> Array:
    """Return the course (T,) from 0 at the first knot to 1 at the last; a single knot is the end."""
    if len(times) == 1:
        return np.ones(1)
    return np.asarray(PROFILES[name]((times - times[0]) / (times[-1] - times[0])))


def moved(moves: Sequence[MoveTable], times: Array) -> Wanted:
    """Return the sum of the moves: displacements about B, or coordinates of Gamma_ucs.

    Raises:
        InputError: moves along axes and along modes are mixed.
    """
    by_mode = [move for move in moves if move.mode is not None]
    if by_mode and len(by_mode) < len(moves):
        raise InputError.at("task.move", "moves along an axis and moves along a mode cannot be mixed")
    if by_mode:
        beta = np.zeros((len(times), max(move.mode or 0 for move in by_mode)))
        for move in by_mode:
            beta[:, (move.mode or 1) - 1] += (move.amplitude or 0.0) * profile(move.profile, times)
        return Wanted("mode moves", frozen(beta), "task.move")
    motion = np.zeros((len(times), 6))
    for move in moves:
        axis = np.asarray(move.axis, dtype=float)
        whole = np.concatenate([(move.lift or 0.0) * axis, (move.roll or 0.0) * axis])
        motion += profile(move.profile, times)[:, None] * whole
    return Wanted("motion", frozen(motion), "task.move")


def turned(gravity: Array, palm: PalmTable | None, times: Array) -> Array:
    """Return gravity (T, 3) in the palm frame while the palm turns: ``R(axis, -angle) gravity`` (Rodrigues)."""
    if palm is None:
        return np.tile(gravity, (len(times), 1))
    axis = np.asarray(palm.axis, dtype=float)
    angle = -palm.turn * profile(palm.profile, times)[:, None]
    return np.asarray(
        gravity * np.cos(angle)
        + np.cross(axis, gravity) * np.sin(angle)
        + axis * (axis @ gravity) * (1 - np.cos(angle))
    )
