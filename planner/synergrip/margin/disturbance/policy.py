"""An answer of the internal forces that is affine in the extra wrench: x(w) = x_0 + L w, and the ball that it proves.

With it the value of every cone is affine in w alone, so that the ball which the plan withstands with this answer is
known exactly (`leaving`). That makes each answer a proof; a good one is looked for by semidefinite programs. With
u = w / r in the unit ball, a cone holds the value ``(h'y, T y)`` at y = (1, u), h and T affine in r, x_0 and r L, where

    h h' - T'T - tau diag(1, -I) >= 0  for some tau >= 0.

The first term is convex and is replaced by less, its tangent at what is known: ``h k' + k h' - k k'``. What is left is
linear by a Schur complement, holds at k = h, and so each program finds a ball that is at least as large as the last.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.changes.at_a_value import solved
from synergrip.conic.cones import outside
from synergrip.conic.relaxed import relaxed
from synergrip.conic.rows import Kind
from synergrip.conic.semidefinite import Semidefinite, solve_semidefinite
from synergrip.linalg import Array
from synergrip.margin.disturbance.leaving import balls, proven
from synergrip.margin.disturbance.reaction import Cones, Reaction
from synergrip.values import Value

PROGRAMS = 5
"""For one knot at most."""
GAIN = 2e-3
"""Relative gain of a program below which it is the last one."""
KNOTS = 4
"""For which programs are solved, the worst knot first."""
KEPT = 1e-7
"""How far beyond its edge a cone that no extra wrench touches may be, in its unit: plans keep ten times that."""
EASE = 1e-9
"""Share of the size of a cone that is added to the tangent where a plan has no force at a contact."""


@dataclass(frozen=True, eq=False, repr=False)
class Answers(Value):
    """The answers of K knots, and the ball that each proves."""

    shift: Array
    """(K, n_alpha) x_0."""
    slope: Array
    """(K, n_alpha, 6) L."""
    radius: Array
    """(K,) in force units."""

    def better(self, other: Answers) -> Answers:
        """Return of each knot the answer with the larger ball."""
        more = other.radius > self.radius
        return Answers(
            np.where(more[:, None], other.shift, self.shift),
            np.where(more[:, None, None], other.slope, self.slope), np.maximum(other.radius, self.radius),
        )  # fmt: skip


@dataclass(frozen=True, eq=False, repr=False)
class Answering(Value):
    """The cones of all knots and what the internal forces there add to them."""

    cones: tuple[Cones, ...]
    moved: tuple[Array, ...]
    """(N, d, n_alpha) of each block."""
    knots: int

    @classmethod
    def of(cls, reaction: Reaction) -> Answering:
        """Return it."""
        entries, n = reaction.program.A.tocoo(), reaction.n_alpha
        of_knot = np.zeros((len(reaction.program.b), n))
        of_knot[entries.row, entries.col % n] = -entries.data
        cones = tuple(reaction.cones())
        return cls(cones, tuple(of_knot[each.rows] for each in cones), len(reaction.times))

    def answered(self, shift: Array, slope: Array) -> Answers:
        """Return answers with the ball that each proves, none where a cone is left at once.

        Args:
            shift: (K, n_alpha).
            slope: (K, n_alpha, 6).
        """
        radius, parts = np.full(self.knots, np.inf), []
        for each, moved in zip(self.cones, self.moved, strict=True):
            start = each.start + (moved @ shift[each.knots][..., None])[..., 0]
            part = start, each.change + moved @ slope[each.knots]
            found = balls(*part)
            np.minimum.at(radius, each.knots, np.where(outside(each.block, start) <= KEPT, found.lower, 0.0))
            parts.append((each.knots, *part, found.sigma))
        for knots, start, change, sigma in parts:
            holds = proven(start, change, sigma, radius[knots])
            np.minimum.at(radius, knots, np.where(holds, np.inf, 0.0))
        return Answers(shift, slope, np.where(np.isfinite(radius), radius, 0.0))

    def only(self, knot: int) -> Answering:
        """Return that of one knot, which is then the first."""
        chosen = [each.knots == knot for each in self.cones]
        cones = tuple(each.at(knot).first for each in self.cones)
        return Answering(cones, tuple(m[own] for m, own in zip(self.moved, chosen, strict=True)), 1)


def largest_answered(reaction: Reaction, known: float, least: float, first: int = 0) -> float:
    """Return a radius in force units of a ball of extra wrenches, each of which has an answer of the internal forces.

    Args:
        reaction: of the plan.
        known: a radius that is withstood without an answer.
        least: no larger one is looked for: one that is not withstood whatever the answer.
        first: the knot that leaves least room: its answer is looked for first, and tried at all others.
    """
    knots, n = len(reaction.times), reaction.n_alpha
    equations = any(block.kind is Kind.ZERO for block in reaction.program.blocks if block.rows)
    if reaction.free.size or not n or equations:
        return known
    middle = solved("middle", relaxed(reaction.program)).solution.x[:-1].reshape(knots, n)
    whole, still = Answering.of(reaction), np.zeros((knots, n, 6))
    best = whole.answered(np.zeros((knots, n)), still).better(whole.answered(middle, still))
    improved: set[int] = set()
    while len(improved) < KNOTS:
        worst = int(np.argmin(best.radius)) if improved else first
        if worst in improved or best.radius.min() > least * (1 - GAIN):
            break
        improved.add(worst)
        shift, slope = _improved(whole.only(worst), best, worst, least)
        for shifts in (np.broadcast_to(shift, (knots, n)), best.shift):  # what helps at one knot often helps at others
            best = best.better(whole.answered(shifts, np.broadcast_to(slope, (knots, n, 6))))
    return max(known, float(best.radius.min()))


def _improved(own: Answering, best: Answers, knot: int, least: float) -> tuple[Array, Array]:
    """Return shift and slope of a knot with a ball that is as large as some programs make it."""
    here = Answers(best.shift[[knot]], best.slope[[knot]], best.radius[[knot]])
    for _ in range(PROGRAMS):
        shift, slope = _proposed(own, here, max(least if np.isfinite(least) else 1.0, here.radius[0]))
        other = own.answered(shift[None], slope[None])
        gained = other.radius[0] > here.radius[0] * (1 + GAIN)
        here = here.better(other)
        if not gained:
            break
    return here.shift[0], here.slope[0]


def _proposed(knot: Answering, answer: Answers, unit: float) -> tuple[Array, Array]:
    """Return shift and slope of a larger ball, by one program; what there is where the solver has none.

    Unknowns are r / unit, x_0, r L and a multiplier for each second-order cone.
    """
    (shift,), (slope,), (radius,) = answer.shift, answer.slope, answer.radius
    n = len(shift)
    heads = sum(len(each.start) for each in knot.cones if each.block.kind is Kind.SECOND_ORDER)
    size = 1 + n + 6 * n + heads
    second, matrices, at = [], [], 1 + 7 * n
    for each, moved in zip(knot.cones, knot.moved, strict=True):
        for start, change, own in zip(each.start, each.change, moved, strict=True):
            linear, constant = _homogeneous(start, change * unit, own, size)
            scale = 1 / max(float(np.abs(start).max()), 1e-12)
            linear, constant = scale * linear, scale * constant
            if each.block.kind is not Kind.SECOND_ORDER:  # a_0 - ||a|| >= 0 over the unit ball
                second.append((linear[0], constant[0]))
                continue
            h = scale * np.append(start[0] + own[0] @ shift, radius * (change[0] + own[0] @ slope))
            matrices.append(_tangent(linear, constant, h, at))
            at += 1
    rows = np.zeros((1 + heads, size))
    rows[0, 0], rows[range(1, 1 + heads), range(size - heads, size)] = -1.0, 1.0
    ends = np.zeros(1 + heads)
    ends[0] = 2.0
    q = np.zeros(size)
    q[0] = -1.0
    found = solve_semidefinite(Semidefinite(q, (rows, ends), tuple(second), tuple(matrices)))
    if found is None or not found[0] > 0:
        return shift, slope
    return found[1 : 1 + n], found[1 + n : 1 + 7 * n].reshape(n, 6) / (found[0] * unit)


def _homogeneous(start: Array, change: Array, own: Array, size: int) -> tuple[Array, Array]:
    """Return a cone's value at (1, u) as matrices (d, 7) that are affine in the unknowns: (d, 7, size), and (d, 7)."""
    d, n = own.shape
    linear, constant = np.zeros((d, 7, size)), np.zeros((d, 7))
    constant[:, 0] = start
    linear[:, 1:, 0] = change
    linear[:, 0, 1 : 1 + n] = own
    for k in range(6):
        linear[:, 1 + k, 1 + n + k : 1 + 7 * n : 6] = own
    return linear, constant


def _tangent(linear: Array, constant: Array, k: Array, multiplier: int) -> tuple[Array, Array]:
    """Return ``[[h k' + k h' - k k' - tau J, T'], [T, I]]`` as affine in the unknowns: (m, m, size), and (m, m)."""
    d, _, size = linear.shape
    whole, fixed = np.zeros((6 + d, 6 + d, size)), np.zeros((6 + d, 6 + d))
    whole[:7, :7] = linear[0][:, None, :] * k[None, :, None] + k[:, None, None] * linear[0][None, :, :]
    whole[range(7), range(7), multiplier] = [-1.0] + [1.0] * 6
    fixed[:7, :7] = np.outer(constant[0], k) + np.outer(k, constant[0]) - np.outer(k, k)
    whole[7:, :7], fixed[7:, :7] = linear[1:], constant[1:]
    whole[:7, 7:], fixed[:7, 7:] = linear[1:].transpose(1, 0, 2), constant[1:].T
    fixed[range(7, 6 + d), range(7, 6 + d)] = 1.0
    fixed[range(7), range(7)] += EASE
    return whole, fixed
