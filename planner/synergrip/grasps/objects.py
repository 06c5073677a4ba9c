"""What is grasped: a mass, a centre, and optionally a shape with a surface, which may be turned."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from synergrip.documents.judging import Arguments
from synergrip.documents.naming import naming_arguments
from synergrip.grasps.shapes.box import Box as Box
from synergrip.grasps.shapes.cylinder import Cylinder as Cylinder
from synergrip.grasps.shapes.shape import Shape as Shape
from synergrip.grasps.shapes.shape import Size
from synergrip.grasps.shapes.sphere import Sphere as Sphere
from synergrip.linalg import Array, frozen
from synergrip.values import ByContent
from synergrip.vectors import skews

ROTATION = 1e-9
"""How far the products of the columns of a rotation may be from those of unit vectors normal to each other."""

SCIPY = 'scipy.spatial.transform.Rotation.from_euler("x", 90, degrees=True).as_matrix()'


@naming_arguments
@dataclass(frozen=True, eq=False)
class Turned(Shape, ByContent):
    """A shape turned about its centre.

    Args:
        shape: what is turned.
        rotation: (3, 3) columns: the shape's own axes in those of B, such as
            ``scipy.spatial.transform.Rotation.from_euler("x", 90, degrees=True).as_matrix()``.

    Raises:
        InputError: a shape that is none, a matrix that is no rotation.

    Example:
        >>> Turned(Cylinder(radius=0.02, height=0.08), np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])).title
        'cylinder r 20 x 80 mm (turned)'
    """

    shape: Shape
    rotation: Array

    name: ClassVar[str] = "turned"
    sizes: ClassVar[tuple[Size, ...]] = ()

    def __post_init__(self) -> None:
        """Judge shape and rotation."""
        judge = Arguments("Turned")
        judge.one("shape", self.shape, Shape, "Box(size=(0.04, 0.06, 0.1))")
        R = judge.array("rotation", self.rotation, (3, 3), f" of a rotation matrix, such as {SCIPY} makes")
        if not judge.issues and (not np.allclose(R.T @ R, np.eye(3), rtol=0, atol=ROTATION) or np.linalg.det(R) < 0):
            judge.refuse("rotation", f"is no rotation matrix; {SCIPY} makes one")
        judge.finish()
        object.__setattr__(self, "rotation", R)

    @property
    def title(self) -> str:
        """Short text."""
        return f"{self.shape.title} (turned)"

    def surface(self, points: Array) -> tuple[Array, Array]:
        """Return signed distances and outward normals."""
        distances, normals = self.shape.surface(points @ self.rotation)
        return distances, normals @ self.rotation.T

    @property
    def inertia(self) -> Array:
        """That of the shape, turned."""
        return np.asarray(self.rotation @ self.shape.inertia @ self.rotation.T)

    def farthest(self, direction: Array) -> Array:
        """Return that of the shape, turned."""
        return np.asarray(self.rotation @ self.shape.farthest(self.rotation.T @ direction))

    def lines(self) -> list[Array]:
        """Return those of the shape, turned."""
        return [np.asarray(line @ self.rotation.T) for line in self.shape.lines()]


def turn(axis: Sequence[float], angle: float) -> Array:
    """Return the rotation matrix (3, 3) about a unit vector (3,) by `angle` [rad]: the exponential of its cross."""
    skew = skews(np.asarray(axis, dtype=float))
    return frozen(np.eye(3) + np.sin(angle) * skew + (1 - np.cos(angle)) * skew @ skew)


@naming_arguments
@dataclass(frozen=True, kw_only=True, eq=False)
class Object(ByContent):
    """The grasped object. Its frame B sits at `position`, with the axes of the palm.

    Args:
        mass: [kg]; 0 when nothing is said of it, and no gravity and no inertia can be.
        shape: None for a bare mass and frame.
        position: (3,) centre of mass, and origin of B, in the palm frame [m]; None while it is unknown, to be found
            from the contacts.
        title: for people; that of the shape when absent.

    Raises:
        InputError: a negative mass, a shape that is none, a position of other than three finite numbers.

    Example:
        >>> Object(mass=0.2, shape=Sphere(radius=0.05)).title
        'ball r 50 mm'
    """

    mass: float = 0.0
    shape: Shape | None = None
    position: Array = None  # type: ignore[assignment]  # known wherever a grasp has been made
    title: str = ""
    _elsewhere: ClassVar[Mapping[str, str]] = {
        name: "turn the shape: shape=Turned(Box(size=...), rotation)" for name in ("rotation", "orientation")
    }

    def __post_init__(self) -> None:
        """Judge the values."""
        judge = Arguments("Object")
        mass = judge.number("mass", self.mass, at_least=0, unit="kg")
        if self.shape is not None:
            judge.one("shape", self.shape, Shape, "Sphere(radius=0.05)")
        position = None if self.position is None else judge.array("position", self.position, (3,))
        title = judge.text("title", self.title)
        judge.finish()
        object.__setattr__(self, "mass", mass)
        object.__setattr__(self, "position", position)
        object.__setattr__(self, "title", title or (self.shape.title if self.shape else "object"))

    @property
    def placed(self) -> bool:
        """Whether it is known where it is."""
        return self.position is not None
