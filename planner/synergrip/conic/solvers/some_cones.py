"""Few unknowns and many cones: solved with some of the cones, to which those that an answer misses are added.

A second goal of a long trajectory often has a handful of unknowns, each of which moves all knots, and the cones of all
knots. Few of these touch its optimum. The best without the others is the best with them when it keeps them, and what
has no answer without them has none with them: a proof needs no more multipliers, those of the others are 0.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from synergrip.conic.cones import outside
from synergrip.conic.program import Block, Program
from synergrip.conic.rows import Item
from synergrip.conic.solution import Claim, Settings, Solution
from synergrip.linalg import Array, frozen

FEW = 40
"""Unknowns, at most."""
MANY = 2000
"""Cones, at least; with fewer all of them together take less time than the rounds."""
BEGINNING = 60
"""Instants, spread evenly, whose cones are those of the first round."""
ROUNDS = 25
"""Rounds, at most; nearly all programs take 3 to 10."""

Solve = Callable[[Program, Settings], Solution]
Chosen = tuple[NDArray[np.bool_], ...]
"""Of each block (cones,) which are in."""


def suits(program: Program) -> bool:
    """Return whether a program has few unknowns and many cones, at many more knots than it begins with."""
    return (
        len(program.q) <= FEW and program.knots > 2 * BEGINNING and sum(block.cones for block in program.blocks) >= MANY
    )


def solve(program: Program, settings: Settings, whole: Solve) -> Solution:
    """Solve a program with some of its cones until the answer keeps all of them to the tolerance.

    Args:
        program: that `suits`.
        settings: of each round.
        whole: who solves the small programs.

    Returns:
        An optimum or a ray of the program; a claim of nothing where the rounds lead to neither.
    """
    rows = sparse.csr_matrix(program.A)
    chosen = tuple(_beginning(block) for block in program.blocks)
    iterations, seconds = 0, 0.0
    for count in range(1, ROUNDS + 1):
        small = _Small.of(program, rows, chosen)
        found = whole(small.program, settings)
        iterations, seconds = iterations + found.iterations, seconds + found.seconds
        if found.claim not in (Claim.OPTIMAL, Claim.INFEASIBLE) or not np.all(np.isfinite(found.x)):
            break
        more = chosen if found.claim is Claim.INFEASIBLE else _with_missed(program, found.x, chosen, settings.tolerance)
        if more is chosen:
            z = np.zeros(len(program.b))
            z[small.rows] = found.z
            status = f"{found.status} with {len(small.rows)} of {len(z)} rows, round {count}"
            return replace(
                found, z=frozen(z), status=status, iterations=iterations, seconds=seconds, closest=0.0
            )  # fmt: skip
        chosen = more
    nothing = frozen(np.full(len(program.b), np.nan))
    status, x = "nothing with some of the rows", frozen(np.full(len(program.q), np.nan))
    return Solution(Claim.NOTHING, x, nothing, "some cones", status, iterations, seconds)


@dataclass(frozen=True)
class _Small:
    """A program with some of the cones of another."""

    program: Program
    rows: NDArray[np.intp]
    """Its rows in the other."""

    @classmethod
    def of(cls, program: Program, A: sparse.csr_matrix, chosen: Chosen) -> _Small:
        parts, blocks = [np.zeros(0, dtype=np.intp)], []
        for (block, where), which in zip(program.slices(), chosen, strict=True):
            first = where.start + block.dim * np.flatnonzero(which)
            parts.append((first[:, None] + np.arange(block.dim)).ravel())
            blocks.append(Block(block.limit, block.kind, block.dim, (Item("some"),), 0, len(first)))
        rows = np.concatenate(parts)
        some = sparse.csc_matrix(A[rows])
        return cls(replace(program, A=some, b=frozen(program.b[rows]), blocks=tuple(blocks)), rows)


def _beginning(block: Block) -> NDArray[np.bool_]:
    """Return the cones at some instants."""
    of_instants = np.zeros((block.knots, len(block.items)), dtype=bool)
    of_instants[np.linspace(0, block.knots - 1, min(BEGINNING, block.knots)).round().astype(np.intp)] = True
    return of_instants.ravel()


def _with_missed(program: Program, x: Array, chosen: Chosen, tolerance: float) -> Chosen:
    """Return the cones that are in and those that an answer misses by most; the same where it misses no other."""
    slack = program.b - program.A @ x
    parts = list(zip(program.slices(), chosen, strict=True))
    missed = [np.where(which, -np.inf, outside(block, slack[rows])) for (block, rows), which in parts]
    if all(part.max(initial=-np.inf) <= tolerance for part in missed):
        return chosen
    peaks = [_peaks(block, part, tolerance) for ((block, _), _), part in zip(parts, missed, strict=True)]
    return tuple(which | peak for which, peak in zip(chosen, peaks, strict=True))


def _peaks(block: Block, missed: Array, tolerance: float) -> NDArray[np.bool_]:
    """Return the cones (cones,) that are missed by no less than those of the same item at the instants beside."""
    by = missed.reshape(block.knots, len(block.items))
    beside = np.pad(by, ((1, 1), (0, 0)), constant_values=-np.inf)
    peak = (by > tolerance) & (by >= beside[:-2]) & (by >= beside[2:])
    return np.asarray(peak.ravel())
