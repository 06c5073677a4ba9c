"""The hull of what contacts can do to the object with normal forces of one newton together: its ball, its volume."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from synergrip.linalg import Array, Decision, singular_values
from synergrip.values import Value

SURE = 0.01
"""Relative difference of the ends of epsilon at which it is known well enough."""
ROUNDS = 8
"""How often points are added at most to find it."""
FACETS = 16
"""Those nearest to 0 beyond which points are looked for in a round."""
NOTHING = 1e-9
"""Distance of a support below which the origin is at the edge."""
TURNS = 6
"""How often the nearest supporting plane is turned."""
MOST_FACETS = 10_000
"""Of a hull to which points are added."""
SHORT = 1e-7
"""Share by which a ball stays short of the nearest facet, as facets are merged and points moved by rounding."""


@dataclass(frozen=True, eq=False, repr=False)
class HullFigures(Value):
    """Figures of a convex set of wrenches in scaled coordinates that contains 0."""

    epsilon: tuple[float, float]
    """Radius of the largest ball about 0: at least, at most."""
    volume: float
    """Of a hull of points of the set: at least."""


Farthest = Callable[[Array], tuple[Array, float]]
"""Of a unit vector (6,): points (n, 6) of a set that go far along it, and how far none goes beyond."""


def hull_figures(inside: Array, farthest: Farthest, nothing: float = NOTHING, most: float = np.inf) -> HullFigures:
    """Return the figures of a convex set, from a hull to which points are added where it is nearest to 0.

    Args:
        inside: (p, 6) points of the set, 0 among them.
        farthest: of the set.
        nothing: how far a set may go along a direction in which it is said not to go at all.
        most: a radius that the ball is known not to exceed.
    """
    points, least, volume, equations = inside, 0.0, 0.0, np.zeros((0, 7))
    for _ in range(ROUNDS):
        if is_flat(points):
            normals = np.linalg.svd(points)[2][-1:] * np.array([[1.0], [-1.0]])
            distances = np.zeros(2)
        else:
            equations, volume = hull(points)
            nearest = np.argsort(-equations[:, -1])[:FACETS]
            normals, distances = equations[nearest, :-1], -equations[nearest, -1]
            least = max(float(distances[0]), 0.0) * (1 - SHORT)
        found = [farthest(normal) for normal in normals]
        best = int(np.argmin([reach for _, reach in found]))
        most = min(most, _turned(normals[best], *found[best], farthest))
        if most <= nothing or most - least <= SURE * most or len(equations) > MOST_FACETS:
            break
        beyond = [more[more @ normal > distance + nothing]
                  for (more, _), normal, distance in zip(found, normals, distances, strict=True)]  # fmt: skip
        points = np.unique(np.vstack([points, *beyond]), axis=0)
    return HullFigures((0.0, 0.0) if most <= nothing else (min(least, most), most), volume)


def _turned(normal: Array, points: Array, reach: float, farthest: Farthest) -> float:
    """Return how far no point goes beyond along some direction near a normal along which it is not far.

    The distance of the supporting plane has the farthest point as its gradient; on the sphere it is followed downhill.
    """
    step = 1.0
    for _ in range(TURNS):
        point = points[np.argmax(points @ normal)]
        aside = point - (point @ normal) * normal
        other = normal - step * aside / max(reach, NOTHING)
        other /= np.linalg.norm(other)
        more, further = farthest(other)
        if further < reach:
            normal, points, reach = other, more, further
        else:
            step /= 2
    return max(reach, 0.0)


def is_flat(points: Array) -> bool:
    """Return whether points (p, 6), 0 among them, lie in less than six dimensions."""
    sizes = singular_values(points)
    return bool(Decision.of(sizes, float(sizes[0])).rank < points.shape[1])


def hull(points: Array) -> tuple[Array, float]:
    """Return the facets (n, 7) of a hull, ``normal x + offset <= 0``, and its volume.

    Points of symmetric grasps lie in planes; where rounding makes that too hard they are moved by a little.
    """
    from scipy.spatial import ConvexHull, QhullError

    try:
        found = ConvexHull(points)
    except QhullError:
        found = ConvexHull(points, qhull_options="QJ Pp")
    return np.asarray(found.equations), float(found.volume)
