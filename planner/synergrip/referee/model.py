"""A question written down a second time, in CVXPY and in the synergy references themselves.

Nothing here is shared with the formulation in `conic`: forces are ``lambda_0 + F dz_r - G+ dw`` (28), beta is
imposed as the equality ``Gamma_ucs^+ U dz_r = beta`` (35), cones and ranges are the physical formulas. Only the
units of the rows are the same, so that the multipliers mean the same.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from synergrip.conic.formulation import Units
from synergrip.conic.rows import Item, items_of
from synergrip.linalg import Array
from synergrip.referee.maps import Expression as Expression
from synergrip.referee.maps import Maps, mapped
from synergrip.statics import Coordinates, Response
from synergrip.statics.analysis import Analysis
from synergrip.statics.each import Each
from synergrip.statics.motion import forces_at_start


@dataclass(frozen=True)
class Cone:
    """``head >= 0`` for each item, or ``head >= ||tail||`` for the one item, or ``head = 0``; at every knot."""

    key: str
    """Key in the problem file of what asks for it."""
    items: tuple[Item, ...]
    head: Expression  # (T, len(items)), or (T,) with a tail
    tail: Expression | None = None  # (T, d - 1)
    equality: bool = False

    def constraint(self, relaxation: Expression = 0.0) -> Expression:
        """Return the constraint; an inequality is loosened by `relaxation`."""
        import cvxpy as cp

        if self.equality:
            return -self.head == 0
        if self.tail is None:
            return self.head + relaxation >= 0
        return cp.SOC(self.head + relaxation, self.tail, axis=1)

    def multipliers(self, constraint: Expression) -> Iterator[tuple[Item, Array]]:
        """Yield each item with its multipliers (T, d); those of an inequality lie in the dual cone."""
        if self.tail is None:
            values = np.reshape(constraint.dual_value, self.head.shape)
            yield from ((item, values[:, [i]]) for i, item in enumerate(self.items))
        else:
            head, tail = constraint.dual_value
            knots = len(np.atleast_1d(head))
            yield self.items[0], np.column_stack([np.reshape(head, knots), np.reshape(tail, (knots, -1))])


@dataclass(frozen=True)
class Model:
    """A task as expressions in dz_r; SI units."""

    maps: Maps
    times: Array  # (T,) [s]
    wrench: Array  # (T, 6) external wrench on the object
    dz_r: Expression  # (T, n_z)
    force: Expression  # (T, n_l) [N, N m]
    beta: Expression  # (T, dim Gamma_ucs) [m]
    rigid_basis: Array  # (6, dim Gamma_ucs), or (T, 6, dim Gamma_ucs)
    beta_free: Expression
    """(T, m) beta beyond what is given, in the directions in which it may leave it [m]."""
    gamma: Expression  # (T, dim Gamma_zr)
    tracking: tuple[Cone, ...]
    """beta as wanted where it is, and gamma = 0 where nothing asks about it."""
    redundancy: bool
    """Whether gamma is free."""
    target: Array  # (T, 6) wanted displacement of the object
    units: Units
    """Of rows and of goals."""
    stated: Units
    """Of goals in a weighted sum."""
    kept: float | None = None
    """The scalar of the goal that is written down, when it has been found and is kept; None when it is an unknown."""

    def scalar(self) -> Expression:
        """Return the scalar of the goal that is written down."""
        import cvxpy as cp

        return cp.Variable() if self.kept is None else cp.Constant(self.kept)

    @property
    def response(self) -> Response:
        """Response at the start, for names, contacts and lengths."""
        return self.maps.response

    @property
    def force_unit(self) -> float:
        """[N]."""
        return self.units.force

    @property
    def moved(self) -> Expression:
        """Object motion U dz_r (T, 6) that the references make [m, rad]."""
        return mapped(self.maps.of(lambda at: at.response.du_dzr), self.dz_r)

    @property
    def sag(self) -> Array:
        """Object motion (T, 6) that the change of the load makes [m, rad]."""
        return np.asarray(mapped(self.maps.of(lambda at: at.response.du_dw), self._load_change))

    @property
    def rigid(self) -> Expression:
        """Its rigid part Gamma_ucs beta (T, 6) [m, rad]."""
        return mapped(self.rigid_basis, self.beta)

    @property
    def torque(self) -> Expression:
        """Joint torques J' lambda (T, n_q) (6) [N m]."""
        return mapped(self.maps.of(lambda at: at.response.grasp.J.T), self.force)

    @property
    def effort(self) -> Expression:
        """Actuator efforts S' tau (T, n_z)."""
        return mapped(self.maps.of(lambda at: at.response.grasp.S.T), self.torque)

    @property
    def joints(self) -> Expression:
        """Joint displacements (T, n_q) [rad or m]."""
        of_load = np.asarray(mapped(self.maps.of(lambda at: at.response.dq_dw), self._load_change))
        return mapped(self.maps.of(lambda at: at.response.dq_dzr), self.dz_r) + of_load

    @property
    def _load_change(self) -> Array:
        return self.wrench - self.maps.of(lambda at: at.response.grasp.w_0)


@dataclass(frozen=True)
class Written:
    """A goal: what is minimised, in the goal's units, and the cones of its scalar."""

    cost: Expression
    cones: tuple[Cone, ...] = ()
    scalar: Expression | None = None


def write_model(
    response: Response, coordinates: Coordinates, *,
    times: Array, wrench: Array, beta: Array, units: Units, redundancy: bool,
    beta_basis: Array, target: Array, rigid_basis: Array, references: Expression | None = None,
    stated: Units | None = None, each: Sequence[Analysis] | Each = (),
) -> Model:  # fmt: skip
    """Write a task down; the arguments are those of `formulate`, and the references when they are not wholly free.

    `rigid_basis` is (T, 6, dim Gamma_ucs) when there is a grasp for `each` knot.
    """
    import cvxpy as cp

    grasp, dz_r = response.grasp, references
    if dz_r is None:
        dz_r = cp.Variable((len(times), grasp.n_z)) * _reference_size(response, units.force)
    maps = Maps(response, coordinates, tuple(each))
    of_load, change = maps.of(lambda at: at.response.dlambda_dw), wrench - maps.of(lambda at: at.response.grasp.w_0)
    known = maps.of(lambda at: forces_at_start(at.response)) + np.asarray(mapped(of_load, change))
    n_alpha, n_beta, _ = coordinates.dimensions
    M = maps.of(lambda at: at.coordinates.M)
    to_beta, to_gamma = M[..., n_alpha : n_alpha + n_beta, :], M[..., n_alpha + n_beta :, :]
    gamma = mapped(to_gamma, dz_r)
    tracking = []
    beyond = mapped(to_beta, dz_r) - beta
    fixed = np.linalg.svd(beta_basis, full_matrices=True)[0][:, beta_basis.shape[1] :]  # where beta may not leave it
    if fixed.size and references is None:  # else they are such that beta is as wanted, and gamma as it is to be
        sizes = np.linalg.norm(fixed.T @ coordinates.M[n_alpha : n_alpha + n_beta], axis=1)
        tracking.append(_equal("beta", beyond @ (fixed / sizes)))
    if to_gamma.shape[-2] and not redundancy and references is None:
        tracking.append(_equal("gamma", gamma))
    return Model(
        maps, times, wrench, dz_r, known + mapped(maps.of(lambda at: at.response.dlambda_dzr), dz_r),
        mapped(to_beta, dz_r), rigid_basis, beyond @ beta_basis, gamma, tuple(tracking), redundancy, target, units,
        stated or units,
    )  # fmt: skip


def _reference_size(response: Response, force_unit: float) -> float:
    """Return the references that answer to the force unit; 1 where they make no force."""
    stiffness = float(np.linalg.norm(response.scale.force[:, None] * response.dlambda_dzr, 2))
    moving = float(np.linalg.norm(response.K @ response.grasp.J @ response.grasp.S, 2))
    return force_unit / stiffness if stiffness > 1e-12 * moving else 1.0


def _equal(name: str, value: Expression) -> Cone:
    return Cone(name, items_of(f"{name}_{i + 1}" for i in range(value.shape[1])), value, equality=True)


@dataclass(frozen=True)
class Posed:
    """A CVXPY problem with its cones, each beside its constraint."""

    problem: Expression
    pairs: tuple[tuple[Cone, Expression], ...]

    def run(self, solver: str, options: Mapping[str, Any]) -> str:
        """Solve with a solver that CVXPY knows and return CVXPY's status."""
        import cvxpy as cp

        with warnings.catch_warnings():
            # the status says it as well, and the certificate decides
            warnings.filterwarnings("ignore", "Solution may be inaccurate", UserWarning)
            try:
                self.problem.solve(solver=solver, **options)
            except cp.error.SolverError:
                return str(cp.SOLVER_ERROR)
        return str(self.problem.status)

    @property
    def solved(self) -> bool:
        """True when there are values and multipliers to look at."""
        return str(self.problem.status) in ("optimal", "optimal_inaccurate")

    @property
    def iterations(self) -> int:
        """Iterations of the solver, 0 where it does not say."""
        return int((self.problem.solver_stats and self.problem.solver_stats.num_iters) or 0)

    @property
    def seconds(self) -> float:
        """Time in the solver [s], 0 where it does not say."""
        return float((self.problem.solver_stats and self.problem.solver_stats.solve_time) or 0.0)

    @property
    def value(self) -> float:
        """Value of the objective."""
        return float(self.problem.value)


def pose(model: Model, cost: Expression, cones: Sequence[Cone], more: Sequence[Any] = ()) -> Posed:
    """Return: minimise `cost` over the references that track the wanted motion and keep all `cones` and some `more`."""
    return _posed(model, cost, cones, 0.0, list(more))


def pose_relaxed(model: Model, cones: Sequence[Cone]) -> Posed:
    """Return: the least number by which all inequalities must be loosened at once, from -1. It always has an answer."""
    import cvxpy as cp

    relaxation = cp.Variable()
    return _posed(model, relaxation, cones, relaxation, [relaxation >= -1])


def _posed(model: Model, cost: Expression, cones: Sequence[Cone], relaxation: Expression, more: list[Any]) -> Posed:
    import cvxpy as cp

    pairs = tuple((cone, cone.constraint(relaxation)) for cone in cones)
    constraints = [constraint for _, constraint in pairs] + [cone.constraint() for cone in model.tracking]
    return Posed(cp.Problem(cp.Minimize(cost), constraints + more), pairs)
