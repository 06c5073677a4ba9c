"""From space to paper: a parallel projection along one direction."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from synergrip.linalg import Array, frozen

ELEVATIONS = np.radians([28.0, 50.0])
"""How far from above the viewer may look down on the palm's x-y plane."""
APART, POINTS_AT = np.radians(15.0), 0.2
"""How far from each other axes of the palm are on paper at least, and the length below which one is only a dot."""
UPRIGHT = frozen([0.0, 0.0, 1.0])


@dataclass(frozen=True)
class View:
    """A direction to look from, as three orthonormal vectors in palm axes."""

    right: Array  # (3,)
    up: Array  # (3,)
    toward: Array
    """(3,) from what is drawn toward the viewer."""

    def flat(self, points: Array) -> Array:
        """Return points or vectors (..., 3) on paper: (..., 2), lengths kept where they lie across the view."""
        return np.asarray(points) @ np.column_stack([self.right, self.up])

    def depth(self, points: Array) -> Array:
        """Return how near points (..., 3) are to the viewer: (...)."""
        return np.asarray(points) @ self.toward


def view_from(azimuth: float, elevation: float, up: Array = UPRIGHT) -> View:
    """Return the view from an azimuth about `up` (3,) and an elevation above the plane across it [rad].

    `up` points up on paper; where it is z, the azimuth is counted from x.
    """
    across = np.cross(up, [1.0, 0.0, 0.0]) if abs(up[0]) < 0.9 else np.cross(up, [0.0, 0.0, 1.0])
    second = across / np.linalg.norm(across)
    first = np.cross(second, up)
    right = -np.sin(azimuth) * first + np.cos(azimuth) * second
    toward = np.cos(elevation) * (np.cos(azimuth) * first + np.sin(azimuth) * second) + np.sin(elevation) * up
    return View(frozen(right), frozen(np.cross(toward, right)), frozen(toward))


def best_view(
    points: Array, displacements: Sequence[Array], up: Array = UPRIGHT, clear: Callable[[View], bool] | None = None
) -> View:
    """Return the view from above, of 48 around `up`, in which a picture shows most.

    Args:
        points: (n, 3) what is drawn; it should spread over the paper.
        displacements: (m, 3) each; of every set a good part should be seen and not point at the viewer.
        up: (3,) of length 1.
        clear: tells which views may be taken, where some of them may.
    """
    around = [view_from(np.radians(angle), elevation, up)
              for elevation in ELEVATIONS for angle in range(-65, 295, 15)]  # fmt: skip
    around = [view for view in around if clear is None or clear(view)] or around
    seen = np.array([min([_seen(view, each) for each in displacements], default=1.0) for view in around])
    worth = seen**2 * np.array([_area(view.flat(points)) for view in around])
    return around[int(np.argmax(worth >= worth.max() * (1 - 1e-9)))]


def axes_apart(view: View) -> bool:
    """Tell whether no two axes of the palm lie on each other on paper, as far as they are seen as arrows."""
    flat = view.flat(np.eye(3))
    lengths = np.linalg.norm(flat, axis=1)
    shown = flat[lengths > POINTS_AT] / lengths[lengths > POINTS_AT, None]
    cosines = shown @ shown.T - 2 * np.eye(len(shown))
    return bool(cosines.max(initial=-1.0) < np.cos(APART))


def _area(points: Array) -> float:
    """Return the area over which points (n, 2) spread, up to a factor: that of the ellipse of their variance."""
    return float(np.prod(np.linalg.svd(points - points.mean(axis=0), compute_uv=False)))


def _seen(view: View, displacements: Array) -> float:
    """Return the share of displacements (m, 3) that lies across the view; 1 when there are none."""
    size = float(np.linalg.norm(displacements))
    return float(np.linalg.norm(view.flat(displacements))) / size if size > 0 else 1.0
