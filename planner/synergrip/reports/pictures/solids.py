"""Objects as outlines and lines."""

from __future__ import annotations

import numpy as np

from synergrip.grasps.shapes.shape import Shape, circle
from synergrip.linalg import Array
from synergrip.reports.pictures.view import View


def outline(shape: Shape, view: View) -> Array:
    """Return the outline of a solid centred on the origin as a closed polygon on paper (n, 2) [m].

    All shapes are convex: in each direction of the paper the farthest point of the solid is on the outline.
    """
    directions = circle() @ np.vstack([view.right, view.up])
    return view.flat(np.array([shape.farthest(direction) for direction in directions]))


def around(points: Array) -> Array:
    """Return points (n, 2) in the order in which they stand around their middle."""
    from_middle = points - points.mean(axis=0)
    return np.asarray(points[np.argsort(np.arctan2(from_middle[:, 1], from_middle[:, 0]), kind="stable")])
