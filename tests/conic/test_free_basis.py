"""What sums of squares leave open of all unknowns: the null space of their rows, found without ever forming these."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest
from random_formulations import random_formulation
from scipy.linalg import null_space

from synergrip.conic.formulate import formulate
from synergrip.conic.formulation import Formulation
from synergrip.conic.free_basis import _from_knot_to_knot, _products, free_basis
from synergrip.conic.goals.goal import Goal, Squares
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.goals.least_motion import LeastMotion
from synergrip.conic.goals.least_reconfiguration import LeastReconfiguration
from synergrip.conic.goals.steady_forces import SteadyForces
from synergrip.conic.goals.weighted_sum import WeightedSum
from synergrip.conic.rows import Earlier
from synergrip.linalg import Array, frozen

KNOTS = 7
TRAVEL, SMOOTH, STEADY = LeastMotion("rates"), LeastMotion("accelerations"), SteadyForces()
ORDERS: tuple[tuple[Goal, ...], ...] = (
    (LeastEffort(),), (LeastEffort("torque"),), (LeastMotion(),), (TRAVEL,), (SMOOTH,), (STEADY,),
    (LeastReconfiguration(),), (STEADY, TRAVEL), (TRAVEL, STEADY), (SMOOTH, STEADY), (STEADY, SMOOTH),
    (SMOOTH, TRAVEL), (STEADY, LeastEffort("actuator")), (STEADY, LeastReconfiguration()),
    (WeightedSum(((SteadyForces(exact=True), 2.0), (LeastReconfiguration(), 0.5))),),
    (STEADY, SMOOTH, LeastEffort(), LeastReconfiguration()),
)  # fmt: skip


def over(knots: int, formulation: Formulation) -> Formulation:
    """The same grasp over that many uneven knots."""
    times = np.cumsum(np.linspace(0.1, 0.3, knots))
    return formulate(
        formulation.response, formulation.spaces, formulation.coordinates, times=times,
        wrench=np.tile(formulation.wrench[0], (knots, 1)), beta=np.tile(formulation.beta.constant[0], (knots, 1)),
        units=formulation.units, redundancy=True, beta_basis=np.eye(formulation.beta.constant.shape[1])[:, :1],
    )  # fmt: skip


def rows(squares: Sequence[Squares], knots: int, n_v: int) -> Array:
    """Every row of the squares (R, T n_v), each part 1 in size, made by looking at every unknown alone."""
    units = np.eye(knots * n_v).reshape(-1, knots, n_v)
    parts = [np.zeros((1, knots * n_v))]  # older SciPy has no null space of a matrix without rows
    for part in squares:
        still = part.at(np.zeros((knots, n_v))).ravel()
        own = np.array([part.at(unit).ravel() - still for unit in units]).T
        parts.append(own / max(np.linalg.norm(own, 2), 1e-300))
    return np.vstack(parts)


def same_span(first: Array, second: Array) -> None:
    """Two sets of independent columns span the same."""
    assert first.shape == second.shape
    for one, other in ((first, second), (second, first)):
        left = one - other @ np.linalg.lstsq(other, one, rcond=None)[0]
        assert np.abs(left).max(initial=0.0) < 1e-8 * max(np.abs(one).max(initial=0.0), 1.0)


@pytest.mark.parametrize("order", ORDERS, ids=lambda order: ", ".join(goal.name for goal in order))
@pytest.mark.parametrize("seed", range(4))
def test_the_basis_is_the_null_space_of_all_that_is_squared(seed: int, order: tuple[Goal, ...]) -> None:
    formulation = over(KNOTS, random_formulation(seed)[1])
    squares = [part for goal in order for part in goal.objective(formulation).squares]
    knots, n_v = formulation.knots, formulation.n_v
    basis = free_basis(squares, knots, n_v).toarray()
    same_span(basis, null_space(rows(squares, knots, n_v), rcond=1e-8))
    assert _products(squares, knots, n_v) is not None  # as every goal of ours is
    same_span(_from_knot_to_knot(squares, knots, n_v).toarray(), basis)
    gram = basis.T @ basis
    np.testing.assert_allclose(gram, np.diag(np.diag(gram)), atol=1e-9)
    sizes = np.linalg.norm(basis.reshape(knots, n_v, -1), axis=1).max(axis=0, initial=0.0)
    np.testing.assert_allclose(sizes, 1.0, rtol=1e-9)


@pytest.mark.parametrize("seed", range(8))
def test_squares_of_any_form_are_followed_from_knot_to_knot(seed: int) -> None:
    rng = np.random.default_rng(seed)
    knots, n_v = int(rng.integers(2, 9)), int(rng.integers(1, 6))
    squares = []
    for _ in range(int(rng.integers(1, 4))):
        reach, m = int(rng.integers(0, min(3, knots))), int(rng.integers(1, 3))
        count = knots - reach - int(rng.integers(0, 2)) * (knots - reach > 1)  # rows may begin late
        earlier = tuple(
            Earlier(lag, frozen(rng.normal(size=(m, n_v))), frozen(rng.normal(size=count)))
            for lag in range(1, reach + 1)
        )
        squares.append(Squares(frozen(rng.normal(size=(m, n_v))), frozen(np.zeros((count, m))), earlier))
    same_span(free_basis(squares, knots, n_v).toarray(), null_space(rows(squares, knots, n_v), rcond=1e-8))


def test_one_goal_may_leave_what_makes_up_for_what_another_left() -> None:
    """What moves in time like one product may be balanced by another: no product any more, and still found."""
    knots, n_v = 6, 3
    still = frozen(np.zeros((knots - 1, 1)))

    def steps(direction: Sequence[float]) -> Squares:
        matrix = frozen([direction])
        return Squares(matrix, still, (Earlier(1, frozen(-matrix), frozen(np.ones(knots - 1))),))

    bend = frozen([[1.0, 1.0, 0.0]])
    twice = (Earlier(1, bend, frozen(-3 * np.ones(knots - 1))),)
    squares = [steps([1.0, 0.0, 0.0]), Squares(bend, still, twice)]
    assert _products(squares, knots, n_v) is None
    same_span(free_basis(squares, knots, n_v).toarray(), null_space(rows(squares, knots, n_v)))


def test_a_steady_grip_leaves_a_constant_squeeze_and_any_redundancy() -> None:
    """The unknowns left are one squeeze for all knots and the rest at every knot: no courses times directions."""
    formulation = over(KNOTS, random_formulation(0)[1])
    squares = STEADY.objective(formulation).squares
    n_alpha = formulation.alpha.matrix.shape[0]
    left = formulation.around(np.zeros((KNOTS, formulation.n_v)), free_basis(squares, KNOTS, formulation.n_v))
    assert left.unknowns == n_alpha + KNOTS * (formulation.n_v - n_alpha)
    assert [left.frees_alpha, left.frees_beta, left.frees_gamma] == [True, True, True]


@pytest.mark.parametrize("goal", [LeastEffort(), STEADY, SMOOTH], ids=lambda goal: goal.name)
def test_a_long_trajectory_stays_sparse(goal: Goal) -> None:
    knots = 2_000
    formulation = over(knots, random_formulation(0)[1])
    squares = goal.objective(formulation).squares
    basis = free_basis(squares, knots, formulation.n_v)
    assert basis.nnz <= 2 * knots * formulation.n_v**2
    change = (basis @ np.ones(basis.shape[1])).reshape(knots, -1)
    still = squares[0].at(np.zeros_like(change))
    rate = np.abs(squares[0].earlier[0].weights).max() if squares[0].earlier else 1.0
    assert np.abs(squares[0].at(change) - still).max() < 1e-9 * rate * np.abs(change).max()
