"""A sharper proof that a program has no answer: by how much its cones must be widened at least.

A solver stops at a ray as soon as it is one to its tolerance. Where nothing bounds the unknowns, what such a ray
leaves over may still outweigh what it proves. The multipliers of the relaxed program are a ray as well, and optimised.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import chain

import numpy as np
from scipy import sparse

from synergrip.conic.certificate import Certificate, judge_infeasible
from synergrip.conic.cones import project_on_dual, row_sizes
from synergrip.conic.decide import Solver
from synergrip.conic.program import Block, Program
from synergrip.conic.rows import Item, Kind
from synergrip.conic.solution import Claim, Settings, Solution
from synergrip.conic.variable_bounds import LARGEST
from synergrip.linalg import Array, frozen

POLISHES = 60
"""Projections of a ray."""
ROUNDING = 1e-15
"""Relative shift that keeps a matrix regular."""


def relaxed(program: Program) -> Program:
    """Return: the least number t, from -1 on, by which the heads of all cones must grow at once. It has an answer.

    Its last unknown is t, its last row ``1 + t >= 0``; the others are those of the program.
    """
    n = len(program.q)
    wider = sparse.csc_matrix(-heads(program)[:, None])
    last = sparse.csc_matrix(([-1.0], ([0], [n])), shape=(1, n + 1))
    A = sparse.csc_matrix(sparse.vstack([sparse.hstack([program.A, wider]), last]))
    return replace(
        program, P=sparse.csc_matrix((n + 1, n + 1)), q=frozen(np.eye(n + 1)[n]), A=A,
        b=frozen(np.append(program.b, 1.0)), constant=0.0,
        box=frozen(np.append(program.variable_bounds, LARGEST)),
        blocks=(*program.blocks, Block("relaxation", Kind.NONNEGATIVE, 1, (Item("least"),), 0, 1)),
    )  # fmt: skip


def heads(program: Program) -> Array:
    """Return (m,) 1 at the first row of every cone, 0 elsewhere; equalities have none."""
    found = np.zeros(len(program.b))
    for block, rows in program.slices():
        if block.kind is not Kind.ZERO:
            found[rows][:: block.dim] = 1.0
    return found


def polished(program: Program, ray: Array) -> Array:
    """Return the ray y (m,) with less of ``A'y`` left over, still in the dual cone: projected on each in turn."""
    from scipy.sparse import linalg

    if not np.all(np.isfinite(ray)) or not np.any(ray):
        return ray
    sizes = row_sizes(program)  # a far limit counts as much as a near one
    A = sparse.csc_matrix(sparse.diags_array(1 / sizes) @ program.A)
    normal = sparse.csc_matrix(A.T @ A)
    shift = ROUNDING * float(normal.diagonal().max(initial=1.0))
    solve = linalg.splu(normal + shift * sparse.eye_array(len(program.q), format="csc")).solve
    y = project_on_dual(program, ray) / np.abs(ray).max() * sizes
    for _ in range(POLISHES):
        y = project_on_dual(program, y - A @ solve(A.T @ y))
    return np.asarray(y / sizes)


def proof(program: Program, rays: Sequence[Array]) -> Certificate:
    """Return the first certificate of infeasibility that verifies: of the rays as they are, else polished."""
    tried = Certificate("infeasible", False)
    for candidate in chain(rays, (polished(program, ray) for ray in rays)):
        tried = judge_infeasible(program, candidate)
        if tried.verified:
            break
    return tried


def proven(found: Solution, program: Program, solver: Solver, settings: Settings) -> Solution:
    """Return a claim of infeasibility with a ray that proves it, where its own does not and there is one."""
    if found.claim is not Claim.INFEASIBLE or judge_infeasible(program, found.z).verified:
        return found
    second = solver(relaxed(program), settings)
    iterations, seconds = found.iterations + second.iterations, found.seconds + second.seconds
    multipliers = second.z[: len(program.b)]
    best = proof(program, (multipliers, found.z))
    ray = multipliers if best.y is None or not best.verified else best.y
    return replace(found, z=frozen(ray), iterations=iterations, seconds=seconds, runs=found.runs + second.runs)


def proving(solve: Solver) -> Solver:
    """Return a solver as one whose claims of infeasibility come with a ray that proves them, where there is one."""
    return lambda program, settings: proven(solve(program, settings), program, solve, settings)
