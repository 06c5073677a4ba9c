"""How a pad and the object meet: three models of a contact, each a function of where link and object are.

All return where the force acts, its frame, and the stretch of the contact's springs since the start, such that the
Jacobians of hand and object at that point are the derivatives of the stretch. So hand and object feel equal and
opposite forces, whatever the motion.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any

import numpy as np

from synergrip.grasps.contacts.contact import contact_frame
from synergrip.grasps.shapes.shape import Shape
from synergrip.linalg import Array, cross
from synergrip.values import Value

EDGE = 1e-6
"""How far a normal may be from that a little inside of the surface, where there is no edge."""
INSIDE = 1e-3
"""Share of the distance of a pad's centre from the surface that is a little inside."""


@dataclass(frozen=True, eq=False, repr=False)
class Placed(Value):
    """A link and the object at T instants, palm frame."""

    point: Array
    """(T, 3) the point of the link that the model speaks of [m]."""
    link: Array  # (T, 3, 3) rotation of the link from the start
    position: Array  # (T, 3) of the object frame B
    rotation: Array  # (T, 3, 3) of the object from the start

    def taken(self, places: Any) -> Placed:
        """Return them at some of the instants."""
        return Placed(self.point[places], self.link[places], self.position[places], self.rotation[places])


@dataclass(frozen=True, eq=False, repr=False)
class Meeting(Value):
    """A contact at T instants."""

    place: Array  # (T, 3) where the force acts, palm frame
    frame: Array  # (T, 3, 3) columns n, t, o
    stretch: Array
    """(T, 6) of its springs since the start, along and about n, t, o [m, rad]: positive where the hand pushes more."""
    left: int | None = None
    """The first instant at which the contact is no longer on its face; None when it stays there."""

    def taken(self, places: Any) -> Meeting:
        """Return it at some of the instants."""
        return Meeting(self.place[places], self.frame[places], self.stretch[places], self.left)


class Model(ABC):
    """How a contact moves."""

    @abstractmethod
    def at(self, placed: Placed) -> Meeting:
        """Return the contact at the instants, in the order in which they happen."""

    def after(self, placed: Placed) -> Model:
        """Return what the model is after the instants: one that remembers its way has gone it."""
        return self


@dataclass(frozen=True, eq=False)
class Stuck(Model):
    """A point of the link and a point of the object that springs hold together; its frame turns with the object."""

    point: Array  # (3,) of the object, from B
    frame: Array  # (3, 3)
    turns: bool
    """Whether any of its springs is about an axis."""

    def at(self, placed: Placed) -> Meeting:
        """Return the stretch between the two points; the force acts at the link's."""
        frame = placed.rotation @ self.frame
        apart = placed.point - placed.position - placed.rotation @ self.point
        stretch = np.zeros((len(apart), 6))
        stretch[:, :3] = np.einsum("tji,tj->ti", frame, apart)
        if self.turns:
            stretch[:, 3:] = rotation_vectors(placed.rotation.mT @ placed.link) @ self.frame
        return Meeting(placed.point, frame, stretch)


@dataclass(frozen=True, eq=False)
class Sliding(Model):
    """A pad that slides over the surface without friction: its distance counts, and nothing else."""

    shape: Shape
    radius: float
    """Distance of its point from the surface at the start [m]."""

    def at(self, placed: Placed) -> Meeting:
        """Return how much nearer the pad is; the force acts where the surface is nearest."""
        inside = np.einsum("tji,tj->ti", placed.rotation, placed.point - placed.position)
        distance, outward = surface_at(self.shape, inside)
        frame = placed.rotation @ np.array([contact_frame(normal) for normal in -outward])
        stretch = np.zeros((len(inside), 6))
        stretch[:, 0] = self.radius - distance
        place = placed.point + distance[:, None] * frame[:, :, 0]
        return Meeting(place, frame, stretch, first_off(self.shape, inside, distance, outward))


@dataclass(frozen=True, eq=False)
class Rolling(Model):
    """A rigid round tip that rolls on the surface, held to its link by springs at its centre."""

    shape: Shape
    radius: float
    """Distance of the tip's centre from the surface [m]."""
    centre: Array  # (3,) of the tip so far, from B, axes of B
    frame: Array  # (3, 3) of the contact so far, axes of B
    link: Array  # (3, 3) rotation of the link so far, from the start, axes of B
    about: Array
    """(3,) how far the link has turned against the object about n, t, o [rad]."""

    @classmethod
    def at_start(cls, shape: Shape, centre: Array, frame: Array) -> Rolling:
        """Return the model of a tip that touches the surface with a frame (3, 3)."""
        return cls(shape, shape.surface(centre)[0], centre, frame, np.eye(3), np.zeros(3))

    def at(self, placed: Placed) -> Meeting:
        """Return the contact: what the link turns relative to the object, the tip rolls."""
        centres, frames, angles = self._way(placed)
        turned = placed.rotation @ frames
        apart = placed.point - placed.position - np.einsum("tij,tj->ti", placed.rotation, centres)
        stretch = np.hstack([np.einsum("tji,tj->ti", turned, apart), angles])
        left = first_off(self.shape, centres, np.full(len(centres), self.radius), -frames[:, :, 0])
        return Meeting(placed.point + self.radius * turned[:, :, 0], turned, stretch, left)

    def after(self, placed: Placed) -> Rolling:
        """Return the model with the way of the instants behind it."""
        centres, frames, angles = self._way(placed)
        link = placed.rotation[-1].T @ placed.link[-1]
        return Rolling(self.shape, self.radius, centres[-1], frames[-1], link, angles[-1])

    def _way(self, placed: Placed) -> tuple[Array, Array, Array]:
        """Return centres (T, 3), frames (T, 3, 3) and turned angles (T, 3).

        From one instant to the next the centre moves by ``theta x radius nu``, with the normal nu half-way, and is put
        back to its distance from the surface; the tangents are carried along.
        """
        relative = placed.rotation.mT @ placed.link
        before = np.concatenate([self.link[None], relative[:-1]])
        turns = rotation_vectors(relative @ before.mT)  # axes of B
        centre, frame, about = self.centre, self.frame, self.about
        found = []
        for turn in turns:
            outward = -frame[:, 0]
            middle = self.shape.surface(centre + np.cross(turn, self.radius * outward) / 2)[1]
            moved = centre + np.cross(turn, self.radius * middle)
            distance, new = self.shape.surface(moved)
            centre = moved + (self.radius - distance) * new
            carried = carried_along(outward, new) @ frame
            about, frame = about + (frame + carried).T @ turn / 2, carried
            found.append((centre, frame, about))
        centres, frames, angles = zip(*found, strict=True)
        return np.array(centres), np.array(frames), np.array(angles)


def surface_at(shape: Shape, points: Array) -> tuple[Array, Array]:
    """Return distances (T,) and outward normals (T, 3) of points (T, 3)."""
    found = [shape.surface(point) for point in points]
    return np.array([distance for distance, _ in found]), np.array([normal for _, normal in found]).reshape(-1, 3)


def first_off(shape: Shape, points: Array, distances: Array, outward: Array) -> int | None:
    """Return the first of the instants at which the nearest point of the surface is on an edge."""
    for k, (point, distance, normal) in enumerate(zip(points, distances, outward, strict=True)):
        inner = shape.surface(point - (distance + INSIDE * max(abs(distance), INSIDE)) * normal)[1]
        if normal @ inner < 1 - EDGE:
            return k
    return None


def rotation_vectors(rotations: Array) -> Array:
    """Return rotation vectors (T, 3) of rotation matrices (T, 3, 3)."""
    from scipy.spatial.transform import Rotation

    return np.asarray(Rotation.from_matrix(np.array(rotations)).as_rotvec())


def carried_along(old: Array, new: Array) -> Array:
    """Return the smallest rotation (3, 3) that turns one unit vector into another that is not its opposite."""
    skew = cross(np.cross(old, new))
    return np.asarray(np.eye(3) + skew + skew @ skew / (1.0 + old @ new))
