"""Where the skeleton of a hand runs through the object: the lines between its links, and to its pads."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from synergrip.documents.quantities import in_mm
from synergrip.grasps.golden_section import lowest
from synergrip.grasps.objects import Object, Shape
from synergrip.grasps.placing import Touch
from synergrip.hands.hand import Hand, Pad
from synergrip.linalg import Array

DEEP = 0.5e-3
"""A line of the skeleton that runs deeper inside the object is told [m]."""
FAR_INSIDE = 3e-3
"""One that runs deeper than this [m] is no matter of where exactly a frame lies: the hand can hardly be there."""
LOOKS = 9
"""Points of a line that are looked at where many are judged at once."""


@dataclass(frozen=True, eq=False)
class _End:
    """An end of a line of the skeleton."""

    name: str
    link: str
    point: Array  # (3,) in link coordinates [m]

    @classmethod
    def of_link(cls, link: str) -> _End:
        """Return the origin of a link."""
        return cls(f"link '{link}'", link, np.zeros(3))

    @classmethod
    def of_pad(cls, pad: Pad) -> _End:
        """Return the point of a pad."""
        return cls(f"pad '{pad.name}'", pad.link, pad.point)


def collision_notes(hand: Hand, q: Array, body: Object, touches: Sequence[Touch]) -> tuple[str, ...]:
    """Return a note on the lines of the hand's skeleton that run inside the object, or nothing.

    The skeleton is what is known of any hand: a line from the origin of each link to that of the link that carries
    it, and to each of its pads. A frame far from the flesh makes a line where nothing is, and flesh is thicker than
    its line: a note is a reason to look, not a proof.

    Args:
        hand: the hand.
        q: (n_q,) joint values.
        body: the object, where it is; nothing is inside one without a shape.
        touches: the contacts; their pads are part of the skeleton.
    """
    if body.shape is None:
        return ()
    lines = list(_skeleton(hand, touches))
    motions = hand.kinematics.at(q, [(end.link, end.point) for line in lines for end in line])
    points = np.array([motion.position - body.position for motion in motions]).reshape(-1, 2, 3)
    every = zip(lines, points, at_most(body.shape, points), strict=True)
    near = [(*line, depth(body.shape, *ends)) for line, ends, most in every if most > DEEP]
    inside = ", ".join(f"from {a.name} to {b.name} ({in_mm(deep, 2)} deep)" for a, b, deep in near if deep > DEEP)
    message = f"the hand may collide with the {body.shape.title}: its skeleton runs inside on the line {inside}"
    return (message,) if inside else ()


def depth(shape: Shape, start: Array, end: Array) -> float:
    """Return how deep [m] the line between two points (3,) runs inside a shape; negative when it stays outside.

    The signed distance to a convex body is convex along a line, so that its smallest value is found exactly.
    """
    return -lowest(lambda share: float(shape.surface(start + share * (end - start))[0]), 0.0, 1.0)[1]


def at_most(shape: Shape, ends: Array) -> Array:
    """Return how deep [m] lines between points (N, 2, 3) run inside a shape at most (N,), as their ends tell.

    The distance changes by no more than the way along the line; most lines of a hand are seen so to stay outside.
    """
    return np.asarray(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1) - shape.surface(ends)[0].sum(axis=1)) / 2


def deepest(hand: Hand, q: Array, shape: Shape, positions: Array, touches: Sequence[Touch]) -> Array:
    """Return how deep [m] the skeleton runs at most inside an object at `positions` (N, 3), in postures (N, n_q).

    Lines are looked at in `LOOKS` points each: quick, for a search. Negative (N,) where all stay outside.
    """
    ends = [(end.link, end.point) for line in _skeleton(hand, touches) for end in line]
    places = hand.kinematics.along(q, ends).position - positions[:, None]
    shares = np.linspace(0.0, 1.0, LOOKS)[:, None, None, None]
    points = (1 - shares) * places[:, ::2] + shares * places[:, 1::2]
    return np.asarray(-shape.surface(points)[0].min(axis=(0, 2)))


def _skeleton(hand: Hand, touches: Sequence[Touch]) -> Iterator[tuple[_End, _End]]:
    """Yield the ends of each line; a link without length is an end of another line."""
    for link, parent in hand.parents.items():
        yield _End.of_link(parent), _End.of_link(link)
    every = [*hand.pads.values(), *(touch.pad for touch in touches)]
    for pad in {(pad.link, *pad.point.tolist()): pad for pad in every}.values():
        if np.any(pad.point):
            yield _End.of_link(pad.link), _End.of_pad(pad)
