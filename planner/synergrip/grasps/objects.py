"""What is grasped: a mass, a centre, and optionally a shape with a surface."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from synergrip.linalg import Array, frozen


class Shape(Protocol):
    """A solid centred on the object frame B, with its axes."""

    @property
    def title(self) -> str:
        """Short text, for example ``ball r 45.8 mm``."""

    def surface(self, point: Array) -> tuple[float, Array]:
        """Return the signed distance of `point` (3,) [m] to the surface (> 0 outside) and the unit outward normal."""


@dataclass(frozen=True)
class Sphere:
    """A ball."""

    radius: float  # [m]

    @property
    def title(self) -> str:
        """Short text."""
        return f"ball r {self.radius * 1e3:.3g} mm"

    def surface(self, point: Array) -> tuple[float, Array]:
        """Return signed distance and outward normal; at the centre itself the normal is z."""
        length = float(np.linalg.norm(point))
        normal = point / length if length > 0 else np.array([0.0, 0.0, 1.0])
        return length - self.radius, normal


@dataclass(frozen=True)
class Box:
    """A box with faces normal to the axes."""

    size: tuple[float, float, float]  # edge lengths [m]

    @property
    def title(self) -> str:
        """Short text."""
        return "box " + " x ".join(f"{edge * 1e3:.3g}" for edge in self.size) + " mm"

    def surface(self, point: Array) -> tuple[float, Array]:
        """Return signed distance and the normal of the nearest face (of the corner direction outside an edge)."""
        over = np.abs(point) - np.array(self.size) / 2
        outside = np.maximum(over, 0.0)
        distance = float(np.linalg.norm(outside))
        if distance > 0:
            return distance, np.sign(point) * outside / distance
        face = int(np.argmax(over))
        normal = np.zeros(3)
        normal[face] = 1.0 if point[face] >= 0 else -1.0
        return float(over[face]), normal


@dataclass(frozen=True)
class Cylinder:
    """A cylinder about z."""

    radius: float  # [m]
    height: float  # [m]

    @property
    def title(self) -> str:
        """Short text."""
        return f"cylinder r {self.radius * 1e3:.3g} x {self.height * 1e3:.3g} mm"

    def surface(self, point: Array) -> tuple[float, Array]:
        """Return signed distance and the normal of the nearest of side and caps."""
        across = float(np.hypot(point[0], point[1]))
        side = np.array([point[0] / across, point[1] / across, 0.0]) if across > 0 else np.array([1.0, 0.0, 0.0])
        cap = np.array([0.0, 0.0, 1.0 if point[2] >= 0 else -1.0])
        over = np.array([across - self.radius, abs(point[2]) - self.height / 2])
        outside = np.maximum(over, 0.0)
        distance = float(np.linalg.norm(outside))
        if distance > 0:
            return distance, (outside[0] * side + outside[1] * cap) / distance
        return (float(over[0]), side) if over[0] >= over[1] else (float(over[1]), cap)


@dataclass(frozen=True, eq=False)
class Turned:
    """A shape turned about its centre."""

    shape: Shape
    rotation: Array
    """(3, 3) columns: the shape's own axes in those of B."""

    @property
    def title(self) -> str:
        """Short text."""
        return f"{self.shape.title} (turned)"

    def surface(self, point: Array) -> tuple[float, Array]:
        """Return signed distance and outward normal."""
        distance, normal = self.shape.surface(self.rotation.T @ point)
        return distance, self.rotation @ normal


def turn(axis: Sequence[float], angle: float) -> Array:
    """Return the rotation matrix (3, 3) about a unit vector (3,) by `angle` [rad]: the exponential of its cross."""
    x, y, z = axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return frozen(np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross)


@dataclass(frozen=True)
class Object:
    """The grasped object. Its frame B sits at `position`, with the axes of the palm."""

    title: str
    mass: float  # [kg]
    position: Array
    """(3,) centre of mass, and origin of B, in the palm frame [m]."""
    shape: Shape | None
    """None for a bare mass and frame."""
