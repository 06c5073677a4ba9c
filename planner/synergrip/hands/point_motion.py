"""How points of links move: the one thing asked of a kinematics library."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from synergrip.linalg import Array
from synergrip.values import ByContent


@dataclass(frozen=True, eq=False)
class PointMotion(ByContent):
    """Where a point of a link is, and how it moves with the joints, in the palm frame."""

    position: Array
    """(3,) position of the point [m]."""
    rotation: Array
    """(3, 3) orientation of its link: link coordinates to palm coordinates."""
    jacobian: Array
    """(6, n_q) rows v (point velocity), omega, for unit joint rates [m or 1, rad or rad/m]."""


@dataclass(frozen=True, eq=False)
class PointMotions(ByContent):
    """Where m points of links are at T postures, and how they move with the joints, in the palm frame."""

    position: Array
    """(T, m, 3) position of each point [m]."""
    rotation: Array
    """(T, m, 3, 3) orientation of its link: link coordinates to palm coordinates."""
    jacobian: Array
    """(T, m, 2, 3, n_q) point velocity, then omega of the link, for unit joint rates [m or 1, rad or rad/m]."""


class Kinematics(Protocol):
    """The one thing asked of a kinematics library."""

    def at(self, q: Array, points: Sequence[tuple[str, Array]]) -> tuple[PointMotion, ...]:
        """Return the motion of each (link name, point in link coordinates [m]) at joint values `q` (n_q,)."""

    def along(self, q: Array, points: Sequence[tuple[str, Array]]) -> PointMotions:
        """Return the motion of the same points at joint values `q` (T, n_q), all postures at once."""
