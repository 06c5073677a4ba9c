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
        rows = clear_cut(split(self.A)).row_space
        if rows.shape[1] == 0:
            return q
        return q + rows @ np.linalg.lstsq(self.A @ rows, self.b - self.A @ q, rcond=None)[0]

    def disagreement(self, q: Array) -> Array:
        """Return |A q - b| (m,)."""
        return np.abs(self.A @ q - self.b)


def clear_cut(parts: Split) -> Split:
    """Return `parts`, or refuse relations or pulls of which it depends on the last digits how many are independent."""
    if parts.decision.ambiguous:
        message = "some equalities or tendons nearly repeat each other; remove one of them, or write it exactly"
        raise InputError.at("", message)
    return parts


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
