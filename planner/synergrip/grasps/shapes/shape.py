"""What every shape of an object is: a convex solid that knows its surface, its inertia and how it is drawn."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from synergrip.documents.judging import Arguments
from synergrip.documents.naming import Finished
from synergrip.linalg import Array
from synergrip.values import Kept

ROUND = 72
"""Points of a circle that is drawn."""


@dataclass(frozen=True)
class Size:
    """A size of a shape: the argument in code, and the key in a problem file, of the same name."""

    name: str
    meaning: str
    count: int = 1
    """Lengths that it is made of."""


class Shape(Finished, Kept, ABC):
    """A convex solid of uniform density, centred on the object frame B, with its axes.

    Example:
        >>> isinstance(Sphere(radius=0.05), Shape)
        True
    """

    name: ClassVar[str]
    """Key in problem files."""
    sizes: ClassVar[tuple[Size, ...]]
    """One for each argument."""

    _example = "Sphere(radius=0.05)"

    def __post_init__(self) -> None:
        """Judge the sizes, each of which is a length or lengths greater than 0."""
        judge = Arguments(type(self).__name__)
        for size in self.sizes:
            value = getattr(self, size.name)
            if size.count == 1:
                kept: float | tuple[float, ...] = judge.number(size.name, value, above=0, unit="m")
            else:
                kept = tuple(judge.array(size.name, value, (size.count,), f": {size.meaning}").tolist())
                if not judge.issues and not min(kept) > 0:
                    judge.refuse(size.name, f"each must be greater than 0, got {min(kept):g}")
            object.__setattr__(self, size.name, kept)
        judge.finish()

    @property
    @abstractmethod
    def title(self) -> str:
        """Short text, for example ``ball r 45.8 mm``."""

    @abstractmethod
    def surface(self, points: Array) -> tuple[Array, Array]:
        """Return distances (...) of points (..., 3) to the surface [m] (> 0 outside) and outward unit normals."""

    @property
    @abstractmethod
    def inertia(self) -> Array:
        """Inertia tensor (3, 3) about the centre, for each kilogram of mass [m^2]."""

    @abstractmethod
    def farthest(self, direction: Array) -> Array:
        """Return the point (3,) of the solid that is farthest along a unit vector (3,) [m]."""

    @abstractmethod
    def lines(self) -> list[Array]:
        """Return the lines that make it look solid in a picture, each (n, 3) [m]."""


def circle() -> Array:
    """Return (n, 2) points of the unit circle, the first one twice."""
    angles = np.linspace(0.0, 2 * np.pi, ROUND, endpoint=False)
    points = np.column_stack([np.cos(angles), np.sin(angles)])
    return np.vstack([points, points[:1]])
