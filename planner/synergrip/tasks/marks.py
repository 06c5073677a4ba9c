"""Where values over time change their course: what must be looked at, so that nothing between is missed."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np

from synergrip.linalg import Array

SAME_TIME = 1e-9
"""Relative size of what is rounding and no difference between two times."""


@dataclass(frozen=True, eq=False)
class Jump:
    """Values that are others just before or just after an instant than at it."""

    time: float  # [s]
    side: int
    """-1 just before, 1 just after."""
    change: Array
    """(m,) what they are beyond those at the instant."""


@dataclass(frozen=True, eq=False)
class Marks:
    """The instants and spans of time that count in values over time."""

    corners: Array = field(default_factory=lambda: np.zeros(0))
    """(K,) [s] where they change their direction at once, jump or peak: lines of a table, starts, ends; in no order."""
    curved: tuple[tuple[float, float], ...] = ()
    """Spans [s] in which they are smooth curves; elsewhere they are straight lines from corner to corner."""
    jumps: tuple[Jump, ...] = ()


def together(parts: Iterable[Marks]) -> Marks:
    """Return the marks of a sum, or of values side by side."""
    each = list(parts)
    corners = np.concatenate([np.zeros(0), *(part.corners for part in each)])
    spans, jumps = (tuple(one for part in each for one in getattr(part, name)) for name in ("curved", "jumps"))
    return Marks(corners, spans, jumps)


def distinct(times: Array) -> Array:
    """Return the times in order, without those that follow another by no more than rounding."""
    ordered = np.unique(times)
    apart = np.diff(ordered) > SAME_TIME * max(float(ordered[-1]), 1.0)
    return np.asarray(ordered[np.append(apart, True)])
