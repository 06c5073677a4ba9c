"""The two sides of a jump of the load, which a hand goes through where a knot is one instant.

A tip that rolls remembers its way. Gone in one step from before the jump to the next knot, it comes to rest elsewhere
than by the states on either side of the jump.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from synergrip.linalg import Array, Places, frozen
from synergrip.tasks.marks import SAME_TIME, Jump
from synergrip.values import Value


@dataclass(frozen=True, eq=False, repr=False)
class Gone(Value):
    """The instants that a hand goes through."""

    times: Array
    """(P,) in order [s]; that of a jump stands up to three times: just before it, at it, just after it."""
    references: Array  # (P, n_z)
    wrench: Array  # (P, 6) on the object, about B where it starts [N, N m]
    asked: Places
    """(T,) which of them are asked for."""


def gone_through(jumps: Sequence[Jump], times: Array, references: Array, wrench: Array) -> Gone:
    """Return what a hand goes through: instants that are asked for, and the sides of jumps that are not among them.

    Args:
        jumps: of the load, each at a knot.
        times: (T,) that are asked for, in order, the knots or some of them, and the sides of all jumps or of none [s].
        references: (T, n_z) there.
        wrench: (T, 6) there.
    """
    slack, sides = SAME_TIME * max(float(times[-1]), 1.0), dict[tuple[int, int], Array]()
    for jump in jumps:
        rows = np.flatnonzero(np.abs(times - jump.time) <= slack)
        if len(rows) == 1 and 0 <= (row := int(rows[0])) + jump.side < len(times):
            sides[row, jump.side] = sides.get((row, jump.side), wrench[row]) + jump.change
    if not sides:
        return Gone(times, references, wrench, np.arange(len(times)))
    beside = sorted(sides)
    at, where = [row for row, _ in beside], [row + (side > 0) for row, side in beside]
    return Gone(
        frozen(np.insert(times, where, times[at])), frozen(np.insert(references, where, references[at], axis=0)),
        frozen(np.insert(wrench, where, [sides[each] for each in beside], axis=0)),
        np.arange(len(times)) + np.searchsorted(where, np.arange(len(times)), side="right"),
    )  # fmt: skip
