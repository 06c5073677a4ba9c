"""What does not change while a hand closes: which joints carry which pads, take along what, and where they end."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from synergrip.grasps.placing import Touch
from synergrip.grasps.stops import Flags
from synergrip.hands.hand import Hand
from synergrip.linalg import Array

STEP = {"hinge": float(np.radians(1.0)), "slide": 2e-3}
"""The fastest joint moves this far between two looks at the distances [rad or m]."""
MOST_STEPS = 720.0
"""Steps without an event after which a hand is given up: two turns of the fastest joint."""
AT_LIMIT = 1e-12
"""A joint this close to its limit is at it [rad or m, relative to a limit larger than 1]."""


@dataclass(frozen=True, eq=False)
class ClosingJoints:
    """The joints of a hand that closes, and what stops when one of them does."""

    direction: Array
    """(n_q,) joint motion of closing by 1."""
    step: Array
    """(n_q,) `STEP` of each joint."""
    lower: Array  # (n_q,)
    upper: Array  # (n_q,)
    movers: Flags
    """(n_c, n_q) the joint carries the pad."""
    takes: Flags
    """(n_q, n_q) the joint of the row stops that of the column when it comes to its limit."""
    tied: Flags
    """(n_q, n_q) the two joints are rigidly coupled, or are the same."""

    @classmethod
    def of(cls, hand: Hand, direction: Array, touches: Sequence[Touch]) -> ClosingJoints:
        """Read from the hand which joints move and take along what.

        Args:
            hand: the hand.
            direction: (n_q,) joint motion of closing by 1.
            touches: the contacts.
        """
        step = np.array([STEP[joint.kind] for joint in hand.joints])
        carriers = [set(hand.carriers(touch.pad.link)) for touch in touches]
        movers = np.array([[joint.link in links for joint in hand.joints] for links in carriers])
        lower, upper = (np.array([getattr(joint, end) for joint in hand.joints]) for end in ("lower", "upper"))
        return cls(direction, step, lower, upper, movers, _takes(hand), _tied(hand))

    @property
    def closing(self) -> Flags:
        """(n_q,) which joints closing moves."""
        return np.asarray(self.direction != 0)

    @property
    def moved(self) -> Flags:
        """(n_c,) which pads closing moves."""
        return np.asarray((self.movers & self.closing).any(axis=1))

    @property
    def limit(self) -> Array:
        """(n_q,) where each joint ends as the hand closes [rad or m]."""
        return np.where(self.direction > 0, self.upper, self.lower)

    def inside(self, q: Array) -> Array:
        """Return joint values (..., n_q) with those put back that rounding put past their limits."""
        return np.clip(q, self.lower, self.upper)

    def at_limit(self, q: Array) -> Flags:
        """Return which joints (..., n_q) have come to the end of their range at values `q` (..., n_q)."""
        limit = self.limit
        near = AT_LIMIT * np.maximum(np.abs(np.where(np.isfinite(limit), limit, 0.0)), 1.0)
        return np.asarray((np.abs(limit - q) <= near) & self.closing)


def _takes(hand: Hand) -> Flags:
    """Return (n_q, n_q) bool: the joint of the column follows that of the row, or the two are tied."""
    index = {name: i for i, name in enumerate(hand.joint_names)}
    takes = _tied(hand)
    for _ in hand.couplings:  # followers of followers
        for follower, coupling in hand.couplings.items():
            for driver in coupling.ratios:
                takes[:, index[follower]] |= takes[:, index[driver]]
    return takes


def _tied(hand: Hand) -> Flags:
    """Return (n_q, n_q) bool: the two joints are rigidly coupled, directly or through others, or are the same."""
    index = {name: i for i, name in enumerate(hand.joint_names)}
    tied = np.eye(len(index), dtype=bool)
    for follower, coupling in hand.couplings.items():
        if coupling.rigid:
            together = tied[[index[follower], *(index[driver] for driver in coupling.ratios)]].any(axis=0)
            tied[np.ix_(together, together)] = True
    return tied
