"""What every goal is: an objective, and the rows of its scalar when it has one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from synergrip.conic.rows import Rows
from synergrip.conic.situation import Situation
from synergrip.linalg import Array


@dataclass(frozen=True)
class Objective:
    """``sum_k (v_k' quadratic v_k / 2 + linear[k]' v_k) + epigraph s``."""

    quadratic: Array  # (n_v, n_v), the same at every knot
    linear: Array  # (T, n_v)
    epigraph: float | None
    """Cost of the goal's scalar s; None when the goal has none."""


class Goal(Protocol):
    """What is best among the plans that hold."""

    @property
    def name(self) -> str:
        """Name in messages."""

    def rows(self, situation: Situation) -> Sequence[Rows]:
        """Return the rows that tie the scalar to the plan; none for a goal without one."""

    def objective(self, situation: Situation) -> Objective:
        """Return what is minimised."""
