"""The cones of one program side by side: entries of the same place of all cones of one size lie next to each other.

So the algebra of cones runs over thousands of them at once. The scaling is that of Nesterov and Todd, carried on from
iteration to iteration (`conic/cone_algebra.py`); of half-lines it is a ratio.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from synergrip.conic import cone_algebra as cone
from synergrip.conic.program import Block, Program
from synergrip.conic.rows import Kind
from synergrip.linalg import Array


@dataclass(frozen=True)
class Lane:
    """All cones of one size; 1 for half-lines."""

    rows: slice
    """In the order of the lanes: the first entries of all cones, then the second ones."""
    count: int
    size: int

    def of(self, vector: Array) -> Array:
        """Return its part (count, size) of a vector (m,), a view."""
        return vector[self.rows].reshape(self.size, self.count).T


@dataclass(frozen=True)
class Family:
    """Blocks with cones of one size at the same knots: knot after knot, all of their cones."""

    size: int
    knots: int
    items: int
    """Cones of a knot."""
    rows: NDArray[np.intp]
    """(knots, items * size) in the program."""
    lane: int
    first: int
    """Of its cones in the lane."""


@dataclass(frozen=True)
class Cones:
    """The cones of a program in lanes."""

    lanes: tuple[Lane, ...]
    order: NDArray[np.intp]
    """(m,) rows of the program in the order of the lanes."""
    families: tuple[Family, ...]

    @classmethod
    def of(cls, program: Program) -> Cones:
        """Return the lanes of a program without equations."""
        rows: dict[tuple[int, int, int, bool], list[NDArray[np.intp]]] = {}
        for block, where in program.slices():
            if block.rows:
                key = cone_size(block), block.knots, block.first_knot, block.between
                rows.setdefault(key, []).append(np.arange(where.start, where.stop).reshape(block.knots, -1))
        families, lanes, order, start = list[Family](), list[Lane](), [np.zeros(0, dtype=np.intp)], 0
        for i, size in enumerate(sorted({key[0] for key in rows})):
            first, heads = 0, list[NDArray[np.intp]]()
            for key, parts in rows.items():
                if key[0] == size:
                    whole = np.concatenate(parts, axis=1)
                    families.append(Family(size, key[1], whole.shape[1] // size, whole, i, first))
                    heads.append(whole.reshape(-1, size))
                    first += len(heads[-1])
            lanes.append(Lane(slice(start, start + first * size), first, size))
            order.append(np.concatenate(heads).T.ravel())
            start += first * size
        return cls(tuple(lanes), np.concatenate(order), tuple(families))

    @property
    def unit(self) -> Array:
        """(m,) 1 at the head of every cone."""
        found = np.zeros(len(self.order))
        for lane in self.lanes:
            lane.of(found)[:, 0] = 1.0
        return found

    @property
    def count(self) -> int:
        """Of all cones."""
        return sum(lane.count for lane in self.lanes)

    def at(self, family: Family, vector: Array) -> Array:
        """Return the part (size, knots, items) that a family has of a vector (m,), a view."""
        lane = self.lanes[family.lane]
        end = family.first + family.knots * family.items
        return vector[lane.rows].reshape(lane.size, -1)[:, family.first : end].reshape(lane.size, family.knots, -1)

    def least(self, a: Array) -> float:
        """Return how far a (m,) is inside all cones: the least of head less length of the tail."""
        parts = (lane.of(a) for lane in self.lanes)
        inside = (part[:, 0] - np.sqrt(cone.dot(part[:, 1:], part[:, 1:])) for part in parts)
        return min((float(each.min(initial=np.inf)) for each in inside), default=np.inf)


def cone_size(block: Block) -> int:
    """Return the rows of each cone of a block."""
    return block.dim if block.kind is Kind.SECOND_ORDER else 1


@dataclass(frozen=True)
class Scaling:
    """W, and lambda = W z = W^-1 s."""

    cones: Cones
    v: tuple[Array, ...]
    """Of each lane (count, size); of half-lines nothing that counts."""
    beta: tuple[Array, ...]
    """Of each lane (count,); of half-lines W itself."""
    point: Array  # (m,)

    @classmethod
    def of_units(cls, cones: Cones) -> Scaling:
        """Return W = 1 with lambda the unit of every cone."""
        unit = cones.unit
        ones = tuple(np.ones(lane.count) for lane in cones.lanes)
        return cls(cones, tuple(lane.of(unit).copy("A") for lane in cones.lanes), ones, unit)

    def scaled(self, x: Array) -> Array:
        """Return W x."""
        return self._each(lambda i, x: cone.scaled(self.v[i], self.beta[i], x), lambda i, x: self.beta[i] * x, x)

    def unscaled(self, x: Array) -> Array:
        """Return W^-1 x."""
        return self._each(lambda i, x: cone.unscaled(self.v[i], self.beta[i], x), lambda i, x: x / self.beta[i], x)

    def product(self, a: Array, b: Array) -> Array:
        """Return the Jordan products."""
        return self._each(lambda _, a, b: cone.product(a, b), lambda _, a, b: a * b, a, b)

    def divided(self, b: Array) -> Array:
        """Return what the Jordan product with lambda makes b."""
        return self._each(lambda _, b, at: cone.divided(b, at), lambda _, b, at: b / at, b, self.point)

    def _each(self, of_cones: Callable[..., Array], of_lines: Callable[..., Array], *vectors: Array) -> Array:
        result = np.empty(len(self.point))
        for i, lane in enumerate(self.cones.lanes):
            if lane.size == 1:
                result[lane.rows] = of_lines(i, *(vector[lane.rows] for vector in vectors))
            else:
                lane.of(result)[...] = of_cones(i, *(lane.of(vector) for vector in vectors))
        return result

    def longest_step(self, step: Array) -> float:
        """Return how far a step from lambda stays inside all cones."""
        most = 1e-300
        for lane in self.cones.lanes:
            if lane.size == 1:
                inverse = -step[lane.rows] / self.point[lane.rows]
            else:
                inverse = cone.longest_step(lane.of(self.point), lane.of(step))
            most = max(most, float(inverse.max(initial=0.0)))
        return 1 / most

    def carried_on(self, s: Array, z: Array) -> Scaling:
        """Return the scaling of the pair that is s and z (m,) in its coordinates."""
        v, beta, point = list[Array](), list[Array](), np.empty(len(s))
        for i, lane in enumerate(self.cones.lanes):
            ours, theirs = lane.of(s), lane.of(z)
            if lane.size == 1:
                v.append(self.v[i])
                beta.append(self.beta[i] * np.sqrt(ours / theirs)[:, 0])
                lane.of(point)[...] = np.sqrt(ours * theirs)
            else:
                new: tuple[Any, ...] = cone.carried_on(self.v[i], self.beta[i], ours, theirs)
                v.append(new[0])
                beta.append(new[1])
                lane.of(point)[...] = new[2]
        return Scaling(self.cones, tuple(v), tuple(beta), point)
