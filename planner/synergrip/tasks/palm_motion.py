"""A palm that turns and shifts on one profile."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.documents.naming import naming_arguments
from synergrip.documents.quantities import in_mm, plain
from synergrip.linalg import Array, frozen
from synergrip.tasks.arguments import Numbers, TaskArguments, keep
from synergrip.tasks.inertia import Inertia, inertia
from synergrip.tasks.palm_in_world import acceleration_of
from synergrip.tasks.profiles import PROFILES, ProfileName, Rise
from synergrip.tasks.stated import Load, Setting


@naming_arguments
@dataclass(frozen=True, kw_only=True)
class Palm(Load):
    """The palm turns about an axis through the origin of its frame and shifts this origin, over the whole task.

    Gravity turns with the world, the other way than the palm.

    Args:
        axis: of the turn, in the palm frame: "x", "y", "z" or 3 numbers; goes with `turn`.
        turn: the whole angle [rad]; None for no turn.
        shift: (3,) the whole displacement along the axes of the palm at the start [m]; None for none.
        profile: of both in time: "min-jerk", "cubic" or "linear".
        inertia: whether the object loads the grasp by its inertia, without which a shift does nothing.

    Raises:
        InputError: no motion, half of a turn, a shift without inertia, or inertia with a start at once.

    Example:
        >>> Palm(axis="x", turn=1.57).turn
        1.57
    """

    axis: str | Numbers | None = None
    turn: float | None = None
    shift: Numbers | None = None
    profile: ProfileName = "min-jerk"
    inertia: bool = False
    moving = True

    def __post_init__(self) -> None:
        """Judge the arguments, alone and together."""
        judge = TaskArguments("Palm")
        axis = None if self.axis is None else judge.direction("axis", self.axis)
        turn = None if self.turn is None else judge.angle("turn", self.turn)
        what = "3 lengths in m, axes of the palm at the start"
        shift = None if self.shift is None else judge.vector("shift", self.shift, 3, what)
        judge.word("profile", self.profile, tuple(PROFILES))
        judge.flag("inertia", self.inertia)
        if turn is None and shift is None:
            judge.refuse("turn", "the palm needs a motion: axis with turn, for example axis='x', turn=1.57, or shift")
        elif (turn is None) != (axis is None):
            missing, given = ("axis", "turn") if axis is None else ("turn", "axis")
            judge.refuse(missing, f"is missing; it goes with {given}, for example axis='x', turn=1.57")
        if shift is not None and self.inertia is False:
            judge.refuse("shift", "a shift loads the object by its inertia only; give inertia=True")
        if self.inertia is True and isinstance(self.profile, str) and self.profile == "linear":
            what = "starts and stops at once, which no finite force does; use 'min-jerk' or 'cubic'"
            judge.refuse("profile", f"with inertia, a linear profile {what}")
        keep(self, judge, axis=axis, turn=turn, shift=shift)

    @property
    def timed(self) -> bool:
        """True with inertia, which is curved over the time of the task."""
        return self.inertia

    def stretched(self, factor: float) -> Palm:
        """Return the same: it takes the whole time of the task, however long."""
        return self

    def motion(self, start: float, end: float) -> PalmMotion:
        """Return the motion in a task from `start` to `end` [s]."""
        axis = (0.0, 0.0, 1.0) if self.axis is None else self.axis
        shift = np.zeros(3) if self.shift is None else self.shift
        return PalmMotion(frozen(axis), self.turn or 0.0, frozen(shift), Rise(self.profile, start, end))

    def over(self, setting: Setting) -> Inertia | None:
        """Return the load by inertia at any time; None without inertia.

        Raises:
            InputError: it needs a mass, or time to move.
        """
        return inertia(setting.body, self.motion(setting.start, setting.end)) if self.inertia else None


@dataclass(frozen=True, eq=False)
class PalmMotion:
    """A turn about an axis through the origin of the palm frame and a shift of this origin, on one profile.

    The world frame is the palm frame at the start: a point p of the palm is at ``shift s + R(axis, turn s) p``.
    """

    axis: Array  # (3,) unit
    turn: float  # [rad]
    shift: Array  # (3,) [m]
    profile: Rise

    @property
    def corners(self) -> Array:
        """Start and end (2,) [s]; there are no corners on the way."""
        return np.array([self.profile.start, self.profile.end])

    @property
    def in_words(self) -> str:
        """The whole turn and the whole shift."""
        about = next((name for name, one in zip("xyz", np.eye(3), strict=True) if np.array_equal(self.axis, one)), "")
        about = about or f"({', '.join(plain(each, 3) for each in self.axis)})"
        turns = [f"turns {plain(np.degrees(self.turn), 3)} deg about {about}"] * bool(self.turn)
        return " and ".join([*turns, *[f"shifts {in_mm(float(np.linalg.norm(self.shift)))}"] * bool(self.shift.any())])

    def seen(self, vectors: Array, times: Array) -> Array:
        """Return vectors of the world (3,) or (T, 3) in the palm frame (T, 3): ``R(axis, -angle) v`` (Rodrigues)."""
        angle = -self.turn * self.profile.at(times)[:, None]
        along = (vectors @ self.axis)[..., None] * self.axis
        return np.asarray(
            vectors * np.cos(angle) + np.cross(self.axis, vectors) * np.sin(angle) + along * (1 - np.cos(angle))
        )

    def rotation_rates(self, times: Array) -> tuple[Array, Array]:
        """Return angular velocity (T, 3) [rad/s] and acceleration (T, 3) [rad/s^2]; the same in world and palm."""
        turn = self.turn * self.axis
        return np.outer(self.profile.at(times, 1), turn), np.outer(self.profile.at(times, 2), turn)

    def acceleration(self, point: Array, times: Array) -> Array:
        """Return the acceleration (T, 3) [m/s^2], in the palm frame, of a point (3,) [m] fixed to the palm."""
        origin = self.seen(np.outer(self.profile.at(times, 2), self.shift), times)
        return acceleration_of(point, origin, *self.rotation_rates(times))
