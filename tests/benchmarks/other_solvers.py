"""Small cone programs by other solvers, one after the other or as a batch: for `many_against.py`.

Each takes `ConeProblems` and returns x (N, n) and multipliers z (N, m), rows of NaN where there is no answer; z is None
where the interface gives none. All are asked for `TOLERANCE`.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable
from importlib.util import find_spec
from typing import Any

import numpy as np
from scipy import sparse

from synergrip.batch.cone_problems import ConeProblems
from synergrip.linalg import Array

TOLERANCE, FACETS = 1e-8, 8
Answers = tuple[Array, Array | None]
Way = Callable[[ConeProblems], Answers]


def ways() -> dict[str, Way]:
    """Return every way that is installed, Clarabel's first."""
    found: dict[str, Way] = {"Clarabel cold": clarabel_cold, "Clarabel updated": clarabel_updated}
    if find_spec("cvxpy"):
        found |= {"CVXPY": cvxpy_anew, "CVXPY parameters": cvxpy_with_parameters()}
    found |= {"QOCO": qoco} if find_spec("qoco") else {}
    found |= {"Moreau": moreau} if find_spec("moreau") else {}
    if find_spec("qpsolvers"):
        found |= {f"{name} pyramids": pyramids(name) for name in ("osqp", "piqp") if find_spec(name)}
    return found


def _of(problems: ConeProblems, i: int) -> tuple[Array, Array]:
    return problems.A[i if len(problems.A) > 1 else 0], problems.q[i if len(problems.q) > 1 else 0]


def _clarabel(problems: ConeProblems) -> tuple[Any, list[Any]]:
    import clarabel as solver

    lines = sum(size == 1 for size in problems.sizes)
    cones = [solver.NonnegativeConeT(lines)] * bool(lines)
    options = solver.DefaultSettings()
    options.verbose, options.max_threads = False, 1
    options.tol_gap_abs = options.tol_gap_rel = options.tol_feas = TOLERANCE
    return options, cones + [solver.SecondOrderConeT(size) for size in problems.sizes if size > 1]


def clarabel_cold(problems: ConeProblems, tolerance: float = TOLERANCE) -> Answers:
    """Solve by Clarabel, made anew for each."""
    import clarabel as solver

    (options, cones), n = _clarabel(problems), problems.q.shape[-1]
    options.tol_gap_abs = options.tol_gap_rel = options.tol_feas = tolerance
    x, z = [], []
    for i, b in enumerate(problems.b):
        A, q = _of(problems, i)
        found = solver.DefaultSolver(sparse.csc_matrix((n, n)), q, sparse.csc_matrix(A), b, cones, options).solve()
        x.append(found.x)
        z.append(found.z)
    return np.array(x), np.array(z)


def clarabel_updated(problems: ConeProblems) -> Answers:
    """Solve by one Clarabel solver whose numbers are exchanged."""
    import clarabel as solver

    (options, cones), n = _clarabel(problems), problems.q.shape[-1]
    options.presolve_enable = False
    pattern = sparse.csc_matrix(np.ones(problems.A.shape[1:]))
    own, x, z = None, [], []
    for i, b in enumerate(problems.b):
        A, q = _of(problems, i)
        if own is None:
            first = sparse.csc_matrix((A.T.ravel(), pattern.indices, pattern.indptr), shape=pattern.shape)
            own = solver.DefaultSolver(sparse.csc_matrix((n, n)), q, first, b, cones, options)
        else:
            own.update(A=A.T.ravel(), q=q, b=b)
        found = own.solve()
        x.append(found.x)
        z.append(found.z)
    return np.array(x), np.array(z)


def _stated(problems: ConeProblems, A: Any, b: Any) -> tuple[Any, Any]:
    """Return a CVXPY problem and its unknowns, as one writes it."""
    import cvxpy as cp

    x = cp.Variable(problems.q.shape[-1])
    slack, constraints = b - A @ x, []
    for group in problems.groups:
        for k in range(group.cones):
            rows = slack[group.rows.start + k * group.size : group.rows.start + (k + 1) * group.size]
            constraints.append(rows[0] >= 0 if group.size == 1 else cp.norm(rows[1:]) <= rows[0])
    return cp.Problem(cp.Minimize(problems.q[0] @ x), constraints), x


def _value(unknowns: Any) -> Array:
    return np.full(unknowns.shape, np.nan) if unknowns.value is None else np.asarray(unknowns.value)


def cvxpy_anew(problems: ConeProblems) -> Answers:
    """Solve by CVXPY, stated anew each time."""
    found = []
    for i, b in enumerate(problems.b):
        problem, x = _stated(problems, _of(problems, i)[0], b)
        problem.solve("CLARABEL")
        found.append(_value(x))
    return np.array(found), None


def cvxpy_with_parameters() -> Way:
    """Return what solves by CVXPY, stated once with parameters; stating it is not measured from the second run on."""
    import cvxpy as cp

    kept: dict[ConeProblems, Any] = {}

    def solved(problems: ConeProblems) -> Answers:
        if problems not in kept:
            A, b = cp.Parameter(problems.A.shape[1:]), cp.Parameter(problems.b.shape[1:])
            kept[problems] = (*_stated(problems, A, b), A, b)
        problem, x, A, b = kept[problems]
        found = []
        for i, values in enumerate(problems.b):
            A.value, b.value = _of(problems, i)[0], values
            problem.solve("CLARABEL")
            found.append(_value(x))
        return np.array(found), None

    return solved


def qoco(problems: ConeProblems) -> Answers:
    """Solve by QOCO, made anew for each."""
    import qoco as solver

    lines = sum(size == 1 for size in problems.sizes)
    cones = np.array([size for size in problems.sizes if size > 1], dtype=np.int32)
    n, x, z = problems.q.shape[-1], [], []
    for i, b in enumerate(problems.b):
        (A, q), own = _of(problems, i), solver.QOCO()
        own.setup(n, len(b), 0, None, q, None, None, sparse.csc_matrix(A), b, lines, len(cones), cones,
                  abstol=TOLERANCE, reltol=TOLERANCE)  # fmt: skip
        found = own.solve()
        x.append(np.array(found.x))
        z.append(np.array(found.z))
    return np.array(x), np.array(z)


def moreau(problems: ConeProblems) -> Answers:
    """Solve by Moreau, all as one batch on the processor."""
    import moreau as solver

    lines, (N, m), n = sum(size == 1 for size in problems.sizes), problems.b.shape, problems.q.shape[-1]
    cones = solver.Cones(num_nonneg_cones=lines, so_cone_dims=[size for size in problems.sizes if size > 1])
    accuracy = solver.IPMSettings(tol_gap_abs=TOLERANCE, tol_gap_rel=TOLERANCE, tol_feas=TOLERANCE)
    options = solver.Settings(solver="ipm", device="cpu", batch_size=N, ipm_settings=accuracy)
    columns = np.tile(np.arange(n), m)
    own = solver.CompiledSolver(n, m, np.zeros(n + 1, dtype=int), [], n * np.arange(m + 1), columns, cones, options)
    own.setup(np.zeros((N, 0)), np.broadcast_to(problems.A, (N, m, n)).reshape(N, m * n))
    found = own.solve(np.broadcast_to(problems.q, (N, n)), problems.b)
    return np.asarray(found.x), np.asarray(found.z)


OWN: dict[str, dict[str, float]] = {
    "osqp": {"eps_abs": TOLERANCE, "eps_rel": TOLERANCE, "max_iter": 100_000},
    "piqp": {"eps_abs": TOLERANCE, "eps_rel": TOLERANCE},
}
"""What QP solvers are told beyond the program."""


def pyramids(name: str) -> Way:
    """Return what solves by a QP solver, each cone of three rows or more as a pyramid inside it."""
    from qpsolvers import solve_qp

    def solved(problems: ConeProblems) -> Answers:
        n = problems.q.shape[-1]
        turn, P = (
            sparse.csc_matrix(sparse.block_diag([_inside(size) for size in problems.sizes])),
            1e-12 * sparse.eye(n, format="csc"),
        )
        found = []
        for i, b in enumerate(problems.b):
            A, q = _of(problems, i)
            with warnings.catch_warnings():  # of no answer, which is counted
                warnings.simplefilter("ignore")
                x = solve_qp(P, q, sparse.csc_matrix(turn @ A), turn @ b, solver=name, **OWN[name])
            found.append(np.full(n, np.nan) if x is None else x)
        return np.array(found), None

    return solved


def _inside(size: int) -> Array:
    """Return rows that are at least 0 inside a pyramid that lies in a cone of 1, 3 or 4 rows."""
    if size == 1:
        return np.ones((1, 1))
    turns = 2 * np.pi * np.arange(FACETS) / FACETS
    normals = np.column_stack([np.cos(turns), np.sin(turns)]) / np.cos(np.pi / FACETS)
    if size == 3:
        return np.column_stack([np.ones(FACETS), normals])
    signs = np.repeat([-1.0, 1.0], FACETS)[:, None]  # |tangential| + |spin| <= head lies in the ball
    return np.column_stack([np.ones(2 * FACETS), np.vstack([normals, normals]), signs])
