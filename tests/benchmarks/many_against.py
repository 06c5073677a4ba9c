"""What the same small programs cost by other means: ``python tests/benchmarks/many_against.py [TASKS] [RUNS]``.

The programs of `many.py`, largest margin, taken in turns: Clarabel made anew for each ("cold") and updated, CVXPY as
one writes it, CVXPY with parameters, QOCO where it is installed, pyramids of eight facets by OSQP and PIQP as far as
qpsolvers has them (their margin is smaller: the loss is told), and the compiled kernel. Microseconds a program, how
many times as fast as Clarabel cold, and the largest difference of the objective to Clarabel's at 1e-9.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from importlib.util import find_spec
from typing import Any

from many import FORMS, MARGIN, clarabel, in_turns

import numpy as np  # isort: skip - after the threads
from random_cone_problems import grasp_like, random_wrenches
from scipy import sparse

import synergrip as sg
from synergrip.batch import fast_kernel
from synergrip.batch.asked import asked
from synergrip.batch.assembly import assembled
from synergrip.batch.cone_problems import ConeProblems, Tolerance
from synergrip.batch.stated import stated_on

FACETS = 8


def programs(form: str, tasks: int) -> ConeProblems:
    """Return the largest margins of one grasp with many loads."""
    kinds, n_z = FORMS[form]
    rng = np.random.default_rng(0)
    analysis, wrenches = sg.analyse(grasp_like(rng, kinds, n_z)), random_wrenches(rng, tasks)
    limits = [sg.NormalForce(upper=10.0), sg.JointTorque(0.5), sg.SlipMargin(MARGIN)]
    question = asked(analysis, sg.Task(knots=1, limits=limits), wrenches, None, None)
    return assembled(stated_on(analysis, question.task, wrenches, None)).largest_margin()


def clarabel_updated(problems: ConeProblems) -> list[float]:
    """Return objectives by one Clarabel solver whose numbers are exchanged."""
    import clarabel as solver

    lines = sum(size == 1 for size in problems.sizes)
    cones = [solver.NonnegativeConeT(lines), *(solver.SecondOrderConeT(size) for size in problems.sizes if size > 1)]
    options = solver.DefaultSettings()
    options.verbose, options.max_threads, options.presolve_enable = False, 1, False
    q, full = problems.q[0], np.ones(problems.A.shape[1:])
    pattern, found, n = sparse.csc_matrix(full), [], len(problems.q[0])
    P = sparse.csc_matrix((n, n))
    own, values = None, [A.T.ravel() for A in problems.A]
    for i in range(len(problems)):
        if own is None:
            first = sparse.csc_matrix((values[i], pattern.indices, pattern.indptr), shape=full.shape)
            own = solver.DefaultSolver(P, q, first, problems.b[i], cones, options)
        else:
            own.update(A=values[i], b=problems.b[i])
        found.append(float(own.solve().obj_val))
    return found


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


def cvxpy_anew(problems: ConeProblems) -> list[float]:
    """Return objectives by CVXPY, stated anew each time."""
    return [float(_stated(problems, problems.A[i], problems.b[i])[0].solve("CLARABEL")) for i in range(len(problems))]


def cvxpy_with_parameters() -> Callable[[ConeProblems], list[float]]:
    """Return what solves by CVXPY, stated once with parameters."""
    import cvxpy as cp

    kept: dict[int, Any] = {}

    def solved(problems: ConeProblems) -> list[float]:
        if not kept:
            A, b = cp.Parameter(problems.A.shape[1:]), cp.Parameter(problems.b.shape[1:])
            kept[0] = (*_stated(problems, A, b), A, b)
        problem, _, A, b = kept[0]
        found = []
        for i in range(len(problems)):
            A.value, b.value = problems.A[i], problems.b[i]
            found.append(float(problem.solve("CLARABEL")))
        return found

    return solved


def qoco(problems: ConeProblems) -> list[float]:
    """Return objectives by QOCO, made anew each time."""
    import qoco as solver

    lines = sum(size == 1 for size in problems.sizes)
    cones = np.array([size for size in problems.sizes if size > 1], dtype=np.int32)
    n, found = problems.q.shape[-1], []
    for i in range(len(problems)):
        own = solver.QOCO()
        own.setup(n, sum(problems.sizes), 0, None, problems.q[0], None, None, sparse.csc_matrix(problems.A[i]),
                  problems.b[i], lines, len(cones), cones, abstol=1e-8, reltol=1e-8)  # fmt: skip
        found.append(float(own.solve().obj))
    return found


def pyramids(name: str) -> Callable[[ConeProblems], list[float]]:
    """Return what solves by a QP solver, each cone of three rows or more as a pyramid inside it."""
    from qpsolvers import solve_qp

    def solved(problems: ConeProblems) -> list[float]:
        rows = [_inside(size) for size in problems.sizes]
        turn, P = sparse.csc_matrix(sparse.block_diag(rows)), 1e-12 * sparse.eye(problems.q.shape[-1], format="csc")
        found = []
        for i in range(len(problems)):
            x = solve_qp(P, problems.q[0], sparse.csc_matrix(turn @ problems.A[i]), turn @ problems.b[i], solver=name)
            found.append(np.nan if x is None else float(problems.q[0] @ x))
        return found

    return solved


def _inside(size: int) -> np.ndarray:
    """Return rows that are at least 0 inside a pyramid that lies in a cone of 1, 3 or 4 rows."""
    if size == 1:
        return np.ones((1, 1))
    turns = 2 * np.pi * np.arange(FACETS) / FACETS
    normals = np.column_stack([np.cos(turns), np.sin(turns)]) / np.cos(np.pi / FACETS)
    if size == 3:
        return np.column_stack([np.ones(FACETS), normals])
    signs = np.repeat([-1.0, 1.0], FACETS)[:, None]  # |tangential| + |spin| <= head lies in the ball
    return np.column_stack([np.ones(2 * FACETS), np.vstack([normals, normals]), signs])


def main() -> None:
    """Print a line for each way."""
    tasks, runs = (int(text) for text in (*sys.argv[1:], *("60", "3")[len(sys.argv) - 1 :]))
    for form in FORMS:
        problems = programs(form, tasks)
        ways = {"Clarabel cold": clarabel, "Clarabel updated": clarabel_updated, "CVXPY": cvxpy_anew,
                "CVXPY parameters": cvxpy_with_parameters()}  # fmt: skip
        ways |= {"QOCO": qoco} if find_spec("qoco") else {}
        if find_spec("qpsolvers"):
            ways |= {f"{name} pyramids": pyramids(name) for name in ("osqp", "piqp") if find_spec(name)}
        things: dict[str, tuple[int, Callable[[], Any]]] = {
            name: (tasks, lambda way=way, problems=problems: way(problems)) for name, way in ways.items()
        }
        if find_spec("numba"):
            whole, never = programs(form, 4096), np.full(4096, -np.inf)
            things["kernel"] = (4096, lambda p=whole, n=never: fast_kernel.solve(p, Tolerance(), n))
        took, theirs = in_turns(things, runs), np.array(clarabel(problems, 1e-9))
        for name, microseconds in took.items():
            apart = np.array(ways[name](problems)) - theirs if name in ways else np.zeros(1)
            none = f", {int(np.isnan(apart).sum())} without an answer" if np.isnan(apart).any() else ""
            print(f"{form:>7} {name:>17} {microseconds:>10.1f} us {took['Clarabel cold'] / microseconds:>8.3g}x  "
                  f"difference {np.nanmax(np.abs(apart)):.0e}{none}", flush=True)  # fmt: skip


if __name__ == "__main__":
    main()
