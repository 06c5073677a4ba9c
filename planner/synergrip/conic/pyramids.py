"""Friction cones replaced by inscribed pyramids, so that a quadratic program can hold them. For comparison only."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from synergrip.conic.formulation import Affine, Formulation
from synergrip.conic.goals.goal import Goal
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.limits.friction_cone import FrictionCone
from synergrip.conic.limits.limit import InOtherRows, Limit
from synergrip.conic.rows import Item, Kind, Rows
from synergrip.linalg import Array, frozen

FEWEST = 3
"""Facets of a pyramid."""


def pyramid(facets: int, dim: int) -> Array:
    """Return H (rows, dim): the polyhedral cone ``H x >= 0`` is inscribed in ``||x_1..|| <= x_0``.

    dim 3 (hard finger): with unit vectors d_j, j = 0 .. F - 1, at the angles (j + 1/2) 2 pi / F, the facets are
    ``x_0 >= d_j . (t, o) / cos(pi / F)``. Some d_j is within pi / F of (t, o), so the largest right side is at least
    ``||(t, o)||``: inscribed. The edges, at the angles j 2 pi / F, lie on the cone; in the middle of a facet only
    ``cos(pi / F)`` of the tangential force is left.

    dim 2: the cone ``|x_1| <= x_0`` is a pyramid itself, whatever `facets` says.

    dim 4 (soft finger): the right side above, r, is at least ``||(t, o)||``. The half plane of (r, m), r >= 0, gets
    the right half of a second polygon with M sides, M the least multiple of 4 from F on:
    ``x_0 >= (r cos(phi_k) + m sin(phi_k)) / cos(pi / M)`` for phi_k = (k + 1/2) 2 pi / M with cos(phi_k) > 0. Some
    phi_k is within pi / M of the angle of (r, m), so the largest right side is at least ``||(r, m)||``, and that at
    least ``||(t, o, m)||``: inscribed. As cos(phi_k) > 0, r may be replaced by each of the F terms it is the largest
    of: F M / 2 facets. Pure spin keeps all of its cone, pure tangential force as much as a hard finger's, the worst
    mixture ``1 / sqrt(1 / cos(pi / F)^2 + tan(pi / M)^2)``: for 4, 8 and 16 facets 0.577, 0.863 and 0.963, against
    0.707, 0.924 and 0.981 of a hard finger.

    Args:
        facets: F, 3 or more.
        dim: 2, 3 or 4.

    Raises:
        ValueError: fewer facets, another dimension.
    """
    if facets < FEWEST or dim not in (2, 3, 4):
        raise ValueError(f"no pyramid of {facets} facets is inscribed in a cone of dimension {dim}")
    if dim == 2:
        return frozen([[1.0, -1.0], [1.0, 1.0]])
    tangential = _normals(facets)
    if dim == 3:
        return frozen(np.column_stack([np.ones(facets), -tangential]))
    normals = _normals(4 * -(-facets // 4))
    right = normals[normals[:, 0] > 0]
    combined = [np.column_stack([r * tangential, np.full(facets, m)]) for r, m in right]
    return frozen(np.hstack([np.ones((facets * len(right), 1)), -np.vstack(combined)]))


def _normals(sides: int) -> Array:
    """Return (sides, 2): the polygon ``normals x <= 1`` is inscribed in the unit circle."""
    angles = (np.arange(sides) + 0.5) * 2 * np.pi / sides
    return np.asarray(np.column_stack([np.cos(angles), np.sin(angles)]) / np.cos(np.pi / sides))


def inscribed(rows: Rows, facets: int) -> Rows:
    """Return the rows with inscribed pyramids in the place of friction cones.

    Rows of any other kind come back as they are.

    Args:
        rows: of a limit or a goal.
        facets: of the pyramid of a hard finger (see `pyramid`).
    """
    if not rows.friction or rows.kind is not Kind.SECOND_ORDER or rows.dim not in (2, 3, 4):
        return rows
    H = pyramid(facets, rows.dim)
    whole = np.kron(np.eye(len(rows.items)), H)
    items = tuple(Item(item.name, f"{item.side} facet {i + 1}".strip()) for item in rows.items for i in range(len(H)))
    earlier = tuple(replace(part, matrix=frozen(whole @ part.matrix)) for part in rows.earlier)
    return Rows(
        rows.limit, Kind.NONNEGATIVE, 1, items, frozen(whole @ rows.matrix), frozen(rows.constant @ whole.T),
        frozen(whole @ rows.epigraph), earlier, friction=True,
    )  # fmt: skip


def _all_inscribed(rows: Sequence[Rows], facets: int) -> list[Rows]:
    return [inscribed(part, facets) for part in rows]


@dataclass(frozen=True)
class FrictionPyramid(FrictionCone):
    """Every contact force inside a pyramid inscribed in its friction cone; its usage is that of the cone."""

    facets: int = 8

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return the facets."""
        return _all_inscribed(super().rows(formulation), self.facets)


@dataclass(frozen=True)
class LargestMarginInPyramids(LargestMargin):
    """The largest slip margin that the pyramids see: never more than the true one."""

    facets: int = 8

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return the facets with s in the margin's place."""
        return _all_inscribed(super().rows(formulation), self.facets)

    def keeps(self, best: float, slack: float) -> FrictionPyramid:
        """Return the limit that keeps a margin of `best` less `slack` [N]."""
        return FrictionPyramid(best - slack, facets=self.facets)


@dataclass(frozen=True)
class _OtherInPyramids(InOtherRows):
    """Any other limit, with pyramids in the place of the contacts' cones that it has."""

    facets: int

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        return _all_inscribed(self.limit.rows(formulation), self.facets)

    def bounded(self, formulation: Formulation, *, cones_hold: bool) -> tuple[Affine, Array] | None:
        return self.limit.bounded(formulation, cones_hold=cones_hold)

    def loosened(self, share: float) -> _OtherInPyramids:
        return replace(self, limit=self.limit.loosened(share))


def limit_in_pyramids(limit: Limit, facets: int) -> Limit:
    """Return the limit with pyramids in the place of friction cones; the same limit when it has none."""
    if isinstance(limit, FrictionCone):
        return FrictionPyramid(limit.margin, limit.key, facets)
    return _OtherInPyramids(limit, facets)


def goal_in_pyramids(goal: Goal, facets: int) -> Goal:
    """Return the goal with pyramids in the place of friction cones; the same goal when it has none."""
    return LargestMarginInPyramids(facets) if isinstance(goal, LargestMargin) else goal
