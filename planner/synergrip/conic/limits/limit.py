"""What every limit is: rows for the program, and the same said once more in physical terms for the check."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, get_args

from synergrip.conic.arguments import Complete
from synergrip.conic.formulation import Affine, Formulation
from synergrip.conic.limits.usage import Usage as Usage
from synergrip.conic.rows import Rows, with_room
from synergrip.linalg import Array
from synergrip.statics.motion import Motion
from synergrip.values import ByContent

if TYPE_CHECKING:
    from synergrip.conic.limits.dial import Dial
    from synergrip.grasps.grasp import Grasp

Watches = Literal["forces", "motion", "references"]
"""The internal force alone; that and the rigid motion; or all of the references, so that redundancy matters."""
WATCHES: tuple[str, ...] = get_args(Watches)


class Limit(Complete, ByContent, ABC):
    """Something that must hold at every knot. A limit of one's own is `rows` and `usage`.

    Example:
        Forces of at most 5 N along the second row of lambda::

            class Sideways(Limit):
                def rows(self, formulation):
                    side = formulation.force.after(np.eye(formulation.response.grasp.n_l)[[1]])
                    return [norm_within(self.key, "sideways", side, 5.0)]

                def usage(self, formulation, motion):
                    five = np.array([5.0])
                    return Usage("sideways", "N", ("left",), motion.forces[:, [1]], -five, five, five, motion.times)
    """

    _example = "SlipMargin(0.5)"

    @property
    def key(self) -> str:
        """What asks for it, in messages and proofs: the key in a problem file, or the name of the class."""
        return type(self).__name__

    @property
    def watches(self) -> Watches:
        """What it depends on; on all the references unless it says less, so that redundancy is free for it."""
        return "references"

    def dials(self, grasp: Grasp) -> tuple[Dial[Limit], ...]:
        """Numbers of it that could be others, for answers that say what would help; of what is filled in by `on`."""
        return ()

    @property
    def of_references_alone(self) -> bool:
        """Whether it is known from the references, which are what they are, whatever the hand does with them."""
        return False

    @property
    def couples_knots(self) -> bool:
        """Whether it speaks of the step from knot to knot, and not of each instant."""
        return False

    @property
    def adds_up(self) -> bool:
        """Whether it adds something up over the whole time: it couples the knots, and is known at any instants."""
        return False

    @abstractmethod
    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return the rows it adds to the program, divided by the limit or another size of what they are about."""

    @abstractmethod
    def usage(self, formulation: Formulation, motion: Motion) -> Usage:
        """Return what a motion makes of it, from the motion alone."""

    def bounded(self, formulation: Formulation, *, cones_hold: bool) -> tuple[Affine, Array] | None:
        """Return quantities and the sizes (m,) that this limit keeps them within; None when it keeps none.

        `cones_hold` says whether the friction cones hold as well, which bound tangential by normal forces.
        """
        return None

    def loosened(self, share: float) -> Limit:
        """Return the same limit with that share of itself more room, for rounding: that much in its rows."""
        return _Roomier(self, share)

    def whole(self, usage: Usage) -> Array:
        """Return (m,) what `loosened` gives a share of, for each item of a usage of the limit."""
        return usage.scale

    def on(self, grasp: Grasp) -> Limit:
        """Return the limit for one grasp: numbers one for each, and what its hand states filled in.

        Raises:
            InputError: the grasp has not what the limit needs, or numbers do not fit it.
        """
        return self

    def for_synergies(self, origins: Sequence[int | None]) -> Limit:
        """Return the limit for a grasp with other synergies, of one that is filled in by `on`.

        Args:
            origins: for each synergy its place among those of the grasp it is for now; None for a new one.
        """
        return self


@dataclass(frozen=True)
class InOtherRows(Limit):
    """A limit that is another one in all but its rows."""

    limit: Limit

    @property
    def key(self) -> str:
        """Key of the other one."""
        return self.limit.key

    @property
    def watches(self) -> Watches:
        """What the other one depends on."""
        return self.limit.watches

    @property
    def of_references_alone(self) -> bool:
        """Whether the other one is."""
        return self.limit.of_references_alone

    @property
    def couples_knots(self) -> bool:
        """Whether the other one does."""
        return self.limit.couples_knots

    @property
    def adds_up(self) -> bool:
        """Whether the other one does."""
        return self.limit.adds_up

    def usage(self, formulation: Formulation, motion: Motion) -> Usage:
        """Return that of the other one."""
        return self.limit.usage(formulation, motion)


@dataclass(frozen=True)
class _Roomier(InOtherRows):
    """A limit whose cones are all kept but for a share of the unit of their rows."""

    share: float

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        return [with_room(part, self.share) for part in self.limit.rows(formulation)]
