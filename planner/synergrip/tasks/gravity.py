"""Gravity: the weight of the object, which turns against a palm that moves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.documents.naming import naming_arguments
from synergrip.errors import InputError
from synergrip.linalg import Array, frozen
from synergrip.tasks.arguments import Numbers, TaskArguments, keep
from synergrip.tasks.marks import Marks
from synergrip.tasks.palm_in_world import PalmInWorld, marks_of
from synergrip.tasks.profiles import Profile
from synergrip.tasks.stated import Load, Setting


@naming_arguments
@dataclass(frozen=True)
class Gravity(Load):
    """The weight of the object; in a palm that moves it turns the other way than the palm.

    Args:
        acceleration: (3,) of gravity, in the palm frame at the start [m/s^2].

    Raises:
        InputError: not 3 finite numbers.

    Example:
        >>> Gravity((0, 0, -9.81))
        Gravity(acceleration=(0.0, 0.0, -9.81))
    """

    acceleration: Numbers

    def __post_init__(self) -> None:
        """Judge the argument."""
        judge = TaskArguments("Gravity")
        what = "3 accelerations in m/s^2, axes of the palm, such as (0, 0, -9.81)"
        keep(self, judge, acceleration=judge.vector("acceleration", self.acceleration, 3, what))

    def over(self, setting: Setting) -> Profile:
        """Return the weight at any time.

        Raises:
            InputError: the mass of the object is not known.
        """
        if setting.body is None or not setting.body.mass:
            given = "a grasp given as matrices has none: give the weight as a Wrench"
            message = f"gravity needs the mass of the object: {given if setting.body is None else 'give Object.mass'}"
            raise InputError.at("", message)
        weight = setting.body.mass * np.array(self.acceleration)
        return Weight(frozen(weight), setting.palm)


@dataclass(frozen=True, eq=False)
class Weight:
    """The weight of the object, also in a palm that moves."""

    force: Array
    """(3,) in the palm frame at the start [N]."""
    palm: PalmInWorld | None
    """None when it stands still."""

    def at(self, times: Array) -> Array:
        """Return the wrench (T, 6) about B; the centre of mass is there."""
        force = np.tile(self.force, (len(times), 1)) if self.palm is None else self.palm.seen(self.force, times)
        return np.hstack([force, np.zeros((len(times), 3))])

    @property
    def marks(self) -> Marks:
        """Those of the motion of the palm."""
        return Marks() if self.palm is None else marks_of(self.palm)
