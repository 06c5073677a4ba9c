"""Which pad touches the object first while the joints move at constant rates, and when."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from synergrip.grasps.golden_section import lowest
from synergrip.grasps.objects import Shape
from synergrip.grasps.placing import Touch
from synergrip.hands.hand import Hand
from synergrip.linalg import Array

TOUCHING = 1e-10
"""A pad this close to the surface touches it [m]."""


@dataclass(frozen=True, eq=False)
class Gaps:
    """Distances of pads from the surface of an object."""

    hand: Hand
    shape: Shape
    centre: Array
    """(3,) in the palm frame [m]."""
    touches: Sequence[Touch]

    def at(self, q: Array, pads: Sequence[int]) -> tuple[Array, Array]:
        """Return the distances (k,) [m] of the numbered pads at `q` (n_q,), and their gradients (k, n_q)."""
        touches = [self.touches[i] for i in pads]
        motions = self.hand.kinematics.at(q, [(touch.pad.link, touch.pad.point) for touch in touches])
        gaps, gradients = np.zeros(len(pads)), np.zeros((len(pads), len(q)))
        for i, (touch, motion) in enumerate(zip(touches, motions, strict=True)):
            distance, normal = self.shape.surface(motion.position - self.centre)
            gaps[i], gradients[i] = distance - touch.pad.radius, normal @ motion.jacobian[:3]
        return gaps, gradients


def first_touch(gaps: Gaps, q: Array, rate: Array, span: float, pads: Sequence[int]) -> tuple[float, int] | None:
    """Return how many steps of `rate` it takes until the first pad touches, and its number; None within `span`.

    Distances are looked at once a step. Between two looks a pad has touched when its distance has changed sign, or
    when it fell at the first and rises at the second and its smallest value in between is not positive.

    Args:
        gaps: the distances.
        q: (n_q,) joint values at the start; every pad of `pads` is outside the object there.
        rate: (n_q,) joint motion per step.
        span: largest number of steps.
        pads: numbers of the pads to watch.
    """
    places = np.linspace(0.0, span, int(np.ceil(span)) + 1)
    falling = gaps.at(q, pads)[1]
    for a, b in pairwise(places.tolist()):
        after, rising = gaps.at(q + b * rate, pads)
        turns = (falling @ rate < 0) & (rising @ rate > 0)
        found = [
            (place, pad)
            for i, pad in enumerate(pads)
            if (after[i] <= 0 or turns[i]) and (place := _touch(gaps, q, rate, pad, (a, b), after[i])) is not None
        ]
        if found:
            return min(found)
        falling = rising
    return None


def _touch(gaps: Gaps, q: Array, rate: Array, pad: int, between: tuple[float, float], last: float) -> float | None:
    """Return where within an interval a pad touches that is outside at its start; None when it does not."""
    from scipy.optimize import brentq

    def gap(place: float) -> float:
        return float(gaps.at(q + place * rate, [pad])[0][0])

    start, end = between
    if last > 0:
        end, last = lowest(gap, start, end)
        if last > 0:
            return end if last <= TOUCHING else None
    return float(brentq(gap, start, end, xtol=1e-12))
