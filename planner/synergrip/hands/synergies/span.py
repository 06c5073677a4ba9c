"""What the columns of a synergy matrix span: their lengths, their rank, their range."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.linalg import Array, Decision, frozen

UNIT = 1e-6
"""S counts as orthonormal when S' S is this near to the identity, entry by entry."""


@dataclass(frozen=True, eq=False)
class Span:
    """The columns of S (n_q, n_z) as they stand: rad, or m of a sliding joint, for a synergy at 1."""

    norms: Array
    """(n_z,) Length of each column."""
    singular_values: Array
    """(n_z,) of S, descending."""
    basis: Array
    """(n_q, rank) Orthonormal basis of the range."""
    decision: Decision
    orthonormal: bool

    @property
    def rank(self) -> int:
        """Dimension of the range, by the policy of `linalg`."""
        return self.decision.rank

    @property
    def repeated(self) -> int:
        """How many synergies repeat what the others do; redundancy, for J S x = 0 where S x = 0 (31)."""
        return len(self.norms) - self.rank


def span(S: Array) -> Span:
    """Return what the columns of S (n_q, n_z) span; columns may be zero, or depend on others."""
    count = S.shape[1]
    vectors, found, _ = np.linalg.svd(S, full_matrices=False)
    values = np.concatenate([found, np.zeros(count - len(found))])
    decision = Decision.of(values, float(values[0]))
    return Span(
        norms=frozen(np.linalg.norm(S, axis=0)),
        singular_values=frozen(values),
        basis=frozen(vectors[:, : decision.rank]),
        decision=decision,
        orthonormal=bool(np.abs(S.T @ S - np.eye(count)).max() <= UNIT),
    )
