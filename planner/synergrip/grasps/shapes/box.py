"""A box."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from typing import ClassVar

import numpy as np

from synergrip.documents.naming import naming_arguments
from synergrip.documents.quantities import plain
from synergrip.grasps.shapes.shape import Shape, Size
from synergrip.linalg import Array


@naming_arguments
@dataclass(frozen=True)
class Box(Shape):
    """A box with faces normal to the axes.

    Args:
        size: (3,) edge lengths, each greater than 0 [m].

    Raises:
        InputError: a size that is none.

    Example:
        >>> Box(size=(0.04, 0.06, 0.1)).title
        'box 40 x 60 x 100 mm'
    """

    size: tuple[float, float, float]  # edge lengths [m]

    name: ClassVar[str] = "box"
    sizes: ClassVar[tuple[Size, ...]] = (Size("size", "three edge lengths", count=3),)

    @property
    def title(self) -> str:
        """Short text."""
        return "box " + " x ".join(plain(1e3 * edge, 3) for edge in self.size) + " mm"

    def surface(self, points: Array) -> tuple[Array, Array]:
        """Return signed distances and the normals of the nearest faces (of the corner direction outside an edge)."""
        over = np.abs(points) - np.array(self.size) / 2
        outside = np.maximum(over, 0.0)
        distance = np.linalg.norm(outside, axis=-1, keepdims=True)
        nearest = np.eye(3)[np.argmax(over, axis=-1)]
        outward = np.where(distance > 0, outside / np.where(distance > 0, distance, 1.0), nearest)
        normals = np.where(np.asarray(points) >= 0, outward, -outward)
        return np.where(distance > 0, distance, over.max(axis=-1, keepdims=True))[..., 0], normals

    @property
    def inertia(self) -> Array:
        """``(b^2 + c^2) / 12`` about the edge a, and so on."""
        squares = np.square(self.size)
        return np.diag(squares.sum() - squares) / 12

    def farthest(self, direction: Array) -> Array:
        """Return the corner in that direction."""
        return np.asarray(np.copysign(0.5, direction) * np.array(self.size))

    def lines(self) -> list[Array]:
        """Return the edges."""
        corners = np.array(list(product((-0.5, 0.5), repeat=3)))
        edges = [(a, b) for a, b in product(corners, repeat=2) if np.sum(a != b) == 1 and tuple(a) < tuple(b)]
        return [np.array(edge) * np.array(self.size) for edge in edges]
