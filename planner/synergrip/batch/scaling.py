"""The Nesterov-Todd scaling of many problems of one shape, over all their cones; half-lines by themselves."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from synergrip.batch.cone_problems import Group
from synergrip.conic import cone_algebra as cone
from synergrip.linalg import Array

Scale = tuple[Array, Array]
"""v (N, cones, size) and beta (N, cones) of a group; of half-lines the ratio in place of beta."""


@dataclass(frozen=True)
class Scaling:
    """W of N problems, and lambda = W z = W^-1 s."""

    groups: tuple[Group, ...]
    parts: tuple[Scale, ...]
    point: Array  # (N, m)

    @classmethod
    def of_units(cls, groups: Sequence[Group], count: int) -> Scaling:
        """Return W = 1 with lambda the unit of every cone."""
        parts = []
        for group in groups:
            v = np.zeros((count, group.cones, group.size))
            v[..., 0] = 1.0
            parts.append((v, np.ones((count, group.cones))))
        return cls(tuple(groups), tuple(parts), np.broadcast_to(heads(groups), (count, heads(groups).size)))

    def taken(self, which: NDArray[np.bool_]) -> Scaling:
        """Return that of some problems."""
        return Scaling(self.groups, tuple((v[which], beta[which]) for v, beta in self.parts), self.point[which])

    def scaled(self, x: Array) -> Array:
        """Return W x (N, m)."""
        return self._each(x, cone.scaled, lambda beta, part: beta * part)

    def unscaled(self, x: Array) -> Array:
        """Return W^-1 x (N, m)."""
        return self._each(x, cone.unscaled, lambda beta, part: part / beta)

    def _each(
        self, x: Array, of_cones: Callable[[Array, Array, Array], Array], of_lines: Callable[[Array, Array], Array]
    ) -> Array:
        result = np.empty(x.shape)
        for group, (v, beta) in zip(self.groups, self.parts, strict=True):
            if group.size == 1:
                result[:, group.rows] = of_lines(beta, x[:, group.rows])
            else:
                shape = (len(x), group.cones, group.size)
                result[:, group.rows] = of_cones(v, beta, x[:, group.rows].reshape(shape)).reshape(len(x), -1)
        return result

    def unscaled_rows(self, A: Array) -> Array:
        """Return W^-1 A (N, m, n)."""
        N, n = len(self.point), A.shape[2]
        result = np.empty((N, A.shape[1], n))
        for group, (v, beta) in zip(self.groups, self.parts, strict=True):
            rows = A[:, group.rows]
            if group.size == 1:
                result[:, group.rows] = rows / beta[..., None]
            else:
                whole = cone.unscaled_rows(v, beta, rows.reshape(len(A), group.cones, group.size, n))
                result[:, group.rows] = whole.reshape(N, -1, n)
        return result

    def carried_on(self, s: Array, z: Array) -> Scaling:
        """Return the scaling of pairs that are s and z (N, m) in its coordinates."""
        parts, point = [], np.empty(s.shape)
        for group, (v, beta) in zip(self.groups, self.parts, strict=True):
            ours, theirs = s[:, group.rows], z[:, group.rows]
            if group.size == 1:
                parts.append((v, beta * np.sqrt(ours / theirs)))
                point[:, group.rows] = np.sqrt(ours * theirs)
            else:
                shape = (len(s), group.cones, group.size)
                v, beta, new = cone.carried_on(v, beta, ours.reshape(shape), theirs.reshape(shape))
                parts.append((v, beta))
                point[:, group.rows] = new.reshape(len(s), -1)
        return Scaling(self.groups, tuple(parts), point)

    def product(self, a: Array, b: Array) -> Array:
        """Return the Jordan products (N, m)."""
        return self._pairwise(a, b, cone.product, np.multiply)

    def divided(self, b: Array) -> Array:
        """Return c (N, m) whose Jordan product with lambda is b."""
        return self._pairwise(b, self.point, cone.divided, np.divide)

    def _pairwise(self, a: Array, b: Array, of_cones: Callable[..., Array], of_lines: Callable[..., Array]) -> Array:
        result = np.empty(a.shape)
        for group in self.groups:
            ours, theirs = a[:, group.rows], b[:, group.rows]
            if group.size > 1:
                shape = (len(a), group.cones, group.size)
                result[:, group.rows] = of_cones(ours.reshape(shape), theirs.reshape(shape)).reshape(len(a), -1)
            else:
                result[:, group.rows] = of_lines(ours, theirs)
        return result

    def least(self, a: Array) -> Array:
        """Return (N,) how far a (N, m) is inside all cones: the least of head less length of the tail."""
        result = np.full(len(a), np.inf)
        for group in self.groups:
            part = a[:, group.rows].reshape(len(a), group.cones, group.size)
            inside = part[..., 0] - np.sqrt(cone.dot(part[..., 1:], part[..., 1:]))
            result = np.minimum(result, inside.min(axis=-1))
        return result

    def longest_step(self, step: Array) -> Array:
        """Return (N,) how far a step (N, m) from lambda stays inside all cones."""
        most = np.zeros(len(step))
        for group in self.groups:
            at, along = self.point[:, group.rows], step[:, group.rows]
            if group.size == 1:
                inverse = -along / at
            else:
                shape = (len(step), group.cones, group.size)
                inverse = cone.longest_step(at.reshape(shape), along.reshape(shape))
            most = np.maximum(most, inverse.max(axis=-1))
        return np.asarray(1 / np.maximum(most, 1e-300))


def heads(groups: Sequence[Group]) -> Array:
    """Return (m,) the unit of every cone: 1 at its head."""
    result = np.zeros(groups[-1].rows.stop if groups else 0)
    for group in groups:
        result[group.rows.start : group.rows.stop : group.size] = 1.0
    return result
