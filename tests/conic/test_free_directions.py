"""What earlier goals leave open of a formulation: the same program, written in fewer unknowns."""

from __future__ import annotations

import numpy as np
import pytest
from random_formulations import KNOTS, LIMITS, random_formulation

from synergrip.conic.build import build
from synergrip.conic.goals.goal import Goal
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.goals.least_motion import LeastMotion
from synergrip.conic.goals.least_peak import LeastPeak
from synergrip.conic.goals.least_reconfiguration import LeastReconfiguration
from synergrip.conic.goals.weighted_sum import WeightedSum
from synergrip.linalg import frozen

GOALS: tuple[Goal, ...] = (
    LargestMargin(), LeastPeak(), LeastEffort(), LeastEffort("torque"), LeastMotion(), LeastMotion("rates"),
    LeastMotion("accelerations"), LeastReconfiguration(),
    WeightedSum(((LeastEffort(), 2.0), (LeastMotion("accelerations", exact=True), 0.1))),
)  # fmt: skip


@pytest.mark.parametrize("in_time_basis", [False, True])
@pytest.mark.parametrize("goal", GOALS, ids=lambda goal: goal.name)
@pytest.mark.parametrize("seed", range(4))
def test_a_program_around_a_plan_is_the_whole_one_at_what_is_left_free(
    seed: int, goal: Goal, in_time_basis: bool
) -> None:
    rng, formulation = random_formulation(seed)
    limits = [make(formulation.response.grasp) for make in LIMITS.values()]
    v = rng.normal(size=(KNOTS, formulation.n_v))
    directions = np.linalg.qr(rng.normal(size=(formulation.n_v, formulation.n_v)))[0][
        :, : formulation.n_v - 1 - seed % 2
    ]
    time_basis = frozen(rng.normal(size=(KNOTS, 2))) if in_time_basis else None
    left = formulation.around(v, directions, time_basis)
    whole, part = build(formulation, limits, goal), build(left, limits, goal)
    some, other = (rng.normal(size=len(part.q)) for _ in range(2))

    def of_whole(x: np.ndarray) -> np.ndarray:
        scalar = x[-1:] if goal.objective(formulation).epigraph is not None else []
        return np.append(v + part.unknowns(x) @ directions.T, scalar)

    assert part.A.shape[1] == (2 if in_time_basis else KNOTS) * directions.shape[1] + len(whole.q) % formulation.n_v
    slack, expected = part.b - part.A @ some, whole.b - whole.A @ of_whole(some)
    np.testing.assert_allclose(slack, expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max())
    size = 1.0 if goal.objective(formulation).epigraph is not None else left.divisor
    assert left.divisor == (pytest.approx(KNOTS ** (1 / 3)) if in_time_basis else 1.0)
    difference = size * (part.objective(some) - part.objective(other))  # the constant part drops out
    terms = abs(whole.objective(of_whole(some))) + abs(whole.objective(of_whole(other)))
    assert difference == pytest.approx(
        whole.objective(of_whole(some)) - whole.objective(of_whole(other)), rel=1e-9, abs=1e-11 * terms
    )
    np.testing.assert_allclose(part.unknowns(part.solution(part.unknowns(some))), part.unknowns(some), atol=1e-10)


@pytest.mark.parametrize("of", ["rates", "accelerations"])
@pytest.mark.parametrize("seed", range(4))
def test_motions_in_unseen_times_change_nothing_that_is_squared(of: str, seed: int) -> None:
    rng, formulation = random_formulation(seed)
    (squares,) = LeastMotion(of).objective(formulation).squares  # type: ignore[arg-type]
    assert squares.unseen is not None
    assert squares.unseen.shape == (KNOTS, 1 if of == "rates" else 2)
    v, change = rng.normal(size=(KNOTS, formulation.n_v)), rng.normal(size=(squares.unseen.shape[1], formulation.n_v))
    np.testing.assert_allclose(squares.at(v + squares.unseen @ change), squares.at(v), atol=1e-10)
    assert np.linalg.matrix_rank(squares.unseen) == squares.unseen.shape[1]
    other = v + rng.normal(size=(KNOTS, 1)) @ rng.normal(size=(1, formulation.n_v))
    assert np.abs(squares.at(other) - squares.at(v)).max() > 1e-3


def test_a_box_of_time_basis_holds_every_plan_in_the_box_of_the_knots() -> None:
    rng, formulation = random_formulation(1)
    limits = [LIMITS[name](formulation.response.grasp) for name in ("friction", "normal", "reference")]
    time_basis = frozen(np.column_stack([np.ones(KNOTS), np.linspace(-1, 1, KNOTS)]))
    left = formulation.around(np.zeros((KNOTS, formulation.n_v)), np.eye(formulation.n_v), time_basis)
    whole, part = build(formulation, limits, LeastEffort()), build(left, limits, LeastEffort())
    box = whole.unknowns(whole.variable_bounds)
    for _ in range(200):
        coefficients = rng.normal(size=(2, formulation.n_v))
        v = time_basis @ coefficients
        coefficients /= np.abs(v / box).max(axis=0)  # at the edge of the box
        assert np.all(np.abs(coefficients.ravel()) <= part.variable_bounds * (1 + 1e-9))
