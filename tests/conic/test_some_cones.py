"""Few unknowns and many cones: the rounds end in the optimum, or the ray, of all cones."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy import sparse

from synergrip.conic.certificate import judge_infeasible, judge_optimal
from synergrip.conic.decide import ATTEMPTS, decide
from synergrip.conic.program import Block, Program
from synergrip.conic.rows import Item, Kind
from synergrip.conic.solution import Claim, Settings, Solution
from synergrip.conic.solvers import by_structure, clarabel_, some_cones
from synergrip.linalg import frozen

KNOTS = 1100
ITEMS = (Item("one"), Item("two"))


def courses(seed: int, room: float = 1.0, curved: bool = True) -> Program:
    """Five unknowns, waves that add up, within a band and a disc of radius 1 + room at every knot."""
    rng = np.random.default_rng(seed)
    n, t = 5, np.linspace(0, 1, KNOTS)
    waves = np.array([np.sin((k + 1) * np.pi * t + rng.uniform(0, 6)) for k in range(n)]).T  # (T, n)
    band = np.stack([waves, -waves], axis=1).reshape(-1, n)
    bounds = room * np.repeat(1 + 0.5 * np.cos(9 * t), 2)
    plane = rng.normal(size=(2, n))
    disc = np.zeros((KNOTS, 2, 3, n))
    disc[:, :, 1:] = plane[None, None] * waves[:, None, None, :]
    heads = np.zeros((KNOTS, 2, 3))
    heads[..., 0] = room * np.array([1.0, 2.0])
    wanted = rng.normal(size=n) * 3
    P = sparse.csc_matrix(np.eye(n) if curved else np.zeros((n, n)))
    blocks = (
        Block("band", Kind.NONNEGATIVE, 1, ITEMS, 0, KNOTS),
        Block("disc", Kind.SECOND_ORDER, 3, ITEMS, 0, KNOTS),
    )
    A = sparse.csc_matrix(np.vstack([band, disc.reshape(-1, n)]))
    b = np.concatenate([bounds, heads.ravel()])
    return Program(P, frozen(-wanted), A, frozen(b), blocks, KNOTS, n, frozen(np.full(n, 1e3)))


@pytest.mark.parametrize("seed", range(4))
def test_the_optimum_is_that_of_all_cones(seed: int) -> None:
    program = courses(seed, curved=seed % 2 == 0)
    found = some_cones.solve(program, Settings(), clarabel_.solve)
    whole = clarabel_.solve(program, Settings())
    assert judge_optimal(program, found.x, found.z).verified
    assert program.objective(found.x) == pytest.approx(program.objective(whole.x), abs=1e-7)
    assert "with" in found.status
    assert np.count_nonzero(np.abs(found.z) > 0) < len(program.b) / 5


def test_a_ray_of_some_cones_is_one_of_all() -> None:
    program = courses(0)
    against = replace(program, b=frozen(np.where(np.arange(len(program.b)) == 3, -1e2, program.b)))
    both = replace(against, b=frozen(np.where(np.arange(len(program.b)) == 2, 50.0, against.b)))
    found = some_cones.solve(both, Settings(), clarabel_.solve)
    assert found.claim is Claim.INFEASIBLE
    assert judge_infeasible(both, found.z).verified


def test_what_the_rounds_do_not_solve_is_solved_as_a_whole_and_told() -> None:
    """The first unknown is bounded at one knot only, which is none of the first ones: those leave it unbounded."""
    n = 2
    A = np.zeros((KNOTS, 2, n))
    A[:, 0, 1], A[:, 1, 1] = 1.0, -1.0
    A[13, 0, 0] = 1.0
    blocks = (Block("band", Kind.NONNEGATIVE, 1, ITEMS, 0, KNOTS),)
    program = Program(
        sparse.csc_matrix((n, n)), frozen(np.array([-1.0, -1.0])), sparse.csc_matrix(A.reshape(-1, n)),
        frozen(np.ones(2 * KNOTS)), blocks, KNOTS, n, frozen(np.full(n, 1e3)),
    )  # fmt: skip
    assert some_cones.suits(program)
    assert some_cones.solve(program, Settings(), clarabel_.solve).claim is Claim.NOTHING
    found = by_structure.solve(program, Settings())
    assert judge_optimal(program, found.x, found.z).verified
    assert found.runs == 2
    assert decide("test", program, by_structure.solve).attempts == 2


def test_an_attempt_that_ends_in_the_same_is_not_made() -> None:
    """With a looser tolerance Clarabel stops at the first iterate that keeps it: when none did, it ends as it did."""
    program = courses(1)
    asked: list[Settings] = []

    def stuck(program: Program, settings: Settings) -> Solution:
        asked.append(settings)
        found = clarabel_.solve(program, replace(settings, max_iterations=4))
        return replace(found, claim=Claim.NOTHING)

    decision = decide("test", program, stuck)
    assert asked == [ATTEMPTS[0], *ATTEMPTS[2:]]
    assert decision.attempts == 4
    first, second = (clarabel_.solve(program, replace(each, max_iterations=4)) for each in ATTEMPTS[:2])
    assert np.array_equal(first.x, second.x)
    assert first.closest > ATTEMPTS[1].tolerance
    solved = clarabel_.solve(program, ATTEMPTS[0])
    assert solved.closest <= ATTEMPTS[0].tolerance
