"""Round tips that roll on the object: where a tip is depends on the way that it came."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from synergrip.equilibrium.meeting import Meeting, Model, Placed, bending, on_face
from synergrip.grasps.shapes.shape import Shape
from synergrip.linalg import Array
from synergrip.vectors import crossed, rotation_vectors, skews, times

BENT = 1e-4
"""Share of a tip's radius over which the bending of the surface is looked at."""
SAME = 1e-12
"""Share of the distance of a tip from the object's origin by which it may still change when its way is found."""


@dataclass(frozen=True, eq=False, repr=False)
class Rolling(Model):
    """Rigid round tips that roll on the surface, held to their links by springs at their centres."""

    shape: Shape
    radius: Array
    """(n,) distances of the tips' centres from the surface [m]."""
    centre: Array  # (n, 3) of the tips so far, from B, axes of B
    frame: Array  # (n, 3, 3) of the contacts so far, axes of B
    link: Array  # (n, 3, 3) rotations of the links so far, from the start, axes of B
    about: Array
    """(n, 3) how far the links have turned against the object about n, t, o [rad]."""

    @classmethod
    def at_start(cls, shape: Shape, centres: Array, frames: Array) -> Rolling:
        """Return the model of tips (n, 3) that touch the surface with frames (n, 3, 3)."""
        n = len(centres)
        links = np.broadcast_to(np.eye(3), (n, 3, 3))
        return cls(shape, shape.surface(centres)[0], centres, frames, links, np.zeros((n, 3)))

    def at(self, placed: Placed, near: Array | None) -> Meeting:
        """Return the contacts: what a link turns relative to the object, its tip rolls."""
        relative = placed.relative
        before = np.concatenate([self.link[None], relative[:-1]])
        turns = rotation_vectors(relative @ before.mT)  # axes of B
        centres, outward = self._way(turns, placed.seen if near is None else near)
        frames = self._frames(outward)
        halfway = (np.concatenate([self.frame[None], frames[:-1]]) + frames) / 2
        stretch = np.concatenate([
            times(frames.mT, placed.seen - centres), self.about + np.cumsum(times(halfway.mT, turns), axis=0),
        ], axis=-1)  # fmt: skip
        turned = placed.rotation[:, None] @ frames
        place = placed.point + self.radius[:, None] * turned[..., 0]
        left = on_face(self.shape, centres, np.broadcast_to(self.radius, centres.shape[:2]), outward)
        return Meeting(place, turned, stretch, centres, left)

    def rolled(self, placed: Placed, meeting: Meeting) -> tuple[Array, Array]:
        """Return how frames turn as tips roll on to where the surface has another normal, and arms with them."""
        outward = skews(-(placed.rotation.mT[:, None] @ meeting.frame)[..., 0])
        bent = self.radius[:, None, None] * bending(self.shape, meeting.centre, BENT * self.radius)
        frames = placed.rotation[:, None] @ -(outward @ bent @ outward) @ placed.rotation.mT[:, None]
        return frames, frames - np.eye(3)

    def after(self, placed: Placed, meeting: Meeting) -> Rolling:
        """Return the model with the way of the instants behind it."""
        frame = placed.rotation[-1].T @ meeting.frame[-1]
        return replace(self, centre=meeting.centre[-1], frame=frame, link=placed.relative[-1],
                       about=meeting.stretch[-1, :, 3:])  # fmt: skip

    def _way(self, turns: Array, near: Array) -> tuple[Array, Array]:
        """Return centres (T, n, 3) and outward normals there for turns (T, n, 3) from one instant to the next.

        From one instant to the next a centre moves by ``theta x radius nu``, with the normal nu half-way, and is put
        back to its distance from the surface. All instants are looked at in one go: steps from centres that are near
        add up to centres that are nearer, by the angle of the whole turn and more each time, until they stay; then
        each step begins where the one before it ends.
        """
        centres, outward = self._put_back(near)
        first = self._put_back(self.centre)
        close = SAME * float(np.abs(self.centre).max(initial=0.0))
        way = skews(self.radius[:, None] * turns)
        for _ in range(len(turns) + 1):  # each time one instant more is as if they had been gone one by one
            start = np.concatenate([self.centre[None], centres[:-1]])
            nu = np.concatenate([first[1][None], outward[:-1]])
            middle = self.shape.surface(start + times(way, nu / 2))[1]
            moved, _ = self._put_back(start + times(way, middle))
            found, outward = self._put_back(self.centre + np.cumsum(moved - start, axis=0))
            change, centres = np.abs(found - centres).max(initial=0.0), found
            if not change > close:
                break
        return centres, outward

    def _put_back(self, points: Array) -> tuple[Array, Array]:
        """Return points (..., n, 3) put to the distance of the tips from the surface, and the outward normals there."""
        distance, outward = self.shape.surface(points)
        return points + (self.radius - distance)[..., None] * outward, outward

    def _frames(self, outward: Array) -> Array:
        """Return frames (T, n, 3, 3) whose tangents are carried along with outward normals (T, n, 3)."""
        normals = np.concatenate([self.frame[None, ..., 0], -outward])
        turned = carried_along(normals[:-1], normals[1:])
        count = 1
        while count < len(turned):  # what each instant turns becomes what all up to it turn
            turned[count:] = turned[count:] @ turned[:-count]
            count *= 2
        return np.asarray(turned @ self.frame)


def carried_along(old: Array, new: Array) -> Array:
    """Return the smallest rotations (..., 3, 3) that turn unit vectors (..., 3) into others, not their opposites."""
    skew = skews(crossed(old, new))
    return np.asarray(np.eye(3) + skew + skew @ skew / (1.0 + (old * new).sum(axis=-1))[..., None, None])
