"""When a task has no plan: which of its instants have none by themselves, and whether it is the steps between them."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from synergrip.changes.asked import Asked, Posed
from synergrip.changes.at_a_value import solved
from synergrip.conic.certificate import PRIMAL_TOLERANCE, judge_infeasible
from synergrip.conic.decide import Decision
from synergrip.conic.program import Block, Program
from synergrip.conic.relaxed import heads
from synergrip.conic.rows import Item, Kind
from synergrip.conic.variable_bounds import LARGEST
from synergrip.documents.naming import made_by
from synergrip.linalg import Array, frozen
from synergrip.values import Value

NO_MORE = 1e-9
"""By how much cones must be widened for an instant to be tried as one without a plan, in units of the program."""


@made_by("answer.explain()")
@dataclass(frozen=True, eq=False, repr=False)
class When(Value):
    """Which instants of a task have no plan, in the linear model of the start posture.

    Example:
        >>> refused.when.intervals_s  # of an `Infeasible`  # doctest: +SKIP
        ((0.0, 1.1),)
    """

    first_s: float | None
    """The first of them; of steps that clash only together, the end of the first stretch that has none. None when it is
    not known."""
    intervals_s: tuple[tuple[float, float], ...]
    """From the first to the last knot of each stretch of knots without a plan."""
    alone: bool | None
    """True: these knots have none each by itself; False: every knot has one, and steps between them clash; None when
    neither is known."""

    @property
    def scope(self) -> str | None:
        """Of what it speaks: "start", the linear model of the start posture; None when nothing is known."""
        return None if self.first_s is None else "start"

    @classmethod
    def of(cls, times: Array, late: NDArray[np.bool_]) -> When:
        """Return the knots (T,) that have none each by itself, at times [s]; not known where there are none."""
        if not np.any(late):
            return NOT_KNOWN
        edges = np.flatnonzero(np.diff(np.concatenate([[False], late, [False]]).astype(int)))
        stretches = zip(edges[::2], edges[1::2], strict=True)
        return cls(float(times[late][0]), tuple((float(times[a]), float(times[b - 1])) for a, b in stretches), True)


NOT_KNOWN = When(None, (), None)


def when(posed: Posed) -> When:
    """Return which knots have no plan, each proven by itself.

    Args:
        posed: a task without a plan, held between the knots at `every` instant that is looked at.
    """
    program = posed.program()
    at = knots_of_rows(program)
    alone = (at >= 0) & _of_one_knot(program, at)
    decision = widened(program, at, alone)
    found = When.of(posed.timed.times, _proven_knots(program, at, alone, decision))
    if found.alone or not np.all(at >= 0) or np.all(alone) or not decision.optimal:
        return found
    wider = decision.solution.x[len(program.q) :]
    return When(_first_together(posed), (), alone=False) if np.all(wider <= PRIMAL_TOLERANCE) else NOT_KNOWN


def knots_of_rows(program: Program) -> NDArray[np.intp]:
    """Return the knot that each row (m,) speaks of; -1 between them."""
    found = np.full(len(program.b), -1, dtype=np.intp)
    for block, rows in program.slices():
        if not block.between:
            found[rows] = np.repeat(block.instants, block.dim)
    return found


def _of_one_knot(program: Program, at: NDArray[np.intp]) -> NDArray[np.bool_]:
    """Return the rows (m,) that see the unknowns of their own knot only, whole cones; equations are none of them."""
    A = sparse.coo_matrix(program.A)
    other = np.zeros(len(program.b), dtype=bool)
    inside = program.n_v * program.knots > A.col
    other[A.row[~inside | (A.col // max(program.n_v, 1) != at[A.row])]] = True
    for block, rows in program.slices():
        cones = other[rows].reshape(-1, block.dim)
        other[rows] = np.repeat(cones.any(axis=1), block.dim) | (block.kind is Kind.ZERO)
    return ~other


def _proven_knots(
    program: Program, at: NDArray[np.intp], alone: NDArray[np.bool_], decision: Decision
) -> NDArray[np.bool_]:
    """Return the knots (T,) of which a certificate proves that they have no plan by themselves.

    One program widens the cones of each knot by as little as possible; its multipliers at a knot are the proof there.
    """
    kept, solution = np.flatnonzero(alone), decision.solution
    found = np.zeros(program.knots, dtype=bool)
    if len(solution.x) != len(program.q) + program.knots:
        return found
    for k in np.flatnonzero(solution.x[len(program.q) :] > NO_MORE):
        ray = np.zeros(len(program.b))
        mine = at[kept] == k
        ray[kept[mine]] = solution.z[: len(kept)][mine]
        found[k] = judge_infeasible(program, ray).verified
    return found


def widened(program: Program, at: NDArray[np.intp], keep: NDArray[np.bool_]) -> Decision:
    """Return the answer that keeps some cones but for as little as possible at every knot, all knots counted alike.

    Its last unknowns are how much the cones of each knot are widened, in units of the program.

    Args:
        program: has no answer.
        at: (m,) knot of each row.
        keep: (m,) the rows that count, whole cones.
    """
    T, n, kept = program.knots, len(program.q), np.flatnonzero(keep)
    wider = sparse.csc_matrix((-heads(program)[kept], (np.arange(len(kept)), at[kept])), shape=(len(kept), T))
    nothing = sparse.csc_matrix(sparse.hstack([sparse.csc_matrix((T, n)), -sparse.eye_array(T, format="csc")]))
    A = sparse.csc_matrix(sparse.vstack([sparse.hstack([program.A[kept], wider]), nothing]))
    b, q = np.concatenate([program.b[kept], np.zeros(T)]), np.append(np.zeros(n), np.ones(T))
    return solved("least widening", _cut(program, keep, A, b, q, T))


def _cut(program: Program, keep: NDArray[np.bool_], A: sparse.csc_matrix, b: Array, q: Array, more: int) -> Program:
    """Return a program of some of the cones, with one more unknown for each knot."""
    blocks = []
    for block, rows in program.slices():
        kept = int(np.count_nonzero(keep[rows])) // block.dim
        if kept:
            blocks.append(replace(block, items=(Item(block.limit),), first_knot=0, knots=kept))
    blocks.append(Block("widening", Kind.NONNEGATIVE, 1, (Item("knot"),), 0, more))
    n = len(q)
    bounds = np.append(np.maximum(program.variable_bounds, LARGEST), np.full(more, LARGEST))
    return replace(
        program, P=sparse.csc_matrix((n, n)), q=frozen(q), A=A, b=frozen(b), blocks=tuple(blocks), constant=0.0,
        box=frozen(bounds),
    )  # fmt: skip


def _first_together(posed: Posed) -> float | None:
    """Return the end of the shortest first part of a task that has no plan; None where that is not certain."""
    timed, analysis = posed.timed, posed.analysis
    low, high = 1, len(timed.times)  # the first knots by themselves have a plan, all together have none
    while high - low > 1:
        middle = (low + high) // 2
        part = Asked(analysis.grasp, replace(timed.first(middle), course=None)).posed(analysis, posed.formulation.units)
        decision = None if part is None else solved("any plan", part.program())
        if decision is not None and decision.infeasible:
            high = middle
        elif decision is not None and decision.acceptable:
            low = middle
        else:
            return None
    return float(timed.times[high - 1])
