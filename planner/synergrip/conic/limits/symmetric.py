"""``|value| <= limit`` of joints or synergies, whatever the value is: what those limits share."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, ClassVar, Literal, Self

import numpy as np

from synergrip.conic.arguments import OneOrEach, one_each, sizes
from synergrip.conic.bounds import within_bounds
from synergrip.conic.formulation import Affine, Formulation
from synergrip.conic.limits.dial import Cause, Dial, numbers
from synergrip.conic.limits.limit import Limit, Usage
from synergrip.conic.rows import Rows
from synergrip.errors import InputError
from synergrip.linalg import Array, frozen
from synergrip.statics.motion import Motion

if TYPE_CHECKING:
    from synergrip.grasps.grasp import Grasp
    from synergrip.grasps.held import Held


@dataclass(frozen=True, eq=False)
class Symmetric(Limit):
    """``|value| <= limit`` for each joint or synergy: `value` and `reached` say of what.

    Args:
        limit: one number for all, or one for each; infinity for none. "hand" where the hand states it.

    Raises:
        InputError: no numbers greater than 0.
    """

    limit: OneOrEach
    of: ClassVar[Literal["joint", "synergy"]] = "synergy"
    title: ClassVar[str]
    cause: ClassVar[Cause] = "limit"
    """What it is called where it keeps a task from having a plan."""
    hand_states: ClassVar[bool] = False

    def __post_init__(self) -> None:
        """Judge the numbers."""
        key = f"{type(self).__name__}.limit"
        word = self.hand_states and isinstance(self.limit, str) and self.limit == "hand"
        object.__setattr__(self, "limit", self.limit if word else sizes(key, self.limit, self.of))

    @abstractmethod
    def value(self, formulation: Formulation) -> Affine:
        """Return what is bounded."""

    @abstractmethod
    def reached(self, motion: Motion) -> Array:
        """Return its values (T, m) in a motion."""

    def unit(self, grasp: Grasp) -> str:
        """Return the unit of the values."""
        return SYNERGY_UNITS

    def names(self, grasp: Grasp) -> tuple[str, ...]:
        """Return the names of the joints or synergies."""
        return grasp.joints if self.of == "joint" else grasp.synergies

    def of_hand(self, held: Held) -> Array:
        """Return what a hand states of it, infinity where it states nothing."""
        return frozen([np.inf])

    def on(self, grasp: Grasp) -> Self:
        """Return it with one number for each, those of the hand where it is to say."""
        limit, names = self.limit, self.names(grasp)
        if type(limit) is np.ndarray and limit.shape == (len(names),):
            return self
        key = f"{type(self).__name__}.limit"
        if isinstance(limit, str):
            if grasp.held is None:
                raise InputError.at(key, NO_HAND)
            limit = frozen(self.of_hand(grasp.held))
            if not np.any(np.isfinite(limit)):
                raise InputError.at(key, NOT_STATED)
        return self.with_judged(limit=one_each(key, limit, names, self.of))

    def for_synergies(self, origins: Sequence[int | None]) -> Self:
        """Return it with a number for each of other synergies; a new one has what all have, or else none."""
        if self.of == "joint" or isinstance(self.limit, str) or not np.ndim(self.limit):
            return self
        same = len(set(self.limit.tolist())) == 1
        new = float(self.limit[0]) if same else np.inf
        return replace(self, limit=frozen([new if at is None else self.limit[at] for at in origins]))

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return two bounds for each, in units of the limit."""
        names, own = self.names(formulation.response.grasp), self.on(formulation.response.grasp)
        return within_bounds(self.key, names, self.value(formulation), -own.limit, own.limit, _unit(own.limit))

    def bounded(self, formulation: Formulation, *, cones_hold: bool) -> tuple[Affine, Array] | None:
        """Return the values and their limits."""
        return self.value(formulation), self.on(formulation.response.grasp).limit

    def loosened(self, share: float) -> Self:
        """Return it with every bound larger by `share`; those of a hand must be filled in."""
        return replace(self, limit=frozen(self.limit * (1 + share)))

    def dials(self, grasp: Grasp) -> tuple[Dial[Limit], ...]:
        """The numbers, all by one factor."""
        limit = np.atleast_1d(np.asarray(self.limit, dtype=float))
        finite = limit[np.isfinite(limit)]
        if not len(finite):
            return ()
        largest = float(finite.max())

        def written(value: float) -> str:
            return numbers(np.where(np.isfinite(limit), limit, FAR_AWAY * largest) * (value / largest))

        def turned(value: float) -> Limit:
            return replace(self, limit=frozen(limit * (value / largest)))

        return (Dial(self.cause, self.key, largest, self.unit(grasp), turned, written=written),)

    def usage(self, formulation: Formulation, motion: Motion) -> Usage:
        """Return the values that the motion reaches."""
        grasp, limit = formulation.response.grasp, self.on(formulation.response.grasp).limit
        return Usage(  # judged: a class of a user's own may reach what it likes
            self.title, self.unit(grasp), self.names(grasp), self.reached(motion), -limit, limit, _unit(limit),
            motion.times,
        )  # fmt: skip


SYNERGY_UNITS = "synergy units"
"""What values of synergies are in where their columns of S have no unit that is known."""
FAR_AWAY = 1e6
"""Times the largest finite limit, in files, where a limit in a list is none."""
NO_HAND = "'hand' needs a hand; a grasp given as matrices states no limits, give numbers"
NOT_STATED = "this hand states no such limit; write numbers"


def _unit(limit: Array) -> Array:
    return np.where(np.isfinite(limit), limit, 1.0)
