"""What is kept of margins while a plan is played: the smallest ones, the times without touch, and those on the cone."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from synergrip.linalg import Array

LOST = 5e-3
"""[s] without touch from which on a contact is lost; a jerk may part what touches for a step."""
GAP = 0.02
"""[s] between two times on the cone that are one: friction in the engine may let go for a moment."""
ROUNDING = 1e-9
"""Margins [N] are 0 within this, and this share of the largest force of the contact: it is on its friction cone."""


def without_rounding(margin: float, force: Array) -> float:
    """Return the slip margin [N] of a force (rows,), 0 where only rounding tells it from 0."""
    return 0.0 if abs(margin) <= ROUNDING * max(1.0, float(np.abs(force).max())) else margin


class Watch:
    """The contacts of a play, n_c of them. Times of the plan where "at", else of the simulation [s]."""

    def __init__(self, contacts: int) -> None:
        """Nothing has been seen yet."""
        self.least, self.least_at = np.full(contacts, np.inf), np.zeros(contacts)  # inf until it touches or is lost
        self.apart, self.since = np.zeros(contacts), np.zeros(contacts)
        self.on_cone = np.zeros(contacts)
        """For how long it was on its cone."""
        self.cone_at = np.full((contacts, 2), np.nan)
        """From when to when that was, the longest time on end."""
        self._longest, self._stay, self._began = np.zeros((3, contacts))
        self._off = np.full(contacts, np.inf)

    def smallest(self, margins: Array, counted: NDArray[np.bool_], at: float) -> None:
        """Look which margins are smaller than any before, of contacts that count."""
        lower = (margins < self.least) & counted
        self.least[lower], self.least_at[lower] = margins[lower], at

    def see(self, margins: Array, touching: NDArray[np.bool_], at: float, span: float) -> None:
        """See margins (n_c,) [N] and which contacts touch at a time of the plan, `span` after the last time."""
        self.since = np.where(touching, 0.0, self.since + span)
        self.apart = np.maximum(self.apart, self.since)
        self.smallest(margins, touching | (self.since > LOST), at)
        cone = touching & (margins <= 0)
        new = cone & (self._off > GAP)
        self._off = np.where(cone, 0.0, self._off + span)
        self._began[new], self._stay[new] = at, 0.0
        self._stay[cone] += span
        self.on_cone[cone] += span
        longer = cone & (self._stay > self._longest)
        self._longest[longer] = self._stay[longer]
        self.cone_at[longer] = np.column_stack([self._began, np.full(len(margins), at)])[longer]
