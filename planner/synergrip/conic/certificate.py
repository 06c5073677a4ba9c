"""Answers re-verified from the program's data. NumPy only: this module imports no solver.

Optimal: the slack ``b - A x`` lies in its cone, the multipliers lie in the dual cone, the stationarity
``P x + q + A'z = 0`` holds, and primal and dual objective agree.
Unbounded: x leaves every cone nowhere, however far it is followed, and the goal improves all the way.
Infeasible: for y in the dual cone, every x with ``b - A x`` in the cone has ``0 <= y'(b - A x)``; so
``b'y + |A'y|' box < 0`` leaves no x in the box. An inexact ray proves it all the same.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.conic.basis import for_products, transposed_product
from synergrip.conic.cones import distance_to_cones, project_on_dual, row_sizes
from synergrip.conic.program import Program
from synergrip.documents.naming import naming_arguments
from synergrip.linalg import Array, frozen, largest_size
from synergrip.values import Value

PRIMAL_TOLERANCE = 5e-7
"""Largest violation of a cone, in the program's normalised units (1 is the size of the load)."""
DUAL_TOLERANCE = 1e-7
GAP_TOLERANCE = 1e-8
ACCEPTABLE = 1e-4
"""Gap within which a plan that holds is still of use, although it is not the best to all digits."""
TIGHT = 1e-7
"""A violation below this is not worth another attempt, when nothing smaller hangs on it."""
FAR = 1e3
"""Size of an unknown from which on units do not suit it."""
UNBOUNDED_GAIN = 1e-5
"""Least improvement along a ray of size 1, and share of it by which a cone may be left."""
HIDDEN = 1e-5
"""Share of a small value that is rounding from which on no units show to the tolerance whether it is the least."""
EPSILON = float(np.finfo(float).eps) / 2
ROUNDING = 1e-12
"""Relative rounding allowance when the sign of a sum decides a proof."""


@naming_arguments
@dataclass(frozen=True, eq=False, repr=False)
class Certificate(Value):
    """A claim about a program with the numbers that bear it out, or do not.

    Example:
        >>> refused.certificate.verified  # of an `Infeasible`
        True
    """

    kind: str
    """"optimal", "infeasible", "unbounded" or "none"."""
    verified: bool
    primal_residual: float = np.inf
    """Optimal: distance of the slack from its cone. Infeasible: the largest entry of |A'y|."""
    dual_residual: float = np.inf
    """Optimal: largest entry of the stationarity residual. Infeasible: how far y had to be moved into the dual cone."""
    gap: float = np.inf
    """Optimal: |primal - dual objective|, relative. Infeasible: ``b'y + |A'y|' box`` with b'y = -1: negative proves."""
    y: Array | None = None
    """(m,) the proof of infeasibility, scaled to b'y = -1."""
    rounding: float = 0.0
    """Optimal: about how much of the gap is rounding of the sums that it is worked out from; 0 where it verifies."""

    @property
    def acceptable(self) -> bool:
        """True for an x that keeps every row and is the best to some digits, verified or not."""
        return self.kind == "optimal" and self.primal_residual <= PRIMAL_TOLERANCE and self.gap <= ACCEPTABLE

    @property
    def rounded(self) -> bool:
        """True where rounding hides whether an x that holds is the best, as it would with any other."""
        return self.acceptable and not self.verified and self.rounding > GAP_TOLERANCE

    def tight(self, violation: float = TIGHT) -> bool:
        """Return whether this is a verified claim, and an optimum violates no cone by more than `violation`."""
        return self.verified and (self.kind != "optimal" or self.primal_residual <= violation)


@np.errstate(over="ignore", invalid="ignore")
def judge_optimal(program: Program, x: Array, z: Array) -> Certificate:
    """Judge the claim that x (n,) is optimal, with multipliers z (m,) of the rows."""
    if not (np.isfinite(x).all() and np.isfinite(z).all()):
        return Certificate("optimal", False)
    farthest, A = largest_size(x), for_products(program.A)
    primal = distance_to_cones(program, program.b - A @ x)
    if farthest > FAR:  # nearer by, nothing but the cones bounds unknowns
        primal = max(primal, float((np.abs(x) - program.variable_bounds).max()))
    moved = project_on_dual(program, z)
    Px = program.P @ x if program.P.data.size else np.zeros(len(x))
    stationarity = Px + program.q + transposed_product(A, moved)
    size = max(1.0, largest_size(program.q), largest_size(Px))
    dual = largest_size(stationarity) / size
    half, constant = float(x @ Px) / 2, program.constant
    value, bound = half + float(program.q @ x), -half - float(program.b @ moved)
    # relative to the goal's value, or to the terms that cancel in it
    # what is left of the stationarity, times unknowns far from 1, may be missing from the bound
    missing = float(np.abs(stationarity) @ np.where(np.abs(x) > FAR, np.abs(x), 0.0)) if farthest > FAR else 0.0
    terms = max(1.0, abs(value), abs(bound), abs(value + constant), abs(bound + constant))
    gap = (abs(value - bound) + missing) / terms
    verified = primal <= PRIMAL_TOLERANCE and dual <= DUAL_TOLERANCE and gap <= GAP_TOLERANCE
    rounding = 0.0 if verified else rounding_of(program, x) / terms
    return Certificate("optimal", bool(verified), max(primal, 0.0), dual, gap, rounding=rounding)


def rounding_of(program: Program, x: Array) -> float:
    """Return about how much of the objective at x (n,) is rounding of the sums that it is worked out from."""
    return float(np.linalg.norm(x * (abs(program.P) @ np.abs(x)))) * EPSILON


def rounding_hides(program: Program, x: Array, value: float) -> bool:
    """Return whether so much of a small value of the objective at x (n,) is rounding that no other units help."""
    return rounding_of(program, x) > HIDDEN * value


@np.errstate(over="ignore", invalid="ignore")
def judge_unbounded(program: Program, x: Array) -> Certificate:
    """Judge the claim that the goal improves without end along x (n,).

    Every cone is measured by its own entries of A: a limit that is far away is still a limit, and stops the way.
    """
    size = float(np.abs(x).max(initial=0.0))
    if not np.all(np.isfinite(x)) or not size > 0:
        return Certificate("unbounded", False)
    ray = x / size
    gain, curved = -float(program.q @ ray), float(np.abs(program.P @ ray).max(initial=0.0))
    outside = distance_to_cones(program, -(program.A @ ray) / row_sizes(program))
    verified = gain > UNBOUNDED_GAIN and max(outside, curved) <= UNBOUNDED_GAIN * gain
    return Certificate("unbounded", bool(verified), outside, curved, -gain)


@np.errstate(over="ignore", invalid="ignore")
def judge_infeasible(program: Program, y: Array) -> Certificate:
    """Judge the claim that no x in the box satisfies the program, with the ray y (m,)."""
    if not np.all(np.isfinite(y)) or not np.any(y):
        return Certificate("infeasible", False)
    inside = project_on_dual(program, y)
    drop = -float(program.b @ inside)
    if not drop > 0:
        return Certificate("infeasible", False)
    ray = inside / drop
    moved = float(np.abs(ray - y / drop).max())
    leak = np.abs(transposed_product(for_products(program.A), ray))
    allowance = ROUNDING * float(np.abs(program.b) @ np.abs(ray))
    sign = -1.0 + float(leak @ program.variable_bounds) + allowance
    return Certificate("infeasible", sign < 0, float(leak.max(initial=0.0)), moved, sign, frozen(ray))
