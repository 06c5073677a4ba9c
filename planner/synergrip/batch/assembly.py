"""Stated tasks as arrays of cone programs, in the units that a plan of each alone would have.

Problem i has the unknowns ``v_i = (alpha / u_i, gamma)`` with u_i what its task asks of the contacts. Rows of forces
are divided by u_i, others by the limit, as `conic` does; the margin's scalar comes last.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from operator import attrgetter
from typing import NamedTuple

import numpy as np

from synergrip.batch.clashing import Row, of_cones, of_limit
from synergrip.batch.cone_problems import ConeProblems
from synergrip.batch.stacked_cones import StackedCones, most, stacked_cones
from synergrip.batch.stated import Stated, lengths
from synergrip.conic.bounds import within
from synergrip.conic.goals.least_effort import Effort
from synergrip.conic.limits.joint_range import JointRange
from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.normal_force import FAR, NormalForce, bound_unit
from synergrip.conic.limits.slip_margin import SlipMargin
from synergrip.conic.rows import Rows
from synergrip.conic.variable_bounds import LARGEST, variable_bounds
from synergrip.linalg import Array, Places, frozen
from synergrip.values import Value

LOWER, UPPER = -1, 0
"""The order of rows that come in pairs, bounds of the same quantities: before those that do not."""


@dataclass(frozen=True, eq=False, repr=False)
class Assembled(Value):
    """N programs as arrays: ``constant - A (v, s)`` lies in the cones, s the margin over the unit."""

    stated: Stated
    cones: tuple[StackedCones, ...]
    unit: Array  # (N,) [N]
    A: Array  # (N, m, n + 1)
    constant: Array  # (N, m)
    sizes: tuple[int, ...]
    of: tuple[Row, ...]
    """What each of the m rows is of."""
    pairs: int
    """Lower bounds, the first rows, whose rows of A are minus those of as many upper ones that come next."""

    @property
    def far(self) -> Array:
        """(n + 1,) bounds that no plan exceeds on |v|, and none on s: part of what the programs mean.

        Optima are judged by these alone. What keeps the limits is within `bounds` of itself; what has less of a margin
        than is asked for need not be, as cones that do not hold bound no force, and is the largest all the same.
        """
        least = min(float(each.unit.min()) for each in self.cones)
        return np.array([LARGEST / least] * (self.A.shape[2] - 1) + [np.inf])

    def bounds(self, places: Places) -> Array:
        """Return (N, n) bounds on |v| of the programs at some places, which the limits imply or no plan exceeds.

        They are those with the cones of all of these: more friction lets contacts carry more.
        """
        stated, first, far = self.stated, self.stated.grasps[0], self.far[:-1]
        stated_most = np.concatenate([contact.kind.most for contact in first.contacts])
        larger = max(1.0, float((most([each.taken(places) for each in self.cones], first) / stated_most).max()))
        limits = [SlipMargin(stated.task.margin), *(_widest(stated, limit, larger) for limit in stated.task.limits)]
        known = variable_bounds(stated.formulation, limits, places)
        return np.where(known >= LARGEST, far, np.minimum(known / columns(stated, self.unit)[places], far))

    def largest_margin(self) -> ConeProblems:
        """Return: maximise s, the last unknown."""
        n = self.A.shape[2]
        return ConeProblems(np.zeros((1, n, n)), -np.eye(n)[-1:], self.A, self.constant, self.sizes, self.pairs)

    def at_margin(self, margin: float, places: Places | slice = slice(None)) -> tuple[Array, Array]:
        """Return A (..., m, n) and b (..., m) of the programs at some places, at a margin [N]."""
        A = self.A[places]
        return A[..., :-1], self.constant[places] - A[..., -1] * (margin / self.unit[places])[:, None]

    def least_effort(self, of: Effort, margin: float) -> tuple[ConeProblems, Array]:
        """Return: the least effort at a margin [N]; and the constant (N,) of its objective."""
        F, f = self._effort(of)
        problems = ConeProblems(F.mT @ F, (f[:, None, :] @ F)[:, 0, :], *self.at_margin(margin), self.sizes, self.pairs)
        return problems, (f**2).sum(axis=-1) / 2

    def least_peak(self, margin: float) -> ConeProblems:
        """Return: the least peak of the normal forces at a margin [N], the last unknown, in units of the load."""
        stated, (A, b) = self.stated, self.at_margin(margin)
        force, normal = stated.formulation.force, stated.grasps[0].normal_rows
        matrix = (force.matrix[..., normal, :] * columns(stated, self.unit)[:, None, :]) / self.unit[:, None, None]
        below = np.concatenate([matrix, np.full((*matrix.shape[:2], 1), -1.0)], axis=2)
        others = np.concatenate([A, np.zeros((*A.shape[:2], 1))], axis=2)
        n, first = self.A.shape[2], slice(2 * self.pairs)
        rest = slice(first.stop, None)
        b = np.concatenate([b[:, first], -force.constant[:, normal] / self.unit[:, None], b[:, rest]], axis=1)
        whole = np.concatenate([others[:, first], below, others[:, rest]], axis=1)
        return ConeProblems(
            np.zeros((1, n, n)), np.eye(n)[-1:], whole, b, (1,) * len(normal) + self.sizes, self.pairs
        )  # fmt: skip

    def _effort(self, of: Effort) -> tuple[Array, Array]:
        """Return F (N, p, n) and f (N, p) of the squares ``||F v + f||^2 / 2``, in units of the load."""
        stated, formulation = self.stated, self.stated.formulation
        value = {"contact": formulation.force, "torque": formulation.torque, "actuator": formulation.effort}[of]
        weights = stated.metric.force if of == "contact" else 1 / lengths(stated.metric)[..., None]
        F = weights[..., None] * value.matrix * (columns(stated, self.unit) / self.unit[:, None])[:, None, :]
        return F, value.constant * weights / self.unit[:, None]


def columns(stated: Stated, unit: Array) -> Array:
    """Return (N, n) what each unknown is a multiple of."""
    result = np.ones((stated.count, stated.formulation.n_v))
    result[:, : stated.n_alpha] = unit[:, None]
    return result


class _Part(NamedTuple):
    """Rows of one kind, in the order in which they are put down: by what comes first here."""

    order: int
    """`LOWER`, `UPPER`, or 1 and more for others: the size of their cones."""
    size: int
    matrix: Array
    times: Array
    """(N or 1, rows) by what rows of the matrix are multiplied."""
    constant: Array
    takes: Array | float
    """What a margin of one unit takes."""
    of: tuple[Row, ...]


def assembled(stated: Stated) -> Assembled:
    """Return stated tasks as arrays."""
    cones, unit = stacked_cones(stated.grasps[0], stated.kinds, stated.friction), stated.unit
    parts = sorted(_parts(stated, cones, unit), key=attrgetter("order"))  # half-lines first
    N, n, alpha = stated.count, stated.formulation.n_v, stated.n_alpha
    sizes = tuple(part.size for part in parts for _ in range(part.matrix.shape[-2] // part.size))
    total = sum(part.matrix.shape[-2] for part in parts)
    pairs = sum(part.matrix.shape[-2] for part in parts if part.order == LOWER)
    A, constant, at = np.empty((N, total, n + 1)), np.empty((N, total)), 0
    for part in parts:
        rows = slice(at, at + part.matrix.shape[-2])
        at = rows.stop
        constant[:, rows] = part.constant
        if part.order == UPPER:
            continue
        np.multiply(part.matrix[..., :alpha], (unit[:, None] * -part.times)[..., None], out=A[:, rows, :alpha])
        np.multiply(part.matrix[..., alpha:], -part.times[..., None], out=A[:, rows, alpha:-1])
        A[:, rows, -1] = part.takes
    np.negative(A[:, :pairs], out=A[:, pairs : 2 * pairs])
    return Assembled(stated, cones, unit, A, constant, sizes, tuple(row for part in parts for row in part.of), pairs)


def _parts(stated: Stated, cones: tuple[StackedCones, ...], unit: Array) -> Iterator[_Part]:
    """Yield the rows of cones and limits."""
    force = stated.formulation.force
    for each in cones:
        (value, times), own = each.after(force), np.repeat(each.unit, each.size, axis=-1)
        first, divisor = np.tile(np.eye(each.size)[0], len(each.contacts)) / own, own * unit[:, None]
        of = of_cones(divisor.shape[-1])
        yield _Part(each.size, each.size, value.matrix, times / divisor, value.constant / divisor, first, of)
    for limit in stated.task.limits:
        every = _rows(stated, limit)
        orders = (LOWER, UPPER) if _opposite(limit, every) else (1,) * len(every)
        for rows, order in zip(every, orders, strict=True):
            divisor = _divisor(limit, rows, unit)
            yield _Part(order, rows.dim, rows.matrix, 1 / divisor, rows.constant / divisor, 0.0, of_limit(rows))


def _opposite(limit: Limit, every: list[Rows]) -> bool:
    """Return whether the rows of a limit are lower and upper bounds of the same, in the same units: `within_bounds`."""
    if len(every) != 2 or isinstance(limit, NormalForce):
        return False
    return [item.name for item in every[0].items] == [item.name for item in every[1].items]


def _rows(stated: Stated, limit: Limit) -> list[Rows]:
    """Return the rows of a limit; joint ranges from the posture of each grasp."""
    formulation = stated.formulation
    if not isinstance(limit, JointRange):
        return list(limit.rows(formulation))
    if limit.lets_go:
        return []
    own = limit.on(stated.grasps[0])
    start = np.broadcast_to(stated.begins(limit), (stated.count, len(own.start)))
    half = (own.upper - own.lower) / 2
    size = np.where(np.isfinite(half) & (half > 0), half, 1.0)
    value = formulation.joint.plus(start)
    return within(limit.key, formulation.response.grasp.joints, value, own.lower, own.upper, size)


def _divisor(limit: Limit, rows: Rows, unit: Array) -> Array:
    """Return (N, 1) by what the rows of a limit are divided beyond what the limit itself does in newtons."""
    if not isinstance(limit, NormalForce):
        return np.ones((len(unit), 1))
    bound = limit.lower if rows.items[0].side == "lowest" else limit.upper
    far = np.isfinite(bound) & (abs(bound) > FAR * unit)
    return np.where(far, abs(bound), unit)[:, None] / bound_unit(bound, 1.0)


def _widest(stated: Stated, limit: Limit, larger: float) -> Limit:
    """Return a limit that keeps less than that of any of the tasks: with more friction, from any of their postures."""
    if isinstance(limit, NormalForce):
        return replace(limit, upper=larger * limit.upper)
    if not isinstance(limit, JointRange) or limit.lets_go:
        return limit
    own, begins = limit.on(stated.grasps[0]), stated.begins(limit)
    room = np.maximum(own.upper - begins, begins - own.lower).max(axis=0)
    return replace(own, lower=frozen(own.start - room), upper=frozen(own.start + room))
