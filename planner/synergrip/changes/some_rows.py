"""Some of the rows of a program: less is asked for, so that a proof by them is one of the whole."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from synergrip.conic.cones import row_sizes
from synergrip.conic.program import Block, Program
from synergrip.conic.relaxed import proof
from synergrip.conic.rows import Item
from synergrip.conic.variable_bounds import LARGEST
from synergrip.linalg import Array, Places, frozen

MOST = 3
"""Instants that are taken at once: those that a proof rests on most."""

NEXT_TO_NOTHING = 1e-5
"""Share of the largest multiplier of a proof up to which it may do without a row."""

Mask = NDArray[np.bool_]


def of_rows(program: Program, keep: Mask) -> Program:
    """Return what some cones (m,) ask of the unknowns that they see, without a goal."""
    seen, blocks = seen_by(program, keep), list[Block]()
    for block, rows in program.slices():
        kept = int(np.count_nonzero(keep[rows])) // block.dim
        if kept:
            blocks.append(replace(block, items=(Item(block.limit),), first_knot=0, knots=kept))
    n = len(seen)
    return replace(
        program, P=sparse.csc_matrix((n, n)), q=frozen(np.zeros(n)), A=sparse.csc_matrix(program.A[:, seen][keep]),
        b=frozen(program.b[keep]), blocks=tuple(blocks), box=frozen(program.variable_bounds[seen]),
        basis=None, constant=0.0,
    )  # fmt: skip


def seen_by(program: Program, rows: Mask) -> Places:
    """Return the unknowns that some rows (m,) see."""
    return np.unique(sparse.csr_matrix(program.A)[rows].indices).astype(np.intp)


def whole_cones(program: Program, rows: Mask) -> Mask:
    """Return all rows (m,) of the cones that have some of these."""
    found = np.zeros(len(program.b), dtype=bool)
    for block, there in program.slices():
        found[there] = np.repeat(rows[there].reshape(-1, block.dim).any(axis=1), block.dim)
    return found


def instants_of(program: Program) -> Places:
    """Return (m,) the knot that each row speaks of; of instants between the knots, which of them, from below -1 on."""
    found = np.zeros(len(program.b), dtype=np.intp)
    for block, rows in program.slices():
        instants = np.repeat(block.instants, block.dim)
        found[rows] = -1 - instants if block.between else instants
    return found


def leading(program: Program, ray: Array) -> Places:
    """Return the few instants (`instants_of`) that a proof (m,) rests on most, and the knots that these are between."""
    weight, at = np.abs(ray) * row_sizes(program), instants_of(program)
    every, place = np.unique(at, return_inverse=True)
    chosen = every[np.argsort(-np.bincount(place, weights=weight), kind="stable")[:MOST]]
    if program.basis is not None or not np.any(chosen < 0):
        return chosen
    columns = np.unique(sparse.csr_matrix(program.A)[np.isin(at, chosen)].indices)
    knots = columns[columns < program.n_v * program.knots] // max(program.n_v, 1)
    return np.unique(np.concatenate([chosen, knots]))


def proven_without(program: Program, ray: Array, rows: Mask) -> bool:
    """Return whether a ray (m,) proves that there is no answer without some rows, whatever these ask for.

    Bounds on unknowns that these rows may imply are none then.
    """
    keep, weight = ~whole_cones(program, rows), np.abs(ray) * row_sizes(program)
    if weight[~keep].max(initial=0.0) > NEXT_TO_NOTHING * weight.max(initial=0.0):
        return False
    wide = replace(program, box=frozen(np.maximum(program.variable_bounds, LARGEST)))
    return proof(of_rows(wide, keep), (ray[keep],)).verified
