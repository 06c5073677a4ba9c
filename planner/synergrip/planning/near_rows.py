"""Limits that are far from binding on a path are left out of a pass, and looked at when it has an answer.

What has no answer without them has none with them, and the best without them is the best with them when it keeps them:
so nothing is lost but the time for rows that say nothing.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from synergrip.conic.affine import Affine
from synergrip.conic.formulation import Formulation
from synergrip.conic.goals.goal import Goal
from synergrip.conic.goals.least_peak import LeastPeak
from synergrip.conic.limits.limit import InOtherRows, Limit
from synergrip.conic.rows import Kind, Rows
from synergrip.linalg import Array, frozen
from synergrip.planning.stages import Stage

NEAR = 0.5
"""A row counts where it has less than this share of its limit left, at some knot of the path."""
MANY = 2000
"""Entries of the bounds on joints from which on it takes less time to look at rows than to solve with them."""
ROUNDING = 1e-6
"""By how much a row that was left out may be missed, as those that were not: a share of its limit."""


@dataclass(frozen=True)
class NearRows(InOtherRows):
    """A limit with those of its bounds only that are near on the path."""

    def rows(self, formulation: Formulation) -> Sequence[Rows]:
        """Return the rows of the limit that are near, and those that are no simple bounds."""
        return [kept for part in self.limit.rows(formulation) if (kept := _near(part)) is not None]

    def bounded(self, formulation: Formulation, *, cones_hold: bool) -> tuple[Affine, Array] | None:
        """Return what the whole limit bounds."""
        return self.limit.bounded(formulation, cones_hold=cones_hold)

    def loosened(self, share: float) -> NearRows:
        """Return it with more room."""
        return replace(self, limit=self.limit.loosened(share))

    def misses(self, formulation: Formulation, v: Array) -> bool:
        """Return whether unknowns (T, n_v) miss a bound, be it one of those that were left out."""
        parts = [part for part in self.limit.rows(formulation) if _simple(part)]
        return any(bool(np.any(_values(part, v) < -ROUNDING)) for part in parts)


def near_rows(limits: tuple[Limit, ...], goals: Sequence[Goal], entries: int) -> tuple[Limit, ...]:
    """Return limits with the rows only that are near on the path that they are asked around.

    All of them in a small program, and where a goal has no end without limits: sums of squares have one, and a peak.

    Args:
        limits: of a pass.
        goals: of the task.
        entries: of the bounds on joints in the program, from one side: unknowns times joints.
    """
    endless = any(goal.has_scalar and not isinstance(goal, LeastPeak) for goal in goals)
    return limits if endless or entries < MANY else tuple(NearRows(limit) for limit in limits)


def left_out(limits: Sequence[Limit], stage: Stage) -> bool:
    """Return whether something that was left out of the limits of a stage is missed by its answer."""
    return any(isinstance(limit, NearRows) and limit.misses(stage.formulation, stage.v) for limit in limits)


def _simple(part: Rows) -> bool:
    bound = part.kind is Kind.NONNEGATIVE and part.dim == 1 and not part.friction
    return bound and not part.earlier and part.inside is None and not np.any(part.epigraph)


def _near(part: Rows) -> Rows | None:
    """Return those of simple bounds that are near; None when none is."""
    if not _simple(part):
        return part
    near = np.flatnonzero(part.constant.min(axis=0, initial=np.inf) < NEAR)
    if not len(near):
        return None
    return replace(
        part, items=tuple(part.items[i] for i in near), matrix=frozen(part.matrix[..., near, :]),
        constant=frozen(part.constant[:, near]), epigraph=frozen(part.epigraph[near]),
    )  # fmt: skip


def _values(part: Rows, v: Array) -> Array:
    """Return the values (T, m) of rows."""
    return np.asarray(part.constant + (part.matrix @ v[:, :, None])[:, :, 0])
