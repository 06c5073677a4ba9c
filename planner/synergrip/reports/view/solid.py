"""Solids as triangles: points and the corners of each triangle, counter-clockwise from outside."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from synergrip.grasps.shapes.shape import Shape
from synergrip.linalg import Array, Places

ROUND = 24
"""Corners of what is round."""
STRIPS, NARROW = 6, 0.06
"""How many strips a cone has, and the width of each and of the band along its rim."""
DIRECTIONS = 400
"""In how many directions the farthest point of a shape is looked for."""
SAME = 1e-7
"""Points of a shape nearer than this share of its size are one."""


class Solid(NamedTuple):
    """A solid for a viewer."""

    points: Array  # (n, 3)
    triangles: Places  # (k, 3)


def of_shape(shape: Shape) -> Solid:
    """Return a convex shape: the hull of its farthest points in many directions [m]."""
    found = np.array([shape.farthest(direction) for direction in _directions()])
    size = float(np.abs(found).max())
    _, first = np.unique(np.round(found / (SAME * size)), axis=0, return_index=True)
    return hull(found[np.sort(first)])


def ball() -> Solid:
    """Return a ball of radius 1 around the origin."""
    return hull(_directions()[:: DIRECTIONS // 100])


def rod() -> Solid:
    """Return a cylinder of radius 1 from z = 0 to z = 1."""
    ring = _ring()
    return hull(np.vstack([np.column_stack([ring, np.full(ROUND, z)]) for z in (0.0, 1.0)]))


def cone() -> Solid:
    """Return a cone with its tip at the origin that is open to z = 1, where its radius is 1."""
    ring = np.column_stack([_ring(), np.ones(ROUND)])
    after = np.roll(np.arange(ROUND), -1) + 1
    sides = np.column_stack([np.zeros(ROUND, dtype=int), after, np.arange(ROUND) + 1])
    return Solid(np.vstack([np.zeros(3), ring]), sides)


def ribs() -> Solid:
    """Return a band along the rim of the cone and strips down its sides: opaque, it is seen through what is held."""
    ring, angles = cone().points[1:], np.linspace(0.0, 2 * np.pi, STRIPS, endpoint=False)
    sides = [np.column_stack([np.cos(angles + turn), np.sin(angles + turn), np.ones(STRIPS)]) for turn in (0.0, NARROW)]
    here, first = np.arange(ROUND), 2 * ROUND + 1 + np.arange(STRIPS)
    after = np.roll(here, -1)
    triangles = [(here, after, ROUND + here), (after, ROUND + after, ROUND + here),
                 (np.full(STRIPS, 2 * ROUND), first, first + STRIPS)]  # fmt: skip
    points = np.vstack([ring, (1 - NARROW) * ring, np.zeros((1, 3)), *sides])
    return Solid(points, np.vstack([np.column_stack(corners) for corners in triangles]))


def hull(points: Array) -> Solid:
    """Return the convex hull of points (n, 3)."""
    from scipy.spatial import ConvexHull

    found = ConvexHull(points, qhull_options="Qt")
    corners = points[found.simplices]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    inward = np.einsum("ij,ij->i", across, found.equations[:, :3]) < 0
    triangles = found.simplices.astype(np.intp)
    triangles[inward] = triangles[inward][:, ::-1]
    return Solid(points, triangles)


def _ring() -> Array:
    angles = np.linspace(0.0, 2 * np.pi, ROUND, endpoint=False)
    return np.column_stack([np.cos(angles), np.sin(angles)])


def _directions() -> Array:
    """Return unit vectors (n, 3) that are spread evenly, those along and between the axes first."""
    count = np.arange(DIRECTIONS)
    z = 1 - (2 * count + 1) / DIRECTIONS
    angle = np.pi * (1 + np.sqrt(5.0)) * count
    flat = np.sqrt(1 - z * z)
    return np.column_stack([flat * np.cos(angle), flat * np.sin(angle), z])
