"""Where pads, and last links of fingers without any, are in a posture: what one needs to put an object between them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from synergrip.hands.hand import Hand, Pad, SynergySet
from synergrip.hands.synergies.matrix import resting
from synergrip.linalg import Array, frozen
from synergrip.values import Value


@dataclass(frozen=True, eq=False, repr=False)
class Spot(Value):
    """A pad, or the origin of a link at the end of a finger that has no pad."""

    name: str
    link: str
    pad: bool
    """Whether it is a pad."""
    position: Array  # (3,) palm frame [m]
    normal: Array | None
    """(3,) unit vector in the palm frame in which the pad pushes; None where nothing says so."""


def spots_of(hand: Hand, q: Array, others: Sequence[Pad] = ()) -> tuple[Spot, ...]:
    """Return the pads of a hand at joint values `q` (n_q,), then other pads on it, then ends of fingers without any."""
    names = {(pad.link, *pad.point.tolist()) for pad in hand.pads.values()}
    pads = [*hand.pads.values(), *(pad for pad in others if (pad.link, *pad.point.tolist()) not in names)]
    padded, carrying = {pad.link for pad in pads}, set(hand.parents.values())
    ends = [link for link in hand.links if link not in carrying and link not in padded]
    asked = [*((pad.link, pad.point) for pad in pads), *((link, np.zeros(3)) for link in ends)]
    motions = hand.kinematics.at(q, asked)
    pushing = (
        frozen(m.rotation @ pad.normal) if np.any(pad.normal) else None for pad, m in zip(pads, motions, strict=False)
    )
    found = [
        Spot(pad.name, pad.link, True, motion.position, normal)
        for pad, motion, normal in zip(pads, motions, pushing, strict=False)
    ]
    bare = zip(ends, motions[len(pads) :], strict=True)
    return (*found, *(Spot(link, link, False, motion.position, None) for link, motion in bare))


def rest_posture(hand: Hand, synergies: SynergySet | None = None) -> Array:
    """Return the posture (n_q,) of a hand of which nothing is asked: its synergies at 0, inside the joint ranges."""
    return resting(hand.joints, synergies or next(iter(hand.synergy_sets.values())))
