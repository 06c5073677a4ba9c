"""Linear relations A q = b between joints, as couplings: which joint follows which."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from synergrip.errors import InputError
from synergrip.hands.hand import Coupling
from synergrip.linalg import RANK_TOLERANCE, Array, Split, split

AGREEMENT = 1e-6
"""How far relations that repeat each other may disagree, with the coefficients of each of norm 1 [rad or m]."""
ZERO = 1e-12
"""A ratio or an offset below this is rounding."""


@dataclass(frozen=True, eq=False)
class Relations:
    """A q = b."""

    A: Array
    """(m, n_q)"""
    b: Array
    """(m,) [rad or m]."""

    def scaled(self) -> Relations:
        """Return the same relations with rows of norm 1."""
        norms = np.linalg.norm(self.A, axis=1)
        norms[norms == 0] = 1.0
        return Relations(self.A / norms[:, None], self.b / norms)

    def nearest(self, q: Array) -> Array:
        """Return the joint values (n_q,) nearest to `q` that obey the relations as well as any do.

        Raises:
            InputError: it depends on the last digits of A how many of the relations are independent.
        """
        rows = _clear(split(self.A)).row_space
        if rows.shape[1] == 0:
            return q
        return q + rows @ np.linalg.lstsq(self.A @ rows, self.b - self.A @ q, rcond=None)[0]

    def disagreement(self, q: Array) -> Array:
        """Return |A q - b| (m,)."""
        return np.abs(self.A @ q - self.b)


def with_pulls(relations: Relations, pulls: Array, q_0: Array) -> Relations:
    """Return the relations that also hold when joints that share an actuator yield alike.

    An actuator that pulls at several joints sets one number, not the share of each. With equal compliances c the
    joints give way by dq = c P m f, where m are the coefficients of the tendon, f is its pull, and P projects on the
    motions that A dq = 0 allows: without relations, in proportion to the coefficients.

    Args:
        relations: those that hold in any case, with rows of norm 1.
        pulls: (n_a, n_q) one row m for each actuator.
        q_0: (n_q,) where no actuator pulls.

    Raises:
        InputError: it depends on the last digits how many of the pulls are independent.
    """
    shared = _shared(relations.A, pulls)
    if not shared:
        return relations
    acting = pulls[np.any(pulls[:, shared] != 0, axis=1)]
    alone = np.delete(np.eye(len(q_0)), shared, axis=0)
    free = split(relations.A).null_space
    directions = np.vstack([acting / np.linalg.norm(acting, axis=1, keepdims=True), alone])
    A = _clear(split(directions @ free @ free.T, reference=1.0)).null_space.T
    return Relations(A, A @ relations.nearest(q_0))


def _clear(parts: Split) -> Split:
    if parts.decision.ambiguous:
        message = "some equalities or tendons nearly repeat each other; remove one of them, or write it exactly"
        raise InputError.at("", message)
    return parts


def _shared(A: Array, pulls: Array) -> list[int]:
    """Return the columns of joints that share an actuator, and of those tied to them."""
    several = pulls[np.count_nonzero(pulls, axis=1) > 1]
    ties = [set(np.flatnonzero(row).tolist()) for row in (*several, *A)]
    shared = set[int]().union(*ties[: len(several)])
    for _ in ties:
        shared = shared.union(*(tie for tie in ties if tie & shared))
    return sorted(shared)


def couplings(
    names: Sequence[str], relations: Relations, order: Sequence[int], *, rigid: bool = False
) -> dict[str, Coupling]:
    """Return followers and what they follow: A q = b solved for as many joints as it determines.

    Args:
        names: the joints in the order of q.
        relations: rows of norm 1 that do not contradict each other.
        order: numbers of the joints, those first that are to be followers.
        rigid: whether nothing but equalities made the relations.
    """
    left = np.column_stack([relations.A, relations.b])
    solved: dict[int, Array] = {}
    for joint in order:
        if len(left) == 0:
            break
        pick = int(np.argmax(np.abs(left[:, joint])))
        if abs(left[pick, joint]) <= RANK_TOLERANCE:
            continue
        row = left[pick] / left[pick, joint]
        left = np.delete(left - np.outer(left[:, joint], row), pick, axis=0)
        solved = {number: other - other[joint] * row for number, other in solved.items()}
        solved[joint] = row
    found = {}
    for joint in sorted(solved):
        row = solved[joint]
        kept = [i for i in range(len(names)) if i != joint and abs(row[i]) > ZERO]
        offset = _tidy(row[-1]) if abs(row[-1]) > ZERO else 0.0
        found[names[joint]] = Coupling({names[i]: _tidy(-row[i]) for i in kept}, offset, rigid)
    return found


def _tidy(value: float) -> float:
    """Return the number without the last two digits, which are rounding."""
    return float(f"{value:.14g}")
