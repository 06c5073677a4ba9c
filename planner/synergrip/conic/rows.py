"""What a limit or a goal adds to the program: rows whose value must lie in a cone, at every knot."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from synergrip.conic.situation import Affine
from synergrip.linalg import Array, frozen


class Kind(StrEnum):
    """The cones used."""

    ZERO = "zero"
    NONNEGATIVE = "nonnegative"
    SECOND_ORDER = "second-order"


@dataclass(frozen=True)
class Rows:
    """``matrix v_k + previous v_(k-1) + epigraph s + constant[k]`` lies in a cone, for each item and knot."""

    limit: str
    """Key in the problem file of what asks for it."""
    kind: Kind
    dim: int
    """Rows of each cone."""
    items: tuple[str, ...]
    """Names of the cones of one knot: contacts, joints, synergies."""
    matrix: Array  # (len(items) * dim, n_v)
    constant: Array  # (T, len(items) * dim), or (T - 1, ...) for rows that couple a knot to the one before
    epigraph: Array  # (len(items) * dim,) coefficient of the goal's scalar s
    previous: Array | None = None
    """(len(items) * dim, n_v) for rows that couple a knot to the one before."""


def nonnegative(limit: str, items: tuple[str, ...], value: Affine, previous: Array | None = None) -> Rows:
    """Return rows ``value >= 0``."""
    return Rows(limit, Kind.NONNEGATIVE, 1, items, value.matrix, value.constant, frozen(np.zeros(len(items))), previous)


def within(limit: str, items: tuple[str, ...], value: Affine, lower: Array, upper: Array, unit: Array) -> list[Rows]:
    """Return rows ``lower <= value <= upper``, divided by `unit`; infinite bounds add nothing.

    Args:
        limit: key in the problem file.
        items: (m) names.
        value: m affine quantities.
        lower: (m,) or (T, m).
        upper: (m,) or (T, m).
        unit: (m,) size of each quantity.
    """
    result = []
    for side, bound, sign in ((" (lowest)", lower, 1.0), (" (highest)", upper, -1.0)):
        keep = np.all(np.isfinite(np.atleast_2d(bound)), axis=0)
        if not np.any(keep):
            continue
        slack = sign * (value.constant - bound) / unit
        rows = Affine(frozen((sign * value.matrix / unit[:, None])[keep]), frozen(slack[:, keep]))
        names = tuple(name + side for name, kept in zip(items, keep, strict=True) if kept)
        result.append(nonnegative(limit, names, rows))
    return result
