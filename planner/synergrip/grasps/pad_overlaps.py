"""Round pads that are inside each other: two fingers cannot be where they are."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import numpy as np

from synergrip.documents.quantities import in_mm
from synergrip.grasps.ball import MEETS
from synergrip.grasps.placing import Touch
from synergrip.hands.hand import Hand, Pad
from synergrip.linalg import Array


def overlaps(hand: Hand, q: Array, touches: Sequence[Touch]) -> tuple[list[tuple[str, str]], Array]:
    """Return pairs of round pads by name, and how deep (N, pairs) [m] they are inside each other; negative when apart.

    Pads are those of the hand and of the contacts. Those on one link, or on two of which one carries the other, are
    no pair: their flesh may be one.

    Args:
        hand: the hand.
        q: (N, n_q) joint values.
        touches: the contacts.
    """
    every = [*(touch.pad for touch in touches), *hand.pads.values()]
    pads = list({(pad.link, *pad.point.tolist()): pad for pad in reversed(every) if pad.radius > 0}.values())[::-1]
    pairs = [(i, j) for i, j in combinations(range(len(pads)), 2) if not _joined(hand, pads[i], pads[j])]
    if not pairs:
        return [], np.zeros((len(q), 0))
    places = hand.kinematics.along(q, [(pad.link, pad.point) for pad in pads]).position  # (N, k, 3)
    first, second = np.array(pairs).T
    apart = np.linalg.norm(places[:, first] - places[:, second], axis=2)
    radii = np.array([pad.radius for pad in pads])
    return [(pads[i].name, pads[j].name) for i, j in pairs], np.asarray(radii[first] + radii[second] - apart)


def overlap_notes(hand: Hand, q: Array, touches: Sequence[Touch]) -> tuple[str, ...]:
    """Return a note on the pads that are inside each other at joint values (n_q,), or nothing."""
    pairs, depths = overlaps(hand, q[None], touches)
    told = ", ".join(
        f"'{a}' and '{b}' by {in_mm(depth)}"
        for (a, b), depth in zip(pairs, depths[0].tolist(), strict=True)
        if depth > MEETS
    )
    return (f"round pads are inside each other: {told}; no fingers can be so",) if told else ()


def _joined(hand: Hand, a: Pad, b: Pad) -> bool:
    return a.link == b.link or hand.parents.get(a.link) == b.link or hand.parents.get(b.link) == a.link
