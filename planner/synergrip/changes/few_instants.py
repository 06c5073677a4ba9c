"""The least change of a number by a few instants of a task, which are small programs; the whole task confirms it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy import sparse

from synergrip.changes.asked import Asked, Posed
from synergrip.changes.at_a_value import decided_at, narrowed, posed_at, solved
from synergrip.changes.some_rows import Mask, instants_of, leading, of_rows, seen_by
from synergrip.conic.decide import Decision
from synergrip.conic.limits.dial import Dial
from synergrip.conic.program import Program
from synergrip.linalg import Array, Places, frozen
from synergrip.values import Value

SAME = 1e-9
"""Relative difference of entries that are the same."""
ROUNDS = 4
"""How often instants are added, at most."""
NEAR = 1.02
"""Factor that is tried first from where some instants have a plan and all have none."""
SHARES = (1.0, 0.5, 0.25)
"""Of the farthest value, at which programs are looked at: two say how rows change, the third whether it is so."""


@dataclass(frozen=True, eq=False, repr=False)
class Found(Value):
    """The nearest value with a plan, and one just short of it; None where there is none as far as the number goes."""

    value: float | None
    proven: bool
    """Whether a certificate verifies that there is no plan short of it, or at all as far as the number goes."""


def by_few_instants(
    dial: Dial[Asked], posed: Posed, begun: Decision, tries: Sequence[float], close: Callable[[float], float]
) -> Found | None:
    """Return the nearest value with a plan; None where it is not found in this way.

    Args:
        dial: a number in whose values sets of plans are nested, that eases upward to an end.
        posed: what was asked, as a program of the start posture.
        begun: that there is no plan.
        tries: values that are tried first, up to the end.
        close: how near each other values are narrowed to, by the one without a plan.
    """
    rows = _Rows.of(dial, posed)
    if rows is None:
        return None
    farthest = solved("any plan", rows.end)
    if farthest.infeasible:
        return Found(None, posed.strict)
    if not farthest.acceptable:
        return None
    low, instants, decision = dial.value, np.zeros(0, dtype=np.intp), begun
    for more in range(ROUNDS):
        assert decision.certificate.y is not None
        instants = np.union1d(instants, leading(decision.program, decision.certificate.y))
        part = rows.part(instants)
        ahead = [value for value in (*[NEAR * low] * (more > 0), *tries) if value > low]
        high = next((k for k, value in enumerate(ahead) if part.has_plan(value)), None)
        if high is None:
            return None
        low = ahead[high - 1] if high else low
        good, bad = narrowed(ahead[high], low, part.has_plan, close)
        whole = decided_at(dial, good, posed)
        if whole is not None and whole.acceptable:
            return Found(good, posed.strict and _no_plan_at(dial, bad, posed, instants, begun))
        if whole is None or not whole.infeasible:
            return None
        low, decision = good, whole
    return None


def _no_plan_at(dial: Dial[Asked], value: float, posed: Posed, instants: Places, begun: Decision) -> bool:
    """Return whether some instants prove that there is no plan with a value, in the program of that value itself."""
    if value == dial.value:
        return begun.infeasible
    other = posed_at(dial, value, posed)
    if other is None:
        return False
    program = other.program()
    return solved("any plan", of_rows(program, np.isin(instants_of(program), instants))).infeasible


@dataclass(frozen=True, eq=False, repr=False)
class _Rows(Value):
    """Rows that are affine in a number."""

    end: Program
    """With the farthest value."""
    far: float
    slope: sparse.csr_matrix  # (m, n) of A
    rise: Array  # (m,) of b

    @classmethod
    def of(cls, dial: Dial[Asked], posed: Posed) -> _Rows | None:
        """Return the rows of a number; None where they are not affine in it."""
        values = [share * dial.end for share in SHARES]
        if dial.eased != "up" or not np.isfinite(dial.end) or values[-1] <= dial.value:
            return None
        programs = list[Program]()
        for value in values:
            other = posed_at(dial, value, posed, units=posed.formulation.units)
            if other is None:
                return None
            programs.append(other.program())
        end, half, quarter = programs
        if any(each.A.shape != end.A.shape or len(each.blocks) != len(end.blocks) for each in programs):
            return None
        step = values[0] - values[1]
        found = cls(end, values[0], sparse.csr_matrix((end.A - half.A) / step), frozen((end.b - half.b) / step))
        return found if found.tells(quarter, values[2]) else None

    def tells(self, program: Program, value: float) -> bool:
        """Return whether the rows of a program with a value are as they are told."""
        by = value - self.far
        apart = abs(sparse.csr_matrix(self.end.A + by * self.slope - program.A)).max()
        size = max(float(abs(self.end.A).max()), float(np.abs(self.end.b).max(initial=0.0)), 1.0)
        off = float(np.abs(self.end.b + by * self.rise - program.b).max(initial=0.0))
        return bool(max(float(apart), off) <= SAME * size)

    def part(self, instants: Places) -> _Part:
        """Return what is asked at some instants."""
        keep = np.isin(instants_of(self.end), instants)
        return _Part(self, keep, of_rows(self.end, keep), self.slope[keep][:, seen_by(self.end, keep)])


@dataclass(frozen=True, eq=False, repr=False)
class _Part(Value):
    """What is asked at some instants, as it changes with a number."""

    whole: _Rows
    keep: Mask
    end: Program
    slope: sparse.csr_matrix

    def has_plan(self, value: float) -> bool:
        """Return whether there is a plan of these instants; where it is not decided, that there is none."""
        by = value - self.whole.far
        A = sparse.csc_matrix(self.end.A + by * self.slope)
        b = frozen(self.end.b + by * self.whole.rise[self.keep])
        return solved("any plan", replace(self.end, A=A, b=b)).acceptable
