"""Named moves of the object over the time of the task."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from synergrip.documents.judging import described, is_whole
from synergrip.documents.naming import naming_arguments
from synergrip.linalg import Array, frozen
from synergrip.tasks.arguments import Numbers, TaskArguments, keep
from synergrip.tasks.marks import Marks, together
from synergrip.tasks.profiles import PROFILES, ProfileName, Rise
from synergrip.tasks.stated import Motion, Setting

MOST_MODES = 6


class _Addable(Motion):
    """A move, which adds up with others."""

    moving = True

    def __add__(self, other: _Addable) -> Moves:
        """Return both moves at once."""
        return Moves((*_parts(self), *_parts(other)))

    def __radd__(self, other: object) -> Moves:
        """Return the move itself for the 0 that `sum` starts with."""
        return Moves(_parts(self)) if isinstance(other, int) and other == 0 else Moves((other, *_parts(self)))  # type: ignore[arg-type]

    def over(self, setting: Setting) -> Moving:
        """Return the motion (T, m) at any time of a task."""
        parts = _parts(self)
        width = max((part.mode for part in parts if isinstance(part, ModeMove)), default=6)
        rises = ((Rise(part.profile, setting.start, setting.end), part.leads_to(width)) for part in parts)
        return Moving(tuple(rises))


@naming_arguments
@dataclass(frozen=True, kw_only=True)
class Move(_Addable):
    """A displacement along an axis and a rotation about it, from the start of the task to its end.

    Args:
        axis: in the palm frame: "x", "y", "z" or 3 numbers.
        lift: displacement along the axis [m]; None for none.
        roll: rotation about the axis through B [rad]; None for none.
        profile: in time: "min-jerk", "cubic" or "linear".

    Raises:
        InputError: no direction, or neither lift nor roll.

    Example:
        >>> both = Move(axis="z", lift=0.01) + Move(axis="x", roll=0.1)
        >>> len(both.parts)
        2
    """

    axis: str | Numbers
    lift: float | None = None
    roll: float | None = None
    profile: ProfileName = "min-jerk"

    def __post_init__(self) -> None:
        """Judge the arguments."""
        judge = TaskArguments("Move")
        axis = judge.direction("axis", self.axis)
        lift = None if self.lift is None else judge.real("lift", self.lift, unit="m")
        roll = None if self.roll is None else judge.angle("roll", self.roll)
        if lift is None and roll is None:
            judge.refuse("lift", "a move along an axis needs lift [m] or roll [rad], for example lift=0.01")
        judge.word("profile", self.profile, tuple(PROFILES))
        keep(self, judge, axis=axis, lift=lift, roll=roll)

    def leads_to(self, width: int) -> Array:
        """Return the displacement (6,) at the end [m, rad]."""
        axis = np.asarray(self.axis, dtype=float)
        return frozen(np.concatenate([(self.lift or 0.0) * axis, (self.roll or 0.0) * axis]))


@naming_arguments
@dataclass(frozen=True, kw_only=True)
class ModeMove(_Addable):
    """A move along one of the rigid motions that the synergies can produce, from the start of the task to its end.

    Args:
        mode: number of the motion, a column of Gamma_ucs, from 1.
        amplitude: how far [m].
        profile: in time: "min-jerk", "cubic" or "linear".

    Raises:
        InputError: no such mode, or an amplitude that is no number.

    Example:
        >>> ModeMove(mode=1, amplitude=0.01).kind
        'mode moves'
    """

    mode: int
    amplitude: float
    profile: ProfileName = "min-jerk"

    def __post_init__(self) -> None:
        """Judge the arguments."""
        judge = TaskArguments("ModeMove")
        whole = is_whole(self.mode)
        if not whole or not 1 <= self.mode <= MOST_MODES:
            judge.refuse("mode", f"expected a whole number from 1 to {MOST_MODES}, got {described(self.mode)}")
        amplitude = judge.real("amplitude", self.amplitude, unit="m")
        judge.word("profile", self.profile, tuple(PROFILES))
        keep(self, judge, mode=int(self.mode) if whole else 0, amplitude=amplitude)

    @property
    def kind(self) -> Literal["mode moves"]:
        """Coordinates of Gamma_ucs; those that are not there stand for zero."""
        return "mode moves"

    def leads_to(self, width: int) -> Array:
        """Return the coordinates (width,) at the end [m]."""
        return frozen(self.amplitude * np.eye(1, width, self.mode - 1)[0])


@dataclass(frozen=True)
class Moves(_Addable):
    """Moves that add up, all of them along axes or all along modes.

    Args:
        parts: the moves.

    Raises:
        InputError: no move, something else, or moves of both kinds.

    Example:
        >>> Moves((Move(axis="z", lift=0.01), Move(axis="x", roll=0.1))).kind
        'motion'
    """

    parts: tuple[Move | ModeMove, ...]

    def __post_init__(self) -> None:
        """Judge the parts."""
        judge = TaskArguments("Moves")
        parts = tuple(self.parts) if isinstance(self.parts, list | tuple) else (self.parts,)
        kinds = {type(part) for part in parts}
        if not kinds or not kinds <= {Move, ModeMove}:
            odd = next((part for part in parts if not isinstance(part, Move | ModeMove)), None)
            judge.refuse(
                "parts", f"expected one or more of Move and ModeMove, got {described(odd) if parts else 'none'}"
            )
        elif len(kinds) > 1:
            judge.refuse("parts", "moves along an axis and moves along a mode cannot be mixed")
        keep(self, judge, parts=parts)

    @property
    def kind(self) -> Literal["hold", "motion", "modes", "mode moves"]:
        """That of its parts."""
        return self.parts[0].kind


def _parts(move: object) -> tuple[Move | ModeMove, ...]:
    """Return the moves of a sum, or the only one; something else is judged by `Moves`."""
    return move.parts if isinstance(move, Moves) else (move,)  # type: ignore[return-value]


@dataclass(frozen=True, eq=False)
class Moving:
    """Motions that add up, over the time of a task."""

    parts: tuple[tuple[Rise, Array], ...]
    """The profile of each, and where it leads: (6,) displacement about B [m, rad], or (m,) coordinates of Gamma_ucs."""

    def at(self, times: Array) -> Array:
        """Return the wanted motion (T, 6) or (T, m) at any times (T,) [s]."""
        return np.asarray(sum(np.outer(profile.at(times), whole) for profile, whole in self.parts))

    @property
    def marks(self) -> Marks:
        """Those of their profiles."""
        return together(profile.marks for profile, _ in self.parts)
