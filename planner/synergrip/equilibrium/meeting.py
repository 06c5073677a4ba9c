"""How pads and the object meet: models of contacts, each a function of where links and object are.

All return where the force acts, its frame, and the stretch of the contact's springs since the start, such that the
Jacobians of hand and object at that point are the derivatives of the stretch. So hand and object feel equal and
opposite forces, whatever the motion.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from synergrip.grasps.contacts.contact import contact_frames
from synergrip.grasps.shapes.shape import Shape
from synergrip.linalg import Array, Places
from synergrip.values import Value
from synergrip.vectors import rotation_vectors, times

EDGE = 1e-6
"""How far a normal may be from that a little inside of the surface, where there is no edge."""
BENT = 1e-4
"""Share of how far a pad is from the object's origin over which the bending of the surface is looked at."""
INSIDE = 1e-3
"""Share of the distance of a pad's centre from the surface that is a little inside."""


@dataclass(frozen=True, eq=False, repr=False)
class Placed(Value):
    """n links and the object at T instants, palm frame."""

    point: Array
    """(T, n, 3) the point of each link that the model speaks of [m]."""
    link: Array  # (T, n, 3, 3) rotations of the links from the start
    position: Array  # (T, 3) of the object frame B
    rotation: Array  # (T, 3, 3) of the object from the start

    @cached_property
    def seen(self) -> Array:
        """(T, n, 3) the points from B, axes of B."""
        return np.asarray((self.point - self.position[:, None]) @ self.rotation)

    @cached_property
    def relative(self) -> Array:
        """(T, n, 3, 3) rotations of the links from the start, axes of B."""
        return np.asarray(self.rotation.mT[:, None] @ self.link)

    def of(self, places: Places) -> Placed:
        """Return them for some of the links."""
        return Placed(self.point[:, places], self.link[:, places], self.position, self.rotation)


@dataclass(frozen=True, eq=False, repr=False)
class Meeting(Value):
    """n contacts at T instants."""

    place: Array  # (T, n, 3) where the forces act, palm frame
    frame: Array  # (T, n, 3, 3) columns n, t, o
    stretch: Array
    """(T, n, 6) of the springs since the start, along and about n, t, o [m, rad]: above 0 where hands push more."""
    centre: Array
    """(T, n, 3) where the object's end of the springs is, from B, axes of B [m]: of a rolling tip its centre."""
    left: Places
    """(n,) how many instants pass before each contact is no longer on its face; T when it stays there."""

    def taken(self, places: Any) -> Meeting:
        """Return them at some of the instants; when they left is told of all."""
        return Meeting(self.place[places], self.frame[places], self.stretch[places], self.centre[places], self.left)

    def of(self, places: Places) -> Meeting:
        """Return some of the contacts."""
        return self.taken((slice(None), places))


@dataclass(frozen=True, eq=False, repr=False)
class Slid(Value):
    """Pads that slide without friction."""

    which: NDArray[np.bool_]
    """(n,) which of the contacts do."""
    bent: Array
    """(T, n, 3, 3) how the outward normals change with the pads' points, palm axes [1/m]; 0 for the others."""


class Model(ABC):
    """How n contacts move."""

    def __repr__(self) -> str:
        """Return its kind."""
        return f"{type(self).__name__}()"

    @abstractmethod
    def at(self, placed: Placed, near: Array | None) -> Meeting:
        """Return the contacts at the instants, in the order in which they happen.

        Args:
            placed: links and object.
            near: (T, n, 3) centres that are not far from those to be found, which depend on the way; when known.
        """

    def rolled(self, placed: Placed, meeting: Meeting) -> tuple[Array, Array]:
        """Return what a small turn of a link against the object makes (T, n, 3, 3), beyond what the object turns.

        First how the frame turns; then how the arm from the link's point to the force does, as a part of the link.
        """
        none = np.zeros_like(meeting.frame)
        return none, none

    def slid(self, placed: Placed, meeting: Meeting) -> Slid | None:
        """Return how normals change where pads slide; None where none does."""
        return None

    def after(self, placed: Placed, meeting: Meeting) -> Model:
        """Return what the model is after the instants: one that remembers its way has gone it."""
        return self


@dataclass(frozen=True, eq=False, repr=False)
class Several(Model):
    """Contacts of different models."""

    parts: tuple[tuple[Places, Model], ...]
    """Which contacts, and how they move."""

    def at(self, placed: Placed, near: Array | None) -> Meeting:
        """Return all contacts, in their order."""
        found = [model.at(placed.of(own), None if near is None else near[:, own]) for own, model in self.parts]
        order = np.argsort(np.concatenate([own for own, _ in self.parts]))
        place, frame, stretch, centre = (
            np.concatenate([getattr(part, name) for part in found], axis=1)[:, order]
            for name in ("place", "frame", "stretch", "centre")
        )
        return Meeting(place, frame, stretch, centre, np.concatenate([part.left for part in found])[order])

    def rolled(self, placed: Placed, meeting: Meeting) -> tuple[Array, Array]:
        """Return it for all contacts, in their order."""
        frames, arms = np.zeros_like(meeting.frame), np.zeros_like(meeting.frame)
        for own, model in self.parts:
            frames[:, own], arms[:, own] = model.rolled(placed.of(own), meeting.of(own))
        return frames, arms

    def slid(self, placed: Placed, meeting: Meeting) -> Slid | None:
        """Return it for all contacts, in their order."""
        which, bent = np.zeros(meeting.frame.shape[1], dtype=bool), np.zeros_like(meeting.frame)
        for own, model in self.parts:
            if (found := model.slid(placed.of(own), meeting.of(own))) is not None:
                which[own], bent[:, own] = found.which, found.bent
        return Slid(which, bent) if which.any() else None

    def after(self, placed: Placed, meeting: Meeting) -> Several:
        """Return the models, each after its instants."""
        return Several(tuple((own, model.after(placed.of(own), meeting.of(own))) for own, model in self.parts))


@dataclass(frozen=True, eq=False, repr=False)
class Stuck(Model):
    """Points of the links and points of the object that springs hold together; their frames turn with the object."""

    points: Array  # (n, 3) of the object, from B
    frames: Array  # (n, 3, 3)
    turns: bool
    """Whether any of the springs is about an axis."""

    def at(self, placed: Placed, near: Array | None) -> Meeting:
        """Return the stretch between the two points; the force acts at the link's."""
        stretch = np.zeros((*placed.point.shape[:2], 6))
        stretch[..., :3] = times(self.frames.mT, placed.seen - self.points)
        if self.turns:
            stretch[..., 3:] = times(self.frames.mT, rotation_vectors(placed.relative))
        centre = np.broadcast_to(self.points, placed.point.shape)
        return Meeting(placed.point, placed.rotation[:, None] @ self.frames, stretch, centre, whole(placed))


@dataclass(frozen=True, eq=False, repr=False)
class Sliding(Model):
    """Pads that slide over the surface without friction: their distance counts, and nothing else."""

    shape: Shape
    radius: Array
    """(n,) distances of their points from the surface at the start [m]."""

    def at(self, placed: Placed, near: Array | None) -> Meeting:
        """Return how much nearer the pads are; the force acts where the surface is nearest."""
        distance, outward = self.shape.surface(placed.seen)
        frame = placed.rotation[:, None] @ contact_frames(-outward)
        stretch = np.zeros((*outward.shape[:2], 6))
        stretch[..., 0] = self.radius - distance
        place = placed.point + distance[..., None] * frame[..., 0]
        return Meeting(place, frame, stretch, placed.seen, on_face(self.shape, placed.seen, distance, outward))

    def slid(self, placed: Placed, meeting: Meeting) -> Slid:
        """Return it by differences, a small share of the way from B apart."""
        seen = placed.seen
        bent = bending(self.shape, seen, np.full(seen.shape[1], BENT * np.abs(seen).max(initial=0.0)))
        whole = placed.rotation[:, None] @ bent @ placed.rotation.mT[:, None]
        return Slid(np.ones(seen.shape[1], dtype=bool), whole)


def bending(shape: Shape, points: Array, steps: Array) -> Array:
    """Return how outward normals change with points (T, n, 3): (T, n, 3, 3) [1/m], by differences over steps (n,)."""
    ways = steps[:, None] * np.eye(3)[:, None, None]
    sides = [shape.surface(points + sign * ways)[1] for sign in (1, -1)]
    return np.moveaxis(sides[0] - sides[1], 0, -1) / (2 * steps[:, None, None])


def on_face(shape: Shape, points: Array, distances: Array, outward: Array) -> Places:
    """Return (n,) how many instants pass before the point of the surface nearest to each point is on an edge."""
    depth = distances + INSIDE * np.maximum(np.abs(distances), INSIDE)
    inner = shape.surface(points - depth[..., None] * outward)[1]
    off = (outward * inner).sum(axis=-1) < 1 - EDGE
    return np.where(off.any(axis=0), off.argmax(axis=0), len(off))


def whole(placed: Placed) -> Places:
    """Return (n,) that contacts stay on their faces at all instants."""
    return np.full(placed.point.shape[1], len(placed.point))
