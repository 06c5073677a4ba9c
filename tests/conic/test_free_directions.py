"""What earlier goals leave open of a formulation: the same program, written in fewer unknowns."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
import pytest
from random_formulations import KNOTS, LIMITS, random_formulation
from scipy import sparse

from synergrip.conic.affine import Affine
from synergrip.conic.build import build
from synergrip.conic.goals.goal import Goal
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.goals.least_holding import LeastHolding
from synergrip.conic.goals.least_motion import LeastMotion
from synergrip.conic.goals.least_peak import LeastPeak
from synergrip.conic.goals.least_reconfiguration import LeastReconfiguration
from synergrip.conic.goals.steady_forces import SteadyForces
from synergrip.conic.goals.weighted_sum import WeightedSum
from synergrip.conic.program import Program
from synergrip.conic.variable_bounds import _implied

GOALS: tuple[Goal, ...] = (
    LargestMargin(), LeastPeak(), LeastEffort(), LeastEffort("torque"), LeastMotion(), LeastMotion("rates"),
    LeastMotion("accelerations"), SteadyForces(), LeastHolding(), LeastReconfiguration(),
    WeightedSum(((LeastEffort(), 2.0), (LeastMotion("accelerations", exact=True), 0.1))),
)  # fmt: skip


@pytest.mark.parametrize("of_each_knot", [True, False])
@pytest.mark.parametrize("goal", GOALS, ids=lambda goal: goal.name)
@pytest.mark.parametrize("seed", range(4))
def test_a_program_around_a_plan_is_the_whole_one_at_what_is_left_free(
    seed: int, goal: Goal, of_each_knot: bool
) -> None:
    rng, formulation = random_formulation(seed)
    limits = [make(formulation.response.grasp) for make in LIMITS.values()]
    v = rng.normal(size=(KNOTS, formulation.n_v))
    basis = free(rng, max(formulation.n_v - 1 - seed % 2, 1), formulation.n_v, of_each_knot)
    left = formulation.around(v, basis)
    whole, part = build(formulation, limits, goal), build(left, limits, goal)
    some, other = (rng.normal(size=len(part.q)) for _ in range(2))

    def of_whole(x: np.ndarray) -> np.ndarray:
        scalar = x[-1:] if goal.objective(formulation).epigraph is not None else []
        return np.append(v + part.unknowns(x), scalar)

    assert part.A.shape[1] == left.unknowns + len(whole.q) % formulation.n_v
    assert part.unknowns(some).ravel() == pytest.approx(basis @ some[: left.unknowns])
    slack, expected = part.b - part.A @ some, whole.b - whole.A @ of_whole(some)
    np.testing.assert_allclose(slack, expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max())
    size = 1.0 if goal.objective(formulation).epigraph is not None else left.divisor
    assert left.divisor == (1.0 if of_each_knot else pytest.approx(KNOTS ** (1 / 3)))
    difference = size * (part.objective(some) - part.objective(other))  # the constant part drops out
    terms = abs(whole.objective(of_whole(some))) + abs(whole.objective(of_whole(other)))
    assert difference == pytest.approx(
        whole.objective(of_whole(some)) - whole.objective(of_whole(other)), rel=1e-9, abs=1e-11 * terms
    )
    again = part.solution(part.unknowns(some), float(some[-1]) if len(whole.q) % formulation.n_v else None)
    np.testing.assert_allclose(again, some, atol=1e-10)


def free(rng: np.random.Generator, count: int, n_v: int, of_each_knot: bool) -> sparse.csc_matrix:
    """Orthogonal changes of a plan: some at every knot, or these and some of all knots at once."""
    directions = np.linalg.qr(rng.normal(size=(n_v, n_v)))[0][:, :count]
    if of_each_knot:
        return sparse.csc_matrix(sparse.kron(sparse.eye_array(KNOTS), directions))
    time = np.linalg.qr(rng.normal(size=(KNOTS, 2)))[0]
    every, one = sparse.eye_array(KNOTS), sparse.csr_array(3 * time)
    parts = sparse.kron(every, directions[:, 1:]), sparse.kron(one, directions[:, :1])
    return sparse.csc_matrix(sparse.hstack(parts))


def test_a_box_of_what_is_left_holds_every_plan_in_the_box_of_the_knots() -> None:
    rng, formulation = random_formulation(1)
    limits = [LIMITS[name](formulation.response.grasp) for name in ("friction", "normal", "reference")]
    time = np.column_stack([np.ones(KNOTS), [-1.0, -0.2, 0.2, 1.0]])
    basis = sparse.csc_matrix(sparse.kron(sparse.csr_array(time), np.eye(formulation.n_v)))
    left = formulation.around(np.zeros((KNOTS, formulation.n_v)), basis)
    whole, part = build(formulation, limits, LeastEffort()), build(left, limits, LeastEffort())
    box = whole.unknowns(whole.variable_bounds)
    for _ in range(200):
        x = rng.normal(size=len(part.q))
        x /= np.abs(part.unknowns(x) / box).max()  # at the edge of the box
        assert np.all(np.abs(x) <= part.variable_bounds * (1 + 1e-9))


def test_a_saved_program_keeps_its_basis(tmp_path: Path) -> None:
    rng, formulation = random_formulation(1)
    left = formulation.around(np.zeros((KNOTS, formulation.n_v)), free(rng, 2, formulation.n_v, of_each_knot=False))
    part = build(left, [LIMITS["friction"](formulation.response.grasp)], LeastEffort())
    part.save(tmp_path / "program.npz")
    again, x = Program.load(tmp_path / "program.npz"), rng.normal(size=len(part.q))
    assert again.objective(x) == part.objective(x)
    np.testing.assert_array_equal(again.unknowns(x), part.unknowns(x))


def test_bounds_in_units_that_make_squares_overflow_are_found_without_a_warning() -> None:
    rotated = np.array([[3.0, 4.0], [-4.0, 3.0]]) / 5
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = _implied(Affine(1e180 * rotated, np.zeros((1, 2))), np.array([2.0, 1.0]))
    assert found == pytest.approx(np.array([10.0, 11.0]) / 5 * 1e-180, rel=1e-9)
