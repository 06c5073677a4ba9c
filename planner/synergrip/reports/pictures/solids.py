"""Objects as outlines and lines."""

from __future__ import annotations

from itertools import product

import numpy as np

from synergrip.grasps.objects import Box, Cylinder, Shape, Sphere, Turned
from synergrip.linalg import Array
from synergrip.reports.pictures.view import View

ROUND = 72
"""Points of a circle."""


def outline(shape: Shape, view: View) -> Array:
    """Return the outline of a solid centred on the origin as a closed polygon on paper (n, 2) [m].

    All shapes are convex: in each direction of the paper the farthest point of the solid is on the outline.
    """
    directions = circle() @ np.vstack([view.right, view.up])
    return view.flat(np.array([_farthest(shape, direction) for direction in directions]))


def lines(shape: Shape) -> list[Array]:
    """Return the lines that make a solid look solid, each (n, 3), centred on the origin [m]."""
    if isinstance(shape, Turned):
        return [np.asarray(line @ shape.rotation.T) for line in lines(shape.shape)]
    if isinstance(shape, Sphere):
        x, y = shape.radius * circle().T
        zero = np.zeros(len(x))
        return [np.column_stack(part) for part in ((x, y, zero), (x, zero, y), (zero, x, y))]
    if isinstance(shape, Cylinder):
        x, y = shape.radius * circle().T
        return [np.column_stack([x, y, np.full(len(x), z)]) for z in (-shape.height / 2, shape.height / 2)]
    if isinstance(shape, Box):
        corners = np.array(list(product((-0.5, 0.5), repeat=3)))
        edges = [(a, b) for a, b in product(corners, repeat=2) if np.sum(a != b) == 1 and tuple(a) < tuple(b)]
        return [np.array(edge) * np.array(shape.size) for edge in edges]
    return []


def around(points: Array) -> Array:
    """Return points (n, 2) in the order in which they stand around their middle."""
    from_middle = points - points.mean(axis=0)
    return np.asarray(points[np.argsort(np.arctan2(from_middle[:, 1], from_middle[:, 0]), kind="stable")])


def _farthest(shape: Shape, direction: Array) -> Array:
    """Return the point (3,) of the solid that is farthest along `direction` (3,)."""
    if isinstance(shape, Turned):
        return np.asarray(shape.rotation @ _farthest(shape.shape, shape.rotation.T @ direction))
    if isinstance(shape, Sphere):
        return np.asarray(shape.radius * direction)
    if isinstance(shape, Box):
        return np.asarray(np.copysign(0.5, direction) * np.array(shape.size))
    if isinstance(shape, Cylinder):
        across = direction[:2] / max(float(np.linalg.norm(direction[:2])), 1e-12)
        return np.array([*(shape.radius * across), np.copysign(shape.height / 2, direction[2])])
    return np.zeros(3)


def circle() -> Array:
    """Return (n, 2) points of the unit circle, the first one twice."""
    angles = np.linspace(0.0, 2 * np.pi, ROUND, endpoint=False)
    points = np.column_stack([np.cos(angles), np.sin(angles)])
    return np.vstack([points, points[:1]])
