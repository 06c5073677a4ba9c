"""Principal directions of recorded postures: the synergies that explain most of their variance."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.errors import InputError
from synergrip.linalg import SINGULAR, Array, Decision, canonical, frozen

ALIKE = 1e-9
"""Singular values that differ by less, relative to the largest, have no directions of their own."""


@dataclass(frozen=True, eq=False)
class Principal:
    """The first K principal directions of N postures of n joints."""

    mean: Array
    """(n,) the mean posture [rad or m]."""
    directions: Array
    """(n, K) orthonormal columns, the largest entry of each positive."""
    singular_values: Array
    """(min(N, n),) of the postures minus their mean, descending [rad or m]."""
    shares: Array
    """(min(N, n),) share of the variance that each direction explains; their sum is 1."""
    deviations: Array
    """(K,) standard deviation of the postures along each direction [rad or m], of N - 1 degrees of freedom."""
    decision: Decision
    """How many directions the postures have at all."""
    alike: tuple[tuple[int, ...], ...]
    """Directions (from 0, the first of each among the K) of equal variance: any others in their span would do."""
    residuals: Array
    """(N, n) postures minus what the K directions make of them [rad or m]."""

    @property
    def rms(self) -> float:
        """Root mean square of the residuals over postures and joints [rad or m]."""
        return float(np.sqrt(np.mean(self.residuals**2)))


def principal_directions(postures: Array, count: int, key: str = "count") -> Principal:
    """Return the principal component analysis of postures.

    The directions are right singular vectors of the postures minus their mean. Directions of equal variance are
    the canonical basis of their span, so that the order of the postures changes nothing.

    Args:
        postures: (N, n) joint values of one unit.
        count: K, how many directions are wanted.
        key: where K stands, for the error.

    Raises:
        InputError: K is below 1 or above the rank of the postures minus their mean.
    """
    mean = postures.mean(axis=0)
    centred = postures - mean
    _, values, transposed = np.linalg.svd(centred, full_matrices=False)
    values = np.where(values > SINGULAR * np.linalg.norm(postures), values, 0.0)  # else rounding of the mean
    decision = Decision.of(values, float(values[0]))
    _judge_count(count, decision, len(mean), key)
    groups = _groups(values, decision.rank)
    directions = np.column_stack([canonical(transposed[group].T) for group in groups])[:, :count]
    relative = values / values[0]
    return Principal(
        mean=frozen(mean),
        directions=frozen(directions),
        singular_values=frozen(values),
        shares=frozen(relative**2 / np.sum(relative**2)),
        deviations=frozen(values[:count] / np.sqrt(len(postures) - 1)),
        decision=decision,
        alike=tuple(tuple(group) for group in groups if len(group) > 1 and group[0] < count),
        residuals=frozen(centred - centred @ directions @ directions.T),
    )


def _judge_count(count: int, decision: Decision, joints: int, key: str) -> None:
    rank = decision.rank
    if rank == 0:
        raise InputError.at(key, "the postures are all the same (rank 0); there is no direction to find")
    if not 1 <= count <= rank:
        message = f"expected 1 to {rank}, the rank of the postures of {joints} joints about their mean, got {count}"
        raise InputError.at(key, message)


def _groups(values: Array, rank: int) -> list[list[int]]:
    """Return the indices of the first `rank` singular values (descending), equal ones together."""
    groups: list[list[int]] = []
    for i in range(rank):
        if i and values[i - 1] - values[i] <= ALIKE * values[0]:
            groups[-1].append(i)
        else:
            groups.append([i])
    return groups
