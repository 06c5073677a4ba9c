"""The external wrenches that internal forces of some kind can meet, with normal forces of one newton together.

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
from synergrip.margin.wrench_space.wrench_hull import HullFigures, hull_figures
from synergrip.statics.response import Response

FAR = 1e3
"""Largest internal force in the unit of the normal forces: these are 1, and friction is not as large."""
RANDOM = 20
"""Directions beside the axes in which the farthest wrenches that synergies hold are looked for first."""
ROOM = 1e-7
"""How much less far than the solver says a wrench is taken to be held, and how much farther none."""
NOTHING = 1e-6
"""How far a wrench may go along a direction in which the synergies hold none, for the digits of the solver."""


def controlled_figures(response: Response, internal: Array) -> HullFigures:
    """Return the figures of external wrenches that are met with some internal forces, unit normal forces together.

    Args:
        response: of the grasp.
        internal: (n_l, k) the internal forces, such as E_s; with all of them the wrenches are the grasp wrench space.
    """
    program = _unit_program(response, internal)

    def farthest(along: Array) -> tuple[Array, float]:
        q = np.append(-along, np.zeros(internal.shape[1]))
        decision = solved("farthest wrench", replace(program, q=frozen(q)))
        x = decision.solution.x
        if not decision.optimal or not np.all(np.isfinite(x)):
            return np.zeros((1, 6)), np.inf
        return x[None, :6] * (1 - ROOM), float(along @ x[:6]) + ROOM

    rng = np.random.default_rng(0)
    first = np.vstack([np.eye(6), -np.eye(6), rng.normal(size=(RANDOM, 6))])
    found = [farthest(along / np.linalg.norm(along)) for along in first]
    points, most = np.vstack([np.zeros((1, 6)), *(each for each, _ in found)]), min(reach for _, reach in found)
    return hull_figures(points, farthest, NOTHING, most)


def _unit_program(response: Response, internal: Array) -> Program:
    """Return cones of ``-G+ w + internal x``, and that the normal forces together are 1 at most.

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
    total = np.zeros((1, grasp.n_l))
    total[0, grasp.normal_rows] = -1.0
    whole = np.vstack([*rows, total])
    blocks.append(Block("normal forces", Kind.NONNEGATIVE, 1, (Item("all"),), 0, 1))
    A = -whole @ np.hstack([response.dlambda_dw @ response.scale.motion.T, internal])
    n, b = A.shape[1], np.eye(len(whole))[-1]
    return Program(
        sparse.csc_matrix((n, n)), frozen(np.zeros(n)), sparse.csc_matrix(A), frozen(b), tuple(blocks), 1, n,
        frozen(np.full(n, FAR)),
    )  # fmt: skip
