"""Named moves of the object over the time of the task."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from synergrip.errors import InputError
from synergrip.linalg import Array, frozen
from synergrip.plans.marks import Marks, together
from synergrip.plans.reading.motion_tables import MoveTable
from synergrip.plans.reading.profiles import Course


@dataclass(frozen=True, eq=False)
class Moves:
    """Motions that add up."""

    parts: tuple[tuple[Course, Array], ...]
    """The course of each, and where it leads: (6,) displacement about B [m, rad], or (m,) coordinates of Gamma_ucs."""
    along_modes: bool

    def at(self, times: Array) -> Array:
        """Return the wanted motion (T, 6) or (T, m) at any times (T,) [s]."""
        return np.asarray(sum(np.outer(course.at(times), whole) for course, whole in self.parts))

    @property
    def marks(self) -> Marks:
        """Those of their courses."""
        return together(course.marks for course, _ in self.parts)


def moved(moves: Sequence[MoveTable], start: float, end: float) -> Moves:
    """Return the sum of one or more moves in a task from `start` to `end` [s].

    Raises:
        InputError: moves along axes and along modes are mixed.
    """
    by_mode = [move for move in moves if move.mode is not None]
    if by_mode and len(by_mode) < len(moves):
        raise InputError.at("task.move", "moves along an axis and moves along a mode cannot be mixed")
    width = max((move.mode or 0 for move in by_mode), default=6)
    parts = tuple((Course(move.profile, start, end), _whole(move, width)) for move in moves)
    return Moves(parts, along_modes=bool(by_mode))


def _whole(move: MoveTable, width: int) -> Array:
    """Return where a move leads."""
    if move.mode is not None:
        return frozen((move.amplitude or 0.0) * np.eye(1, width, move.mode - 1)[0])
    axis = np.asarray(move.axis, dtype=float)
    return frozen(np.concatenate([(move.lift or 0.0) * axis, (move.roll or 0.0) * axis]))
