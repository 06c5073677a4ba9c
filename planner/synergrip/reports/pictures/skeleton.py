"""A hand as bones: straight lines between the origins of its links, and out to the pads at their ends."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from synergrip.hands.hand import Hand, Pad
from synergrip.linalg import Array, frozen
from synergrip.reports.pictures.bones import bone_ends, bones_between


@dataclass(frozen=True)
class Skeleton:
    """A hand in a posture, in the palm frame [m]."""

    bones: Array
    """(n, 2, 3) from the origin of a link to that of the next one, or to a pad of a link that carries no other."""
    palm: Array
    """(k, 3) origins of the palm and of the links that it carries."""
    pads: Array
    """(m, 3) the pads asked for."""
    radii: Array
    """(m,) of the pads, 0 for points [m]."""

    @property
    def points(self) -> Array:
        """All that is drawn (., 3): the ends of the bones, then the pads."""
        return np.vstack([self.bones.reshape(-1, 3), self.pads])


def skeleton(hand: Hand, q: Array, pads: Sequence[Pad]) -> Skeleton:
    """Return the bones of a hand and its `pads` at joint values `q` (n_q,)."""
    links, every = hand.links, [*pads, *hand.pads.values()]
    asked = [(link, np.zeros(3)) for link in links] + [(pad.link, pad.point) for pad in every]
    points = np.array([motion.position for motion in hand.kinematics.at(q, asked)])
    last = set(links) - set(hand.parents.values())
    tips = {(pad.link, *pad.point): len(links) + i for i, pad in enumerate(every) if pad.link in last}
    bones = bones_between(points, bone_ends(links, hand.parents, {i: link for (link, *_), i in tips.items()}))
    palm = [i for i, link in enumerate(links) if hand.parents.get(link, links[0]) == links[0]]
    return Skeleton(
        frozen(bones), frozen(points[palm], (len(palm), 3)),
        frozen(points[len(links) : len(links) + len(pads)], (len(pads), 3)), frozen([pad.radius for pad in pads]),
    )  # fmt: skip
