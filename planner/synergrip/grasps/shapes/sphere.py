"""A ball."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from synergrip.documents.naming import naming_arguments
from synergrip.documents.quantities import plain
from synergrip.grasps.shapes.shape import Shape, Size, circle
from synergrip.linalg import Array
from synergrip.vectors import lengths_of


@naming_arguments
@dataclass(frozen=True)
class Sphere(Shape):
    """A ball.

    Args:
        radius: greater than 0 [m].

    Raises:
        InputError: a radius that is none.

    Example:
        >>> Sphere(radius=0.05).title
        'ball r 50 mm'
    """

    radius: float  # [m]

    name: ClassVar[str] = "sphere"
    sizes: ClassVar[tuple[Size, ...]] = (Size("radius", "radius"),)

    @property
    def title(self) -> str:
        """Short text."""
        return f"ball r {plain(1e3 * self.radius, 3)} mm"

    def surface(self, points: Array) -> tuple[Array, Array]:
        """Return signed distances and outward normals; at the centre itself the normal is z."""
        lengths = lengths_of(points)
        normals = points / np.where(lengths > 0, lengths, 1.0)[..., None]
        if not lengths.all():
            normals[lengths == 0] = (0.0, 0.0, 1.0)
        return lengths - self.radius, normals

    @property
    def inertia(self) -> Array:
        """``2/5 r^2``."""
        return 0.4 * self.radius**2 * np.eye(3)

    def farthest(self, direction: Array) -> Array:
        """Return the point in that direction."""
        return np.asarray(self.radius * direction)

    def lines(self) -> list[Array]:
        """Return three great circles."""
        x, y = self.radius * circle().T
        zero = np.zeros(len(x))
        return [np.column_stack(part) for part in ((x, y, zero), (x, zero, y), (zero, x, y))]
