"""The least change of one number that leaves a plan: by one program where rows are affine in it, else by bisection."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy import sparse

from synergrip.changes.asked import Asked, Posed
from synergrip.changes.at_a_value import CLOSE, decided_at, narrowed, no_plan, posed_at, solved
from synergrip.changes.few_instants import by_few_instants
from synergrip.changes.some_rows import proven_without
from synergrip.conic.build import Constraints
from synergrip.conic.decide import Decision
from synergrip.conic.limits.dial import Dial
from synergrip.conic.program import Block, Program
from synergrip.conic.rows import Item, Kind
from synergrip.conic.variable_bounds import LARGEST
from synergrip.linalg import Array, frozen
from synergrip.values import Value

STEP = 0.25
"""Share of a number by which it is turned to see what its rows make of it."""
SAME_ROWS = 1e-9
"""Relative difference of rows that are the same but for their unit."""
SAME_CHANGE = 1e-6
"""Relative difference of changes of b, of one step and of two halves of it, that are the same."""
NO_ENTRY = 1e-12
"""Share of the largest entry of A up to which a row sees no unknown."""
STRETCH = (1.05, 1.25, 2.0, 5.0, 20.0, 100.0)
"""Factors that are tried until there is a plan, before the least one is looked for."""


@dataclass(frozen=True, eq=False, repr=False)
class LeastChange(Value):
    """How far a number must go at least, in the linear model of the start posture."""

    dial: Dial[Asked]
    value: float | None
    """The nearest value with a plan; None when none was found, as far as the number goes."""
    proven: bool
    """Whether a certificate verifies that there is no plan short of it, or at all as far as the number goes."""

    @property
    def size(self) -> float:
        """How large the change is."""
        return np.inf if self.value is None else self.dial.size(self.value)


def least_change(
    dial: Dial[Asked], posed: Posed, program: Program, *, rough: float = 0.0, no: Decision | None = None
) -> LeastChange:
    """Return the least change of a number.

    Args:
        dial: the number.
        posed: what was asked, as a program of the start posture.
        program: that program, which has no plan.
        rough: share of the change within which a bisection may end.
        no: what came of that program, where it is known.
    """
    ray = None if no is None or not no.infeasible else no.certificate.y
    if dial.smooth:
        column = turning_column(dial, posed, program)
        if column is not None and ray is not None and proven_without(program, ray, column != 0):
            return LeastChange(dial, None, posed.strict)  # the proof does without the rows that it is about
        if column is not None:
            found = _by_one_program(dial, posed, program, column)
            if found is not None:
                return found
    if dial.nested and not dial.smooth:
        no = solved("any plan", program) if no is None else no
        few = by_few_instants(dial, posed, no, _tries(dial), _close(dial, rough)) if no.infeasible else None
        if few is not None:
            return LeastChange(dial, few.value, few.proven)
    return _by_bisection(dial, posed, rough)


def turning_column(dial: Dial[Asked], posed: Posed, program: Program) -> Array | None:
    """Return (m,) how b changes with the number, per relative turn toward more room; None where A changes too."""
    step = min(STEP, dial.reach)
    change, half = (_change(dial, posed, program, turn) if turn > 0 else None for turn in (step, step / 2))
    if change is None or half is None:
        return None
    apart = np.abs(change - 2 * half)
    return frozen(change / step) if np.all(apart <= SAME_CHANGE * (1 + np.abs(program.b) + np.abs(change))) else None


def _change(dial: Dial[Asked], posed: Posed, program: Program, turn: float) -> Array | None:
    """Return (m,) by how much b changes with a relative turn toward more room; None where A changes too."""
    other = dial.turned(dial.ahead(turn)).posed(posed.analysis, posed.formulation.units)
    if other is None:
        return None
    turned = other.constraints()
    if turned.A.shape != program.A.shape or len(turned.blocks) != len(program.blocks):
        return None
    ratios = row_ratios(program, turned)
    return None if ratios is None else turned.b / ratios - program.b


def row_ratios(one: Program, other: Program | Constraints) -> Array | None:
    """Return (m,) by what the cones of another program are multiples of those of one; None where they are not.

    A cone whose rows see no unknown is in the unit of the same item at other knots.
    """
    if _same(one.A, other.A):
        return np.ones(len(one.b))
    sizes = [
        np.sqrt(np.asarray(sparse.csr_matrix(each.A).multiply(each.A).sum(axis=1)).ravel()) for each in (one, other)
    ]
    ratios, none = np.ones(len(one.b)), NO_ENTRY * max((float(size.max(initial=0.0)) for size in sizes), default=0.0)
    for block, rows in one.slices():
        shape = (block.knots, len(block.items), block.dim)
        first, second = (size[rows].reshape(shape).max(axis=2) for size in sizes)
        with np.errstate(invalid="ignore", divide="ignore"):
            ratio = np.where(first > none, second / first, np.nan)
        for fill in (_of_item(ratio), _of_all(ratio)):
            ratio = np.where(np.isnan(ratio), fill, ratio)
        ratios[rows] = np.repeat(np.where(np.isnan(ratio), 1.0, ratio)[:, :, None], block.dim, axis=2).ravel()
    if np.any(ratios <= 0) or not np.all(np.isfinite(ratios)):
        return None
    apart = sparse.csr_matrix(sparse.diags_array(1 / ratios) @ other.A - one.A)
    worst = float(abs(apart).max()) if apart.nnz else 0.0
    return ratios if worst <= SAME_ROWS * max(float(sizes[0].max(initial=0.0)), 1.0) else None


def _same(one: sparse.csc_matrix, other: sparse.csc_matrix) -> bool:
    """Return whether two matrices of one shape are the same to the last digit."""
    pairs = ((one.indptr, other.indptr), (one.indices, other.indices), (one.data, other.data))
    return all(np.array_equal(mine, theirs) for mine, theirs in pairs)


def _of_item(ratio: Array) -> Array:
    known = ~np.isnan(ratio)
    total = np.where(known, ratio, 0.0).sum(axis=0)
    count = known.sum(axis=0)
    return np.broadcast_to(np.where(count > 0, total / np.maximum(count, 1), np.nan), ratio.shape)


def _of_all(ratio: Array) -> Array:
    known = ratio[~np.isnan(ratio)]
    return np.full(ratio.shape, known.mean() if len(known) else np.nan)


def _by_one_program(dial: Dial[Asked], posed: Posed, program: Program, column: Array) -> LeastChange | None:
    """Return the least turn, by a program with one more unknown; None where nothing verifies."""
    decision = solved("least change", with_turns(program, [column], [dial.reach]))
    if decision.infeasible:
        return LeastChange(dial, None, posed.strict)
    if not decision.optimal:
        return None
    return LeastChange(dial, dial.ahead(max(float(decision.solution.x[-1]), 0.0)), posed.strict)


def with_turns(program: Program, columns: Sequence[Array], far: Sequence[float], *, most: bool = False) -> Program:
    """Return the program of the least sum of turns s_i, from 0 to `far` each, with b + s_i columns_i in b's place.

    With `most`, that of the largest sum.
    """
    n, k = len(program.q), len(columns)
    finite = np.flatnonzero(np.isfinite(far))
    turn = sparse.csr_matrix(sparse.eye_array(k))
    last = sparse.hstack([sparse.csr_matrix((k + len(finite), n)), sparse.vstack([-turn, turn[finite]])])
    first = sparse.hstack([program.A, sparse.csc_matrix(-np.column_stack(columns))])
    ends = np.asarray(far)[finite]
    weight = np.full(k, -1.0 if most else 1.0)
    blocks = (Block("turn", Kind.NONNEGATIVE, 1, (Item("turn"),), 0, k + len(finite)),)
    reach = np.where(np.isfinite(far), np.minimum(far, LARGEST), LARGEST)
    return replace(
        program, P=sparse.csc_matrix((n + k, n + k)), q=frozen(np.append(np.zeros(n), weight)), constant=0.0,
        A=sparse.csc_matrix(sparse.vstack([first, last])), b=frozen(np.concatenate([program.b, np.zeros(k), ends])),
        box=frozen(np.append(np.maximum(program.variable_bounds, LARGEST), reach)),
        blocks=(*program.blocks, *blocks),
    )  # fmt: skip


def _by_bisection(dial: Dial[Asked], posed: Posed, rough: float) -> LeastChange:
    """Return the nearest of some values with a plan, and from there, where sets of plans are nested, the least one."""
    decided: dict[float, Decision | None] = {}

    def has_plan(value: float) -> bool:
        decided[value] = found = decided_at(dial, value, posed)
        return found is not None and found.acceptable

    low, high, tries = dial.value, None, _tries(dial)
    if dial.nested and len(tries) > 1 and not has_plan(tries[-1]):
        last = decided[tries[-1]]
        if last is not None and last.infeasible:  # so has every value before it none
            return LeastChange(dial, None, posed.strict)
    for value in tries:
        if has_plan(value):
            high, low = narrowed(value, low, has_plan, _close(dial, rough))
            break
        low = value
    last = decided.get(low)
    certain = low == dial.value or (last is not None and last.infeasible)
    return LeastChange(dial, high, certain and dial.nested and posed.strict)


def _close(dial: Dial[Asked], rough: float) -> Callable[[float], float]:
    """Return how near each other values are narrowed to, by the one without a plan."""
    return lambda bad: max(CLOSE, rough * dial.size(bad))


def _tries(dial: Dial[Asked]) -> Sequence[float]:
    """Return the values that are tried, up to the end of the number."""
    if dial.eased == "up":
        return [value for value in (dial.value * factor for factor in STRETCH) if value <= dial.end * (1 + SAME_ROWS)]
    return [*(v for v in (dial.value / factor for factor in STRETCH) if v > dial.end), dial.end]


def short_of(dial: Dial[Asked], value: float, posed: Posed, share: float) -> bool:
    """Return whether it is certified that a change smaller by a share of the value leaves no plan."""
    before = dial.easier(value, -share * abs(value))
    return dial.nested and no_plan(posed_at(dial, before, posed, every=True))
