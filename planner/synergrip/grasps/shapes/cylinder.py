"""A cylinder."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from synergrip.documents.naming import naming_arguments
from synergrip.documents.quantities import plain
from synergrip.grasps.shapes.shape import Shape, Size, circle
from synergrip.linalg import Array


@naming_arguments
@dataclass(frozen=True)
class Cylinder(Shape):
    """A cylinder about z.

    Args:
        radius: greater than 0 [m].
        height: greater than 0 [m].

    Raises:
        InputError: a size that is none.

    Example:
        >>> Cylinder(radius=0.02, height=0.08).title
        'cylinder r 20 x 80 mm'
    """

    radius: float  # [m]
    height: float  # [m]

    name: ClassVar[str] = "cylinder"
    sizes: ClassVar[tuple[Size, ...]] = (Size("radius", "radius"), Size("height", "height"))

    @property
    def title(self) -> str:
        """Short text."""
        return f"cylinder r {plain(1e3 * self.radius, 3)} x {plain(1e3 * self.height, 3)} mm"

    def surface(self, points: Array) -> tuple[Array, Array]:
        """Return signed distances and the normals of the nearest of side and caps."""
        plane, height = points[..., :2], points[..., 2:]
        across = np.hypot(plane[..., :1], plane[..., 1:])
        side = np.where(across > 0, plane / np.where(across > 0, across, 1.0), (1.0, 0.0))
        over = np.concatenate([across - self.radius, np.abs(height) - self.height / 2], axis=-1)
        outside = np.maximum(over, 0.0)
        distance = np.linalg.norm(outside, axis=-1, keepdims=True)
        nearest = np.eye(2)[np.argmax(over, axis=-1)]
        shares = np.where(distance > 0, outside / np.where(distance > 0, distance, 1.0), nearest)  # of side and cap
        normals = np.concatenate([shares[..., :1] * side, shares[..., 1:] * np.where(height >= 0, 1.0, -1.0)], axis=-1)
        return np.where(distance > 0, distance, over.max(axis=-1, keepdims=True))[..., 0], normals

    @property
    def inertia(self) -> Array:
        """``r^2 / 4 + h^2 / 12`` across, ``r^2 / 2`` about z."""
        across = self.radius**2 / 4 + self.height**2 / 12
        return np.diag([across, across, self.radius**2 / 2])

    def farthest(self, direction: Array) -> Array:
        """Return the point of a rim in that direction."""
        across = direction[:2] / max(float(np.linalg.norm(direction[:2])), 1e-12)
        return np.array([*(self.radius * across), np.copysign(self.height / 2, direction[2])])

    def lines(self) -> list[Array]:
        """Return the two rims."""
        x, y = self.radius * circle().T
        return [np.column_stack([x, y, np.full(len(x), z)]) for z in (-self.height / 2, self.height / 2)]
