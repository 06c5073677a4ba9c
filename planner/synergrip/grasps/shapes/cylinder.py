"""A cylinder."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from synergrip.documents.naming import naming_arguments
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
