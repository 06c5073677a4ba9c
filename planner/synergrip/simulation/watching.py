"""What is watched while a plan is played: smallest margins, and when contacts are lost, slip or are on their cones."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from synergrip.linalg import Array

LOST = 5e-3
"""[s] without touch from which on a contact is lost; a jerk may part what touches for a step."""
SLIPPED = 5e-5
"""[m] from which on a contact has slipped; friction in the engine creeps by some 1e-6 m."""
SPUN = 0.01
"""[rad] about its normal from which on a contact has slipped."""
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
        self.lost_at, self.slipped_at = np.full((2, contacts), np.nan)
        """When those that were lost parted, and when slips were first as large as `SLIPPED` or `SPUN`."""
        self._parted_at = np.zeros(contacts)

    def afresh(self) -> Watch:
        """Return one that has seen no margin yet, and knows which contacts are gone already, and since when."""
        new = Watch(len(self.least))
        new.apart, new.since, new._parted_at = self.since.copy(), self.since.copy(), self._parted_at.copy()
        new.lost_at, new.slipped_at = np.where(self.since > LOST, self.lost_at, np.nan), self.slipped_at.copy()
        return new

    @property
    def parted(self) -> bool:
        """Whether a contact is apart for a moment, which is not lost yet."""
        return bool(np.any((self.since > 0) & (self.since <= LOST)))

    def see(self, margins: Array, touching: NDArray[np.bool_], at: float, span: float) -> NDArray[np.bool_]:
        """See margins (n_c,) [N] and which contacts touch at a time of the plan, `span` after the last time.

        Returns:
            (n_c,) which margins are smaller than any before; what is apart for a moment does not count.
        """
        self._parted_at = np.where((self.since == 0) & ~touching, at, self._parted_at)
        self.since = np.where(touching, 0.0, self.since + span)
        self.apart = np.maximum(self.apart, self.since)
        gone = self.since > LOST
        new = gone & np.isnan(self.lost_at)
        self.lost_at[new] = self._parted_at[new]
        lower = (margins < self.least) & (touching | gone)
        self.least[lower], self.least_at[lower] = margins[lower], at
        cone = touching & (margins <= 0)
        new = cone & (self._off > GAP)
        self._off = np.where(cone, 0.0, self._off + span)
        self._began[new], self._stay[new] = at, 0.0
        self._stay[cone] += span
        self.on_cone[cone] += span
        longer = cone & (self._stay > self._longest)
        self._longest[longer] = self._stay[longer]
        self.cone_at[longer] = np.column_stack([self._began, np.full(len(margins), at)])[longer]
        return lower

    def slid(self, slips: Array, spins: Array, at: float) -> None:
        """See how far contacts have slid [m] and spun [rad], (n_c,) each."""
        new = ((slips > SLIPPED) | (np.abs(spins) > SPUN)) & np.isnan(self.slipped_at)
        self.slipped_at[new] = at
