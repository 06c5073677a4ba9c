"""The hull of what contacts can do to the object with normal forces of one newton together: its ball, its volume."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from synergrip.linalg import Array, Decision, Places, singular_values
from synergrip.values import Value

SURE = 0.01
"""Relative difference of the ends of epsilon at which it is known well enough."""
ROUNDS = 12
"""How often points are added at most to find it."""
FACETS = 16
"""Beyond which points are looked for in a round: half of them those nearest to 0, half such as look apart."""
APART = 0.98
"""Cosine of the angle between the normals of two facets below which they look apart."""
NOTHING = 1e-9
"""Distance of a support below which the origin is at the edge."""
RANDOM = 20
"""Directions beside the axes in which points of a set are looked for first."""
TURNS, MORE_TURNS = 6, 40
"""How often the nearest supporting plane is turned, and how often as long as there may be no ball."""
ASIDE = 0.1
"""Size of each component that is added to a normal, where turning may have come to rest too early."""
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


def figures_of_support(farthest: Farthest, nothing: float = NOTHING) -> HullFigures:
    """Return the figures of a convex set that contains 0 and of which nothing else is known.

    Args:
        farthest: of the set.
        nothing: how far it may go along a direction in which it is said not to go at all.
    """
    first = np.vstack([np.eye(6), -np.eye(6), np.random.default_rng(0).normal(size=(RANDOM, 6))])
    found = [farthest(along / np.linalg.norm(along)) for along in first]
    points, most = np.vstack([np.zeros((1, 6)), *(each for each, _ in found)]), min(reach for _, reach in found)
    return hull_figures(points, farthest, nothing, most)


def hull_figures(inside: Array, farthest: Farthest, nothing: float = NOTHING, most: float = np.inf) -> HullFigures:
    """Return the figures of a convex set, from a hull to which points are added where it is nearest to 0.

    Args:
        inside: (p, 6) points of the set, 0 among them.
        farthest: of the set.
        nothing: how far a set may go along a direction in which it is said not to go at all.
        most: a radius that the ball is known not to exceed.
    """
    points, least, volume, equations, rng = inside, 0.0, 0.0, np.zeros((0, 7)), np.random.default_rng(0)
    for _ in range(ROUNDS):
        if is_flat(points):
            normals = np.linalg.svd(points)[2][-1:] * np.array([[1.0], [-1.0]])
            distances = np.zeros(2)
        else:
            equations, volume = hull(points)
            least = max(float(-equations[:, -1].max()), 0.0) * (1 - SHORT)
            chosen = _chosen(equations) if least else np.argsort(-equations[:, -1])[:FACETS]
            normals, distances = equations[chosen, :-1], -equations[chosen, -1]
        found = [farthest(normal) for normal in normals]
        best = int(np.argmin([reach for _, reach in found]))
        turns, beside = TURNS if least else MORE_TURNS, normals[best] + ASIDE * rng.normal(size=6)
        beside /= np.linalg.norm(beside)
        most = min(most, _turned(normals[best], *found[best], farthest, turns))
        most = min(most, _turned(beside, *farthest(beside), farthest, turns))  # a symmetric grasp has planes that rest
        if most <= nothing or most - least <= SURE * most or len(equations) > MOST_FACETS:
            break
        beyond = [more[more @ normal > distance + nothing]
                  for (more, _), normal, distance in zip(found, normals, distances, strict=True)]  # fmt: skip
        points = np.unique(np.vstack([points, *beyond]), axis=0)
    return HullFigures((0.0, 0.0) if most <= nothing else (min(least, most), most), volume)


def _chosen(equations: Array) -> Places:
    """Return the facets (n,) beyond which points are looked for.

    The nearest ones often are neighbours that the same few points cut off: as many others are the nearest of those that
    look away from all that are chosen so far.
    """
    order = np.argsort(-equations[:, -1])
    chosen, left = list(order[: FACETS // 2]), order
    for facet in chosen:
        left = left[equations[left, :-1] @ equations[facet, :-1] < APART]
    while len(left) and len(chosen) < FACETS:
        chosen.append(left[0])
        left = left[equations[left, :-1] @ equations[left[0], :-1] < APART]
    return np.array(chosen)


def _turned(normal: Array, points: Array, reach: float, farthest: Farthest, turns: int) -> float:
    """Return how far no point goes beyond along some direction near a normal along which it is not far.

    The distance of the supporting plane has the farthest point as its gradient; on the sphere it is followed downhill.
    """
    step = 1.0
    for _ in range(turns):
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
