"""Faces that pads roll and slide on: distance of a point from one, its outward normal, and whether it is still there.

A pad stays on the face that it touches at the start: the plane of a side of a box, the mantle or a cap of a cylinder.
Points (B, 3) are in the axes of the object, from its origin.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

Array = np.ndarray


class Face(Protocol):
    """One smooth piece of the surface of an object."""

    def normal(self, points: Array) -> Array:
        """Return the outward normal (B, 3) at the point of the face nearest to each point."""

    def distance(self, points: Array) -> Array:
        """Return how far outside the face each point is (B,)."""

    def beyond(self, points: Array) -> Array:
        """Return how far beyond the edge of the face the nearest points are (B,), <= 0 on it [m]."""


@dataclass(frozen=True)
class Ball:
    """The surface of a sphere about the origin."""

    radius: float

    def normal(self, points: Array) -> Array:
        return points / np.linalg.norm(points, axis=-1, keepdims=True)

    def distance(self, points: Array) -> Array:
        return np.asarray(np.linalg.norm(points, axis=-1) - self.radius)

    def beyond(self, points: Array) -> Array:
        return np.full(len(points), -np.inf)


@dataclass(frozen=True)
class Side:
    """A side of a box."""

    half: Array  # (3,) half of its edges
    axes: Array  # (3, 3) columns: its own axes
    axis: int
    sign: float

    def normal(self, points: Array) -> Array:
        return np.broadcast_to(self.sign * self.axes[:, self.axis], points.shape)

    def distance(self, points: Array) -> Array:
        return self.sign * points @ self.axes[:, self.axis] - self.half[self.axis]

    def beyond(self, points: Array) -> Array:
        others = [i for i in range(3) if i != self.axis]
        return np.asarray((np.abs(points @ self.axes) - self.half)[..., others].max(axis=-1))


@dataclass(frozen=True)
class Mantle:
    """The round side of a cylinder."""

    radius: float
    half: float  # of its height
    along: Array  # (3,) its axis

    def _across(self, points: Array) -> Array:
        return np.asarray(points - np.multiply.outer(points @ self.along, self.along))

    def normal(self, points: Array) -> Array:
        across = self._across(points)
        return np.asarray(across / np.linalg.norm(across, axis=-1, keepdims=True))

    def distance(self, points: Array) -> Array:
        return np.asarray(np.linalg.norm(self._across(points), axis=-1) - self.radius)

    def beyond(self, points: Array) -> Array:
        return np.asarray(np.abs(points @ self.along) - self.half)


@dataclass(frozen=True)
class Cap:
    """A flat end of a cylinder."""

    radius: float
    half: float
    outward: Array  # (3,)

    def normal(self, points: Array) -> Array:
        return np.broadcast_to(self.outward, points.shape)

    def distance(self, points: Array) -> Array:
        return np.asarray(points @ self.outward - self.half)

    def beyond(self, points: Array) -> Array:
        across = points - np.multiply.outer(points @ self.outward, self.outward)
        return np.asarray(np.linalg.norm(across, axis=-1) - self.radius)


def face_at(shape: dict[str, Any], point: Array) -> Face:
    """Return the face of a shape, as plan.json has it, that is nearest to a point (3,) which is not far from it."""
    ((name, sizes),) = shape.items()
    if name == "sphere":
        return Ball(float(sizes["radius_m"]))
    axes = np.array(sizes["rotation"], dtype=float)
    if name == "box":
        half = np.array(sizes["size_m"], dtype=float) / 2
        faces: list[Face] = [Side(half, axes, axis, sign) for axis in range(3) for sign in (1.0, -1.0)]
    elif name == "cylinder":
        radius, half_height = float(sizes["radius_m"]), float(sizes["height_m"]) / 2
        faces = [Mantle(radius, half_height, axes[:, 2])]
        faces += [Cap(radius, half_height, sign * axes[:, 2]) for sign in (1.0, -1.0)]
    else:
        raise ValueError(f"this program knows no shape {name}")
    return max(faces, key=lambda face: float(face.distance(point[None])[0]))
