"""Where a ball is that touches given pads."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.documents.quantities import in_mm
from synergrip.errors import InputError
from synergrip.linalg import Array, frozen

REACH = 0.5e-3
"""How far a pad may be from the surface of the object it is said to touch [m]."""
MEETS = 0.02e-3
"""A pad that closing leaves farther from the surface than this does not touch it [m]."""
WRITTEN = 0.05e-3
"""A contact is off by so much where places are written to 0.1 mm; one that is off by more is told [m]."""
FLAT = 1e-6
"""Relative size below which a spread of the pads, or a difference between two sides, counts as none."""
SETTLED = 1e-15  # [m]


@dataclass(frozen=True, eq=False)
class _Spread:
    """Pads of distance ``R + r_i`` from the centre: what these equations say within the space the pads span.

    Differences of the squared equations are linear in the centre and in R, so that ``c(R) = base + R slope``.
    """

    points: Array  # (n, 3)
    pads: Array  # (n,)
    across: Array
    """(rank, 3) orthonormal directions in which the pads spread, the widest first."""
    base: Array  # (3,)
    slope: Array  # (3,)

    @classmethod
    def of(cls, points: Array, pads: Array, most: int) -> _Spread:
        """Solve the differences in at most `most` directions; least squares when there are more pads."""
        middle = points.mean(axis=0)
        _, sizes, directions = np.linalg.svd(points - middle)
        across = directions[: min(int(np.sum(sizes > FLAT * max(float(sizes[0]), 1e-300))), most)]
        arms = ((points - middle) ** 2).sum(axis=1) - pads**2
        right = np.column_stack([arms[1:] - arms[0], -2 * (pads[1:] - pads[0])])
        solved = np.linalg.lstsq(2 * (points[1:] - points[0]) @ across.T, right, rcond=None)[0]
        return cls(points, pads, across, middle + solved[:, 0] @ across, solved[:, 1] @ across)

    def centre(self, radius: float) -> Array:
        """Return the centre within the pads' space."""
        return np.asarray(self.base + radius * self.slope)

    def height(self, radius: float) -> float:
        """Return the distance of the centre from the pads' space; 0 when the ball is too small for one."""
        arms = ((self.centre(radius) - self.points) ** 2).sum(axis=1)
        return float(np.sqrt(max(np.mean((radius + self.pads) ** 2 - arms), 0.0)))

    def sides(self, pushing: Array) -> Array:
        """Return the unit directions (k, 3) away from a plane: both; away from less: the one that `pushing` has."""
        if len(self.across) == 2:
            return np.outer([1.0, -1.0], np.cross(*self.across))
        side = pushing - self.across.T @ (self.across @ pushing)
        size = float(np.linalg.norm(side))
        known = size > FLAT * max(float(np.linalg.norm(pushing)), 1e-300)
        return side[None] / size if known else np.zeros((0, 3))

    def fitting_radius(self) -> float | None:
        """Return the radius at which the height is 0: the only one in space, the smallest one in a plane."""
        away = self.base - self.points
        a = 1 - float(self.slope @ self.slope)
        b = float(np.mean(self.pads - away @ self.slope))
        c = float(np.mean(self.pads**2 - (away**2).sum(axis=1)))
        root = b + np.sqrt(max(b * b - a * c, 0.0))  # a R^2 + 2 b R + c = 0
        return -c / root if a > 0 and c < 0 < root else None


def ball_centre(points: Array, radius: float, pads: Array, pushing: Array) -> Array:
    """Return the centre (3,) of a ball that touches round pads: ``|p_i - c| = R + r_i`` for all i.

    Args:
        points: (n, 3) centres p_i of the pads [m].
        radius: R of the ball [m].
        pads: (n,) radii r_i of the pads, 0 for points [m].
        pushing: (3,) where the pads push to, which chooses between balls on either side of them; 0 when unknown.

    Returns:
        The centre; that of the least squares of the distances when there are more than three pads.

    Raises:
        InputError: no ball of that radius comes within `REACH` of all pads, or several do and `pushing` does not
            choose between them.
    """
    flat, reach = _Spread.of(points, pads, most=2), radius + pads
    middle, sides = flat.centre(radius), flat.sides(pushing)
    starts = [middle + flat.height(radius) * side for side in sides]
    if len(points) > 3:
        starts.append(_Spread.of(points, pads, most=3).centre(radius))
    fitted = [_fitted(points, reach, start) for start in starts]
    touching = [centre for centre in fitted if _miss(points, reach, centre) <= REACH]
    best = max(touching, key=lambda centre: float(centre @ pushing), default=middle)
    rivals = [c for c in touching if np.linalg.norm(c - best) > REACH and (best - c) @ pushing < FLAT * radius]
    if touching and not rivals:
        return frozen(best)
    if _miss(points, reach, middle) <= REACH:  # a ball that the pads hold by its equator
        return frozen(middle)
    if rivals or (not len(sides) and flat.height(radius) > 0):
        message = "the pads do not say on which side of them the ball is; give its position"
        raise InputError.at("object.position", message, on_key=True)
    raise _unfit(points, radius, pads)


def _miss(points: Array, reach: Array, centre: Array) -> float:
    """Return how far the pad that fits least is from the ball."""
    return float(np.abs(np.linalg.norm(points - centre, axis=1) - reach).max())


def _fitted(points: Array, reach: Array, centre: Array) -> Array:
    """Return the centre near `centre` with the least squares of ``|p_i - c| - reach_i``, by Gauss-Newton steps.

    Up to three pads leave nothing to fit. The sharp cut keeps pads on an equator from throwing the centre far.
    """
    for _ in range(50 if len(points) > 3 else 0):
        arms = centre - points
        sizes = np.maximum(np.linalg.norm(arms, axis=1), 1e-300)
        step = np.linalg.lstsq(arms / sizes[:, None], reach - sizes, rcond=FLAT)[0]
        centre = centre + step
        if np.linalg.norm(step) < SETTLED:
            break
    return centre


def _unfit(points: Array, radius: float, pads: Array) -> InputError:
    spread = _Spread.of(points, pads, most=3)
    fitting = spread.fitting_radius()
    which = "the one through them" if len(spread.across) == 3 else "the smallest one"
    named = f": {which} has radius {in_mm(fitting, 4)}" if fitting else ""
    message = (
        f"a ball of radius {in_mm(radius, 4)} cannot touch all pads in this posture{named}; "
        "change the radius or the posture, or let the hand close on it (close)"
    )
    return InputError.at("object.shape.radius", message)
