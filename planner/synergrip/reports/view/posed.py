"""A hand that is posed by its user, with what it is to hold or without: seen before any grasp or plan exists."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from synergrip.documents.quantities import in_mm
from synergrip.grasps.ball import WRITTEN
from synergrip.grasps.objects import Object
from synergrip.grasps.placing import Touch
from synergrip.hands.hand import Hand, Pad
from synergrip.linalg import Array
from synergrip.reports.pictures.bones import bone_ends
from synergrip.reports.view.scene import Frame, Scene, thickness_of
from synergrip.values import Value


@dataclass(frozen=True, eq=False, repr=False)
class Posed(Value):
    """What does not change while a hand is posed."""

    hand: Hand
    body: Object | None = None
    """What it is to hold; wherever it says it is."""
    touches: tuple[Touch, ...] = ()
    """Pads that are to touch it."""
    gravity: Array | None = None  # (3,) palm frame [m/s^2]

    @property
    def pads(self) -> tuple[Pad, ...]:
        """Those of the hand, then others that are to touch."""
        own = {(pad.link, *pad.point.tolist()) for pad in self.hand.pads.values()}
        others = (t.pad for t in self.touches if (t.pad.link, *t.pad.point.tolist()) not in own)
        return (*self.hand.pads.values(), *others)

    def scene(self, q: Array, position: Array) -> Scene:
        """Return what is drawn at joint values (n_q,) with the object at (3,): a scene of this one frame."""
        frame = self.frame(q, position)
        radii = np.array([pad.radius for pad in self.pads])
        names = ("bones", "links", "turned", "pads", "pushing", "position", "rotation", "places", "normals", "forces")
        return Scene(
            times=np.zeros(1), left_out=0, thickness=thickness_of(frame.bones, radii), link_names=self.hand.links,
            pad_names=tuple(pad.name for pad in self.pads), radii=radii,
            shape=None if self.body is None else self.body.shape, margins=None,
            contacts=tuple(touch.name for touch in self.touches),
            friction=np.array([getattr(touch.kind, "friction", 0.0) for touch in self.touches]), up=frame.up[None],
            gravity=self.gravity is not None, **{name: getattr(frame, name)[None] for name in names},
        )  # fmt: skip

    def frame(self, q: Array, position: Array) -> Frame:
        """Return what is seen at joint values (n_q,) with the object at (3,) [m], palm frame."""
        links, pads, touching = self.hand.links, self.pads, [touch.pad for touch in self.touches]
        points = [*((link, np.zeros(3)) for link in links), *((pad.link, pad.point) for pad in (*pads, *touching))]
        found = self.hand.kinematics.along(q[None], points)
        places, turned = found.position[0], found.rotation[0]
        first, last = len(links), len(links) + len(pads)
        ends = bone_ends(links, self.hand.parents, {first + i: pad.link for i, pad in enumerate(pads)})
        pushing = np.einsum(
            "kij,kj->ki", turned[first:], np.array([p.normal for p in (*pads, *touching)]).reshape(-1, 3)
        )
        contacts, normals, gaps = self._contacts(places[last:], pushing[len(pads) :], position)
        labels = tuple(f"{touch.name} {told}" for touch, told in zip(self.touches, map(away, gaps), strict=True))
        return Frame(
            caption=_caption(gaps) if self.touches else self.hand.name, bones=places[ends],
            links=places[:first], turned=turned[:first], pads=places[first:last], pushing=pushing[: len(pads)],
            position=position, rotation=np.eye(3), tips=places[last:], places=contacts, normals=normals,
            forces=np.zeros_like(contacts), labels=labels, up=self._up,
        )  # fmt: skip

    def _contacts(self, points: Array, pushing: Array, position: Array) -> tuple[Array, Array, list[float | None]]:
        """Return where pads at points (m, 3) are nearest to the object, the normals into it, and the gaps [m]."""
        radii = np.array([touch.pad.radius for touch in self.touches]).reshape(-1, 1)
        if self.body is None or self.body.shape is None:
            return points + radii * pushing, pushing, [None] * len(points)
        distances, outward = self.body.shape.surface(points - position)
        surface = points - np.reshape(distances, (-1, 1)) * outward
        return surface, -outward, [float(gap) for gap in distances - radii[:, 0]]

    @property
    def _up(self) -> Array:
        """(3,) against gravity; the palm's z where none is known."""
        size = 0.0 if self.gravity is None else float(np.linalg.norm(self.gravity))
        return np.array([0.0, 0.0, 1.0]) if self.gravity is None or size == 0 else -self.gravity / size


def away(gap: float | None) -> str:
    """Return how far a pad is from the surface [m] in words."""
    if gap is None:
        return ""
    if abs(gap) <= WRITTEN:
        return "touches"
    return f"{in_mm(abs(gap))} {'away' if gap > 0 else 'inside'}"


def _caption(gaps: list[float | None]) -> str:
    known = [gap for gap in gaps if gap is not None]
    if not known:
        return "the object has no shape: contacts are where the pads are"
    return f"{sum(abs(gap) <= WRITTEN for gap in known)} of {len(known)} contacts touch"


def middle_of(posed: Posed, q: Array) -> Array:
    """Return the middle (3,) of the pads at joint values (n_q,), or of the links of a hand without any [m]."""
    points = list(_looked_at(posed))
    return np.asarray(posed.hand.kinematics.along(q[None], points).position[0].mean(axis=0))


def _looked_at(posed: Posed) -> Iterator[tuple[str, Array]]:
    pads = [touch.pad for touch in posed.touches] or posed.pads
    if pads:
        yield from ((pad.link, pad.point) for pad in pads)
    else:
        yield from ((link, np.zeros(3)) for link in posed.hand.links)
