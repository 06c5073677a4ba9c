"""What every limit is: rows for the program, and the same said once more in physical terms for the check."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, Protocol

import numpy as np

from synergrip.conic.formulation import Affine, Formulation
from synergrip.conic.rows import Rows
from synergrip.errors import shortened
from synergrip.linalg import Array
from synergrip.statics.motion import Motion
from synergrip.values import Value

Watches = Literal["forces", "motion", "references"]
"""The internal force alone; that and the rigid motion; or all of the references, so that redundancy matters."""


@dataclass(frozen=True, eq=False, repr=False)
class Usage(Value):
    """How much of a limit a motion uses, computed from physical quantities and not from the program."""

    title: str
    unit: str
    items: tuple[str, ...]
    value: Array  # (T, m)
    lower: Array  # (m,) -inf where there is none
    upper: Array  # (m,) +inf where there is none
    scale: Array  # (m,) size by which items are compared: the worst is the one that is farthest beyond, in this
    times: Array  # (T,)
    allowance: Array | None = None
    """(T, m) size against which an excess is small or large; `scale` when None."""

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
        return float((self.excess / self.size).max(initial=-np.inf))

    def worst(self) -> tuple[int, int]:
        """Return knot and item closest to (or farthest beyond) their bound, measured by `scale`."""
        return first_largest(self.excess / self.scale)

    def __repr__(self) -> str:
        """Return the value nearest to its bound, where and when."""
        k, i = self.worst()
        place = f"{shortened(str(self.items[i]))}, t = {self.times[k]:.6g} s"
        return f"Usage({self.title}: {self.value[k, i]:.6g} {self.unit} at {place}, the worst of {self.value.size})"


def first_largest(values: Array, tie: float = 1e-6) -> tuple[int, int]:
    """Return row and column of the largest of `values` (T, m); the first of those that differ by less than `tie`.

    Optimal plans lie on their limits at many knots at once; rounding must not choose the one that is shown.
    """
    flat = int(np.argmax(values.ravel() > values.max() - tie))
    return flat // values.shape[1], flat % values.shape[1]


class Limit(Protocol):
    """Something that must hold at every knot. A new limit is one file here and one line where plans list them."""

    @property
    def key(self) -> str:
        """Key in the problem file."""

    @property
    def watches(self) -> Watches:
        """What it depends on."""

    @property
    def couples_knots(self) -> bool:
        """Whether it speaks of the step from knot to knot, and not of each instant."""

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return the rows it adds to the program."""

    def bounded(self, formulation: Formulation, *, cones_hold: bool) -> tuple[Affine, Array] | None:
        """Return quantities and the sizes (m,) that this limit keeps them within; None when it keeps none.

        `cones_hold` says whether the friction cones hold as well, which bound tangential by normal forces.
        """

    def loosened(self, share: float) -> Limit:
        """Return the same limit with that share of itself more room, for rounding."""

    def usage(self, formulation: Formulation, motion: Motion) -> Usage:
        """Return what a motion makes of it, from the motion alone."""
