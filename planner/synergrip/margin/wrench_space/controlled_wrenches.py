"""The external wrenches that internal forces of some kind can meet, with normal forces of one newton together or each.

A wrench w is met by ``lambda = -G+ w + E x``: where E spans all internal forces, by any contact forces that balance it.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy import sparse

from synergrip.changes.at_a_value import solved
from synergrip.conic.program import Block, Program
from synergrip.conic.rows import Item, Kind
from synergrip.linalg import Array, frozen
from synergrip.margin.wrench_space.wrench_hull import HullFigures, figures_of_support
from synergrip.statics.response import Response

FAR = 1e3
"""Largest internal force in the unit of the normal forces: these are 1, and friction is not as large."""
ROOM = 1e-7
"""How much less far than the solver says a wrench is taken to be held, and how much farther none."""
NOTHING = 1e-6
"""How far a wrench may go along a direction in which the synergies hold none, for the digits of the solver."""


def controlled_figures(response: Response, internal: Array, *, each: bool = False) -> HullFigures:
    """Return the figures of external wrenches that are met with some internal forces, and unit normal forces.

    Args:
        response: of the grasp.
        internal: (n_l, k) the internal forces, such as E_s; with all of them the wrenches are the grasp wrench space.
        each: whether each normal force is 1 at most (L-infinity), not all of them together (L1).
    """
    program = _unit_program(response, internal, each=each)

    def farthest(along: Array) -> tuple[Array, float]:
        q = np.append(-along, np.zeros(internal.shape[1]))
        decision = solved("farthest wrench", replace(program, q=frozen(q)))
        x = decision.solution.x
        if not decision.optimal or not np.all(np.isfinite(x)):
            return np.zeros((1, 6)), np.inf
        return x[None, :6] * (1 - ROOM), float(along @ x[:6]) + ROOM

    return figures_of_support(farthest, NOTHING)


def _unit_program(response: Response, internal: Array, *, each: bool) -> Program:
    """Return cones of ``-G+ w + internal x``, and that the normal forces together, or each, are 1 at most.

    The unknowns are w in scaled coordinates, and x.
    """
    grasp, rows, blocks = response.grasp, [], []
    for contact, own in zip(grasp.contacts, grasp.rows, strict=True):
        for side, W in zip(contact.kind.sides, contact.cones, strict=True):
            row = np.zeros((len(W), grasp.n_l))
            row[:, own] = W
            kind = Kind.NONNEGATIVE if len(W) == 1 else Kind.SECOND_ORDER
            rows.append(row)
            blocks.append(Block("friction cone", kind, len(W), (Item(contact.name, side),), 0, 1, friction=True))
    normals = -np.eye(grasp.n_l)[np.asarray(grasp.normal_rows)]
    bounds = normals if each else normals.sum(axis=0, keepdims=True)
    items = tuple(Item(contact.name) for contact in grasp.contacts) if each else (Item("all"),)
    whole = np.vstack([*rows, bounds])
    blocks.append(Block("normal forces", Kind.NONNEGATIVE, 1, items, 0, 1))
    A = -whole @ np.hstack([response.dlambda_dw @ response.scale.motion.T, internal])
    n, b = A.shape[1], np.append(np.zeros(len(whole) - len(bounds)), np.ones(len(bounds)))
    return Program(
        sparse.csc_matrix((n, n)), frozen(np.zeros(n)), sparse.csc_matrix(A), frozen(b), tuple(blocks), 1, n,
        frozen(np.full(n, FAR)),
    )  # fmt: skip
