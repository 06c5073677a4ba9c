"""Clarabel, called directly: the fast path."""

from __future__ import annotations

import sys
from typing import Any

import numpy as np

from synergrip.conic.program import Program
from synergrip.conic.rows import Kind
from synergrip.conic.solution import Claim, Settings, Solution
from synergrip.conic.solvers.interrupts import interruptible
from synergrip.linalg import frozen

CLAIMS = {
    "Solved": Claim.OPTIMAL,
    "AlmostSolved": Claim.OPTIMAL,
    "PrimalInfeasible": Claim.INFEASIBLE,
    "AlmostPrimalInfeasible": Claim.INFEASIBLE,
    "DualInfeasible": Claim.UNBOUNDED,
    "AlmostDualInfeasible": Claim.UNBOUNDED,
}
"""Clarabel's status -> claim; every other status claims nothing. "Almost" is for the certificate to decide."""
FEW_ENTRIES = 5000
"""Entries of A up to which a program is solved before anybody could press a key: nothing is asked meanwhile."""
TOWARDS_A_RAY = 1e3
"""kappa over tau of the homogeneous embedding from which on an iterate may be looked at as a ray."""


def solve(program: Program, settings: Settings) -> Solution:
    """Solve a program with Clarabel.

    Raises:
        KeyboardInterrupt: somebody interrupted it.
    """
    if "clarabel" not in sys.modules:
        with interruptible():  # an interrupt may not fall into the loading of a compiled library
            import clarabel
    import clarabel

    options = clarabel.DefaultSettings()
    options.verbose = False
    options.tol_gap_abs = options.tol_gap_rel = options.tol_feas = settings.tolerance
    options.tol_infeas_abs = options.tol_infeas_rel = settings.tolerance
    options.max_iter = settings.max_iterations
    options.equilibrate_enable = settings.equilibrate
    options.static_regularization_constant = settings.regularisation
    options.max_step_fraction = settings.step
    # of P, which is whole, it takes the upper triangle
    solver = clarabel.DefaultSolver(program.P, program.q, program.A, program.b, cones_of(program), options)
    found, closest = (solver.solve(), 0.0) if program.A.nnz <= FEW_ENTRIES else _looked_at(solver)
    del solver  # its memory, many times that of the program
    status = str(found.status)
    return Solution(
        CLAIMS.get(status, Claim.NOTHING), frozen(found.x), frozen(found.z), f"Clarabel {clarabel.__version__}", status,
        int(found.iterations), float(found.solve_time), closest=closest,
    )  # fmt: skip


def _looked_at(solver: Any) -> tuple[Any, float]:
    """Return what a solver finds, which may be interrupted, and the least tolerance that any iterate kept."""
    kept: list[float] = []

    def look(iterate: Any) -> bool:
        kept.append(_kept(iterate))
        return stop(iterate)

    with interruptible() as stop:
        solver.set_termination_callback(look)
        found = solver.solve()
    return found, min(kept, default=0.0)


def _kept(iterate: Any) -> float:
    """Return the tolerance that an iterate keeps as an optimum; 0 where it may be on the way to a ray."""
    if iterate.ktratio > 1:  # it is not looked at as an optimum; as a ray from far above on
        return 0.0 if iterate.ktratio > TOWARDS_A_RAY else np.inf
    return float(max(min(iterate.gap_abs, iterate.gap_rel), iterate.res_primal, iterate.res_dual))


def cones_of(program: Program) -> list[Any]:
    """Return the cones of a program as Clarabel names them."""
    import clarabel

    cones: list[Any] = []
    for kind, dim, rows in program.stretches:
        count = rows.stop - rows.start
        if kind is Kind.SECOND_ORDER:
            cones += [clarabel.SecondOrderConeT(dim)] * (count // dim)
        elif count:
            cones.append((clarabel.ZeroConeT if kind is Kind.ZERO else clarabel.NonnegativeConeT)(count))
    return cones
