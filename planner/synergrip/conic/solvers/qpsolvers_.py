"""Quadratic programs through qpsolvers, by OSQP or whatever other backend is installed. Nothing it says is believed."""

from __future__ import annotations

import time
import warnings
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from synergrip.conic.program import Program
from synergrip.conic.rows import Kind
from synergrip.conic.solution import Claim, Settings, Solution
from synergrip.linalg import Array, frozen

OPTIONS: dict[str, Callable[[Settings], dict[str, Any]]] = {
    "osqp": lambda s: {"eps_abs": s.tolerance, "eps_rel": s.tolerance, "max_iter": 100 * s.max_iterations,
                       "polishing": True},
    "clarabel": lambda s: {"tol_gap_abs": s.tolerance, "tol_gap_rel": s.tolerance, "tol_feas": s.tolerance,
                           "max_iter": s.max_iterations},
    "scs": lambda s: {"eps_abs": s.tolerance, "eps_rel": s.tolerance, "max_iters": 100 * s.max_iterations},
    "piqp": lambda s: {"eps_abs": s.tolerance, "eps_rel": s.tolerance, "max_iter": s.max_iterations},
}  # fmt: skip
"""How each backend is told the settings; the others run as they come. An iteration of a first-order method (OSQP,
SCS) is cheap, so that it gets a hundred for every one of an interior-point method."""


def backends() -> tuple[str, ...]:
    """Return the names of the backends that are installed."""
    import qpsolvers

    return tuple(qpsolvers.available_solvers)


def other_cones(program: Program) -> tuple[str, ...]:
    """Return the keys of the limits whose cones a quadratic program cannot hold; none when `solve` can take it."""
    return tuple(dict.fromkeys(block.limit for block in program.blocks if block.kind is Kind.SECOND_ORDER))


def solve(program: Program, settings: Settings, backend: str = "osqp") -> Solution:
    """Solve a program without second-order cones; what goes wrong in the backend becomes its status.

    Args:
        program: one of which `other_cones` says none.
        settings: tolerance and iterations count.
        backend: one of `backends()`.

    Raises:
        ValueError: the program has second-order cones.
    """
    import qpsolvers

    if other_cones(program):
        raise ValueError(f"a quadratic program holds no second-order cones: {', '.join(other_cones(program))}")
    equal, below = _rows(program, Kind.ZERO), _rows(program, Kind.NONNEGATIVE)
    name = f"{backend} (qpsolvers {qpsolvers.__version__})"
    x, z = np.full(len(program.q), np.nan), np.zeros(len(program.b))
    start = time.perf_counter()
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        try:
            problem = qpsolvers.Problem(*_data(program, below, equal, backend in qpsolvers.sparse_solvers))
            found = qpsolvers.solve_problem(problem, backend, **OPTIONS.get(backend, _as_it_comes)(settings))
        except Exception as error:  # twenty backends raise what they like; it is no more than a bad answer
            status = f"{type(error).__name__}: {error}"
            return Solution(Claim.NOTHING, frozen(x), frozen(z), name, status, 0, time.perf_counter() - start)
    seconds = time.perf_counter() - start
    claim = Claim.OPTIMAL if found.found else Claim.NOTHING
    z[below], z[equal] = _sized(found.z, below.size), _sized(found.y, equal.size)
    info = found.extras.get("info")
    return Solution(
        claim, frozen(_sized(found.x, len(x))), frozen(z), name, _status(found, [str(w.message) for w in said]),
        int(getattr(info, "iter", 0)), seconds,
    )  # fmt: skip


def _data(program: Program, below: NDArray[np.intp], equal: NDArray[np.intp], is_sparse: bool) -> list[Any]:
    """Return P, q, G, h, A, b of ``G x <= h``, ``A x = b``; None for rows that there are none of."""
    data: list[Any] = []
    for matrix, vector in ((program.P, program.q), *((program.A[rows], program.b[rows]) for rows in (below, equal))):
        columns = sparse.csc_matrix(matrix)
        data += [columns if is_sparse else columns.toarray(), np.array(vector)] if vector.size else [None, None]
    return data


def _as_it_comes(settings: Settings) -> dict[str, Any]:
    return {}


def _rows(program: Program, kind: Kind) -> NDArray[np.intp]:
    """Return the numbers of the rows of one kind."""
    parts = [np.arange(rows.start, rows.stop) for block, rows in program.slices() if block.kind is kind]
    return np.concatenate([np.zeros(0, dtype=np.intp), *parts])


def _sized(values: Any, size: int) -> Array:
    """Return numbers as (size,); all NaN when the backend gave something else."""
    array = np.full(size, np.nan) if values is None else np.asarray(values, dtype=float).ravel()
    return array if array.size == size else np.full(size, np.nan)


def _status(found: Any, said: Sequence[str]) -> str:
    """Return the backend's own word where it has one, else whether it found something, else its warning."""
    word = getattr(found.extras.get("info"), "status", None) or found.extras.get("status")
    if word is None:
        word = "solved" if found.found else said[-1] if said else "not solved"
    return str(word)
