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
    held_fast: bool
    """Whether it is a last link that no joint moves in the one before: a frame there, as files put at fingertips."""
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
    of_pads, bare = motions[: len(pads)], motions[len(pads) :]
    moved = {joint.link for joint in hand.joints}
    turned = zip(pads, of_pads, strict=True)
    pushing = (frozen(at.rotation @ pad.normal) if pad.normal.any() else None for pad, at in turned)
    found = (
        Spot(pad.name, pad.link, True, False, at.position, normal)
        for pad, at, normal in zip(pads, of_pads, pushing, strict=True)
    )
    last = (Spot(link, link, False, link not in moved, at.position, None) for link, at in zip(ends, bare, strict=True))
    return (*found, *last)


def rest_posture(hand: Hand, synergies: SynergySet | None = None) -> Array:
    """Return the posture (n_q,) of a hand of which nothing is asked: its synergies at 0, inside the joint ranges."""
    return resting(hand.joints, synergies or next(iter(hand.synergy_sets.values())))
