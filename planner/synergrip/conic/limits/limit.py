"""What every limit is: rows for the program, and the same said once more in physical terms for the check."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np

from synergrip.conic.arguments import Complete
from synergrip.conic.formulation import Affine, Formulation
from synergrip.conic.limits.ties import BROKEN, ROUNDING, first_largest, first_worst
from synergrip.conic.rows import Rows, with_room
from synergrip.documents.judging import Arguments, as_numbers, described
from synergrip.documents.naming import naming_arguments
from synergrip.errors import shortened
from synergrip.linalg import Array, frozen
from synergrip.statics.motion import Motion
from synergrip.values import ByContent, Value

if TYPE_CHECKING:
    from synergrip.conic.limits.dial import Dial
    from synergrip.grasps.grasp import Grasp

Watches = Literal["forces", "motion", "references"]
"""The internal force alone; that and the rigid motion; or all of the references, so that redundancy matters."""
WATCHES: tuple[str, ...] = get_args(Watches)


@naming_arguments
@dataclass(frozen=True, eq=False, repr=False)
class Usage(Value):
    """How much of a limit a motion uses, computed from physical quantities and not from the program.

    Args:
        title: of the limit, for tables and pictures.
        unit: of value, lower, upper and scale, such as "N"; for people.
        items: (m) what there is a value of: names of contacts, joints, synergies, or any words.
        value: (T, m) of each item at each of the motion's times.
        lower: (m,) what the value may not fall below; ``-math.inf`` where it may.
        upper: (m,) what it may not exceed; ``math.inf`` where it may.
        scale: (m,) size greater than 0 that an excess is measured against, usually the bound itself: up to 1e-6 of it
            passes for rounding, and the worst item is the one farthest beyond in it.
        times: (T,) ``motion.times``.
        allowance: (T, m) size against which an excess is judged; `scale` when None.

    Raises:
        InputError: names that are none, or arrays that are none or do not fit items and times.

    Example:
        >>> usage = Usage("force", "N", ("thumb",), [[3.0], [4.5]], [0.0], [5.0], [5.0], [0.0, 1.0])
        >>> usage.excess.tolist()
        [[-2.0], [-0.5]]
    """

    title: str
    unit: str
    items: tuple[str, ...]
    value: Array
    lower: Array
    upper: Array
    scale: Array
    times: Array
    allowance: Array | None = None

    def __post_init__(self) -> None:
        """Judge the shapes, which a limit of one's own may get wrong."""
        if self._fits():
            return
        judge = Arguments("Usage")
        judge.text("title", self.title)
        judge.text("unit", self.unit)
        items = judge.several("items", self.items, str, '"thumb"')
        times = as_numbers(self.times)
        if times is None or times.ndim != 1:
            judge.refuse("times", f"expected the times (T,) of the motion, got {described(self.times)}")
        judge.finish()
        T, m = len(np.atleast_1d(np.asarray(times))), len(items)
        wanted = {"value": (T, m), "lower": (m,), "upper": (m,), "scale": (m,), "allowance": (T, m)}
        for name, shape in wanted.items():
            given = getattr(self, name)
            found = as_numbers(given)
            if name == "allowance" and given is None:
                continue
            if found is None or found.shape != shape:
                what = f"expected shape {shape} for {T} instants and {m} items of '{self.title}'"
                judge.refuse(name, f"{what}, got {given.shape if isinstance(given, np.ndarray) else described(given)}")
            elif found is not given:
                object.__setattr__(self, name, frozen(found))
        judge.finish()
        object.__setattr__(self, "items", items)
        object.__setattr__(self, "times", times)

    def _fits(self) -> bool:
        """Return whether all is as it is to be, as that of the library is: then nothing is looked at more closely."""
        arrays = [self.value, self.lower, self.upper, self.scale, self.times]
        if self.allowance is not None:
            arrays.append(self.allowance)
        if not all(type(each) is np.ndarray and each.dtype == np.float64 for each in arrays):
            return False
        shape = (len(self.times), len(self.items)) if self.times.ndim == 1 else ()
        return (
            type(self.title) is type(self.unit) is str
            and type(self.items) is tuple
            and all(type(each) is str for each in self.items)
            and self.value.shape == shape
            and (self.allowance is None or self.allowance.shape == shape)
            and self.lower.shape == self.upper.shape == self.scale.shape == shape[1:]
        )

    @property
    def excess(self) -> Array:
        """(T, m) how far the value is beyond its bounds; negative inside."""
        return np.maximum(self.value - self.upper, self.lower - self.value)

    @property
    def size(self) -> Array:
        """(T, m) size against which an excess is small or large."""
        return np.broadcast_to(self.scale if self.allowance is None else self.allowance, self.value.shape)

    @property
    def violation(self) -> float:
        """The largest excess, relative to the size it is measured against; negative inside, -inf without a bound."""
        size = self.scale if self.allowance is None else self.allowance
        return float((self.excess / size).max(initial=-np.inf))

    def worst(self, side: int = 0) -> tuple[int, int]:
        """Return knot and item closest to (or farthest beyond) their bound, measured by `scale`.

        Of the upper bounds alone with `side` 1, of the lower ones with -1.
        """
        excess = {1: self.value - self.upper, -1: self.lower - self.value}.get(side, self.excess) / self.scale
        broken = bool(excess.max(initial=-np.inf) > BROKEN)
        return first_largest(excess) if broken else first_worst(excess, self.value / self.scale, ROUNDING)

    def __repr__(self) -> str:
        """Return the value nearest to its bound, where and when."""
        k, i = self.worst()
        place = f"{shortened(str(self.items[i]))}, t = {self.times[k]:.6g} s"
        return f"Usage({self.title}: {self.value[k, i]:.6g} {self.unit} at {place}, the worst of {self.value.size})"


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
