"""What every load and every target of a task is: a judged value, and what it is over a known span of time."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Literal, Self

import numpy as np

from synergrip.documents.naming import naming_arguments
from synergrip.errors import InputError
from synergrip.grasps.objects import Object
from synergrip.linalg import Array, frozen
from synergrip.tasks.palm_in_world import PalmInWorld
from synergrip.tasks.profiles import Profile
from synergrip.values import ByContent

NOT_STRETCHED = (
    "has times of its own, which 'time_factor' does not change: it is for the time of motions; leave out time_factor "
    "and write the times as they are to be, or leave out this"
)
Corner = tuple[str, str, float]
"""An argument, what happens then in words, and when [s]."""


@dataclass(frozen=True, eq=False)
class Setting:
    """What a load or a target needs to know before it has a value at every instant."""

    start: float  # [s] of the task
    end: float  # [s]
    body: Object | None = None
    """The object where it is; None for a grasp given as matrices."""
    palm: PalmInWorld | None = None
    """How the palm moves; None when it stands still."""


class Stated(ByContent):
    """A load or a target. One of your own overrides `over`, and the rest where the defaults are not right."""

    moving = False
    """Whether it needs at least two knots."""

    @property
    def lines(self) -> Array | None:
        """The instants (K,) [s] of a table, outside of which it says nothing; None when it is no table."""
        return None

    @property
    def last(self) -> float | None:
        """When the task ends that does not say so itself [s]; None when this does not tell."""
        return None if self.lines is None else float(self.lines[-1])

    @property
    def timed(self) -> bool:
        """Whether things happen at instants from the start of the task, other than the lines of a table."""
        return False

    @property
    def curved(self) -> bool:
        """Whether it bends between the lines of all tables, so that there must be knots between these."""
        return self.timed

    def over(self, setting: Setting) -> Profile | None:
        """Return the values at any time of a task; None when there is nothing to add.

        Raises:
            InputError: it does not fit into the task, or needs to know more of the object; keys are arguments.
        """
        raise NotImplementedError

    @naming_arguments
    def at(self, times: Sequence[float] | Array, *, object: Object | None = None) -> Array:
        """Return its values (T, 6), or (T, m), at instants of a task that lasts from the first to the last of them.

        The palm stands still in that task. A load is a wrench on the object about B, a target a displacement.

        Args:
            times: (T,) increasing instants [s].
            object: what is loaded, for what goes by its mass, as gravity does.

        Raises:
            InputError: no instants, no object where one is needed, or one that does not fit into the task.

        Example:
            >>> from synergrip.tasks.wrenches import Wrench
            >>> Wrench((0, 0, -2.5, 0, 0, 0)).at([0.0, 1.0]).shape
            (2, 6)
        """
        from synergrip.tasks.arguments import TaskArguments

        judge = TaskArguments(f"{type(self).__name__}.at")
        if object is not None:
            judge.one("object", object, Object, "Object(mass=0.2)")
        instants = judge.times("times", times)
        judge.finish()
        if self.lines is not None and not self.lines[0] <= instants[0] <= instants[-1] <= self.lines[-1]:
            span = f"the table covers {self.lines[0]:g} s to {self.lines[-1]:g} s"
            judge.refuse("times", f"{span}, and these are instants from {instants[0]:g} s to {instants[-1]:g} s")
            judge.finish()
        body = object if object is None or object.placed else replace(object, position=np.zeros(3))
        try:
            profile = self.over(Setting(float(instants[0]), float(instants[-1]), body))
        except InputError as error:
            whose = error.under(f"{type(self).__name__}.at")
            hint = "; or give at(times, object=Object(mass=...))" if object is None and "mass" in str(error) else ""
            raise whose.located(lambda issue: replace(issue, message=issue.message + hint)) from None
        return np.zeros((len(instants), 6)) if profile is None else frozen(profile.at(instants))

    def stretched(self, factor: float) -> Self:
        """Return the same in a task whose time is multiplied by a factor: what moves comes at other times with it.

        Raises:
            InputError: it has times that are not those of a motion.
        """
        if self.lines is not None or self.timed or self.last is not None:
            raise InputError.at("", NOT_STRETCHED)
        return self

    def corners(self, setting: Setting) -> Iterable[Corner]:
        """Return the instants that must be on a knot when the number of knots is given."""
        return ()

    def knots(self, setting: Setting) -> Array:
        """Return the instants [s] that get a knot when their number is not given."""
        return np.zeros(0)


class Load(Stated):
    """Something that loads the object: over a span of time a wrench (T, 6) about B [N, N m], axes of the palm."""


class Motion(Stated):
    """Where the object is wanted: over a span of time a displacement (T, 6), or coordinates of Gamma_ucs (T, m)."""

    @property
    def kind(self) -> Literal["hold", "motion", "modes", "mode moves"]:
        """What its values mean; see `Target`."""
        return "motion"
