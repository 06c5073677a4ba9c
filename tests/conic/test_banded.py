"""The interior point for long trajectories: the optimum of Clarabel, the conditions of an optimum, memory, a no."""

from __future__ import annotations

import tracemalloc
from dataclasses import replace

import numpy as np
import pytest
from random_coupled import random_coupled
from scipy import sparse

from synergrip.conic import cone_algebra as cone
from synergrip.conic.certificate import judge_infeasible, judge_optimal
from synergrip.conic.program import Block, Program
from synergrip.conic.rows import Item, Kind
from synergrip.conic.solution import Claim, Settings, Solution
from synergrip.conic.solvers import banded_, by_structure, clarabel_
from synergrip.linalg import Array, frozen

KNOTS = 60


def optimality_errors(program: Program, found: Solution) -> dict[str, float]:
    """The conditions of an optimum, written down anew: cones, dual cones, stationarity, no pull of a slack cone."""
    slack, errors = program.b - program.A @ found.x, dict.fromkeys(("slack", "multiplier", "complementary"), 0.0)
    start = 0
    for block in program.blocks:
        size = block.dim if block.kind is Kind.SECOND_ORDER else 1
        s, z = (each[start : start + block.rows].reshape(-1, size) for each in (slack, found.z))
        for name, each in (("slack", s), ("multiplier", z)):
            outside = np.sqrt((each[:, 1:] ** 2).sum(axis=1)) - each[:, 0]
            errors[name] = max(errors[name], float(outside.max()))
        errors["complementary"] = max(errors["complementary"], float(np.abs((s * z).sum(axis=1)).max()))
        start += block.rows
    gradient = program.P @ found.x + program.q + program.A.T @ found.z
    return errors | {"stationary": float(np.abs(gradient).max())}


@pytest.mark.parametrize("scalar", [False, True], ids=["squares", "scalar"])
@pytest.mark.parametrize("own", [False, True], ids=["alike", "own"])
@pytest.mark.parametrize("n_v", [1, 3, 6])
def test_the_optimum_is_that_of_clarabel_and_keeps_the_conditions(n_v: int, own: bool, scalar: bool) -> None:
    program = random_coupled(10 * n_v + own, KNOTS, n_v, own=own, scalar=scalar)
    found, second = banded_.solve(program, Settings()), clarabel_.solve(program, Settings())
    assert found is not None
    assert found.claim is Claim.OPTIMAL
    assert judge_optimal(program, found.x, found.z).verified
    assert program.objective(found.x) == pytest.approx(program.objective(second.x), abs=1e-7, rel=1e-7)
    errors = optimality_errors(program, found)
    assert max(errors.values()) < 1e-7, errors


def test_a_basis_that_mixes_knots_is_a_border_beside_the_band() -> None:
    """Unknowns that move one knot each, and a course of all knots: the same optimum as with them written out."""
    whole = random_coupled(3, KNOTS, 2, around=0.0)
    rng = np.random.default_rng(0)
    course = np.repeat(np.sin(np.linspace(0, 3, KNOTS)), 2)
    single = sparse.csc_matrix(sparse.kron(sparse.eye_array(KNOTS), np.array([[0.6], [-0.8]])))
    basis = sparse.csc_matrix(sparse.hstack([course[:, None] * [[1.0]], single[:, rng.permutation(KNOTS)]]))
    program = replace(
        whole, P=sparse.csc_matrix(basis.T @ whole.P @ basis), q=frozen(basis.T @ whole.q), basis=basis,
        A=sparse.csc_matrix(whole.A @ basis), box=frozen(np.full(KNOTS + 1, 1e3)),
    )  # fmt: skip
    found, second = banded_.solve(program, Settings()), clarabel_.solve(program, Settings())
    assert found is not None
    assert judge_optimal(program, found.x, found.z).verified
    assert program.objective(found.x) == pytest.approx(program.objective(second.x), abs=1e-7, rel=1e-7)


def test_rows_without_unknowns_change_nothing() -> None:
    program = random_coupled(7, KNOTS, 2)
    block = Block("nothing", Kind.NONNEGATIVE, 1, (Item("one"), Item("two")), 0, KNOTS - 1)
    count = 2 * (KNOTS - 1)
    more = replace(
        program, A=sparse.csc_matrix(sparse.vstack([program.A, sparse.csc_matrix((count, len(program.q)))])),
        b=frozen(np.concatenate([program.b, np.ones(count)])), blocks=(*program.blocks, block),
    )  # fmt: skip
    found, without = banded_.solve(more, Settings()), banded_.solve(program, Settings())
    assert found is not None
    assert without is not None
    assert judge_optimal(more, found.x, found.z).verified
    assert program.objective(found.x) == pytest.approx(program.objective(without.x), rel=1e-8)


@pytest.mark.parametrize("knot", [0, KNOTS // 2])
def test_a_no_is_a_ray_that_proves_it(knot: int) -> None:
    """At one knot a bound and its opposite exclude each other."""
    program = random_coupled(5, KNOTS)
    b = program.b.copy()
    lowest = 8 * KNOTS + 5 * knot
    b[lowest + 5 * KNOTS] = -b[lowest] - 0.5
    impossible = replace(program, b=frozen(b))
    found = banded_.solve(impossible, Settings())
    assert found is not None
    assert found.claim is Claim.INFEASIBLE
    assert judge_infeasible(impossible, found.z).verified


def peak_memory(knots: int) -> int:
    program = random_coupled(0, knots, own=True)
    tracemalloc.start()
    banded_.solve(program, Settings())
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return peak


def test_memory_is_linear_in_knots(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(banded_, "MOST", 2)  # iterations: each frees what it takes
    first, second, third = (peak_memory(knots) for knots in (200, 500, 800))
    assert third - second < 1.1 * (second - first)
    assert third > 1.5 * second


def test_what_does_not_verify_clarabel_solves_and_both_runs_are_told(monkeypatch: pytest.MonkeyPatch) -> None:
    program = random_coupled(1, banded_.KNOTS, 2)
    assert by_structure.solve(program, Settings()).solver == banded_.NAME
    assert by_structure.solve(program, Settings(structured=False)).solver.startswith("Clarabel")
    right = banded_.solve

    def wrong(program: Program, settings: Settings) -> Solution:
        found = right(program, settings)
        assert found is not None
        return replace(found, x=frozen(found.x + 1e-3))

    monkeypatch.setattr(banded_, "solve", wrong)
    found = by_structure.solve(program, Settings())
    assert found.solver.startswith("Clarabel")
    assert found.runs == 2
    assert judge_optimal(program, found.x, found.z).verified
    short = random_coupled(1, banded_.KNOTS - 1, 2)
    assert by_structure.solve(short, Settings()).runs == 1


@pytest.mark.parametrize("size", [2, 3, 4, 6])
def test_the_inverse_square_of_a_scaling(size: int) -> None:
    rng = np.random.default_rng(size)
    tail = rng.normal(size=(5, size - 1))
    v: Array = np.concatenate([np.sqrt(1 + (tail**2).sum(axis=1, keepdims=True)), tail], axis=1)
    beta, x = rng.uniform(0.1, 3, 5), rng.normal(size=(5, size))
    entries = cone.squared_inverse(v, beta)
    for k in range(5):
        inverse = np.zeros((size, size))
        inverse[np.tril_indices(size)] = entries[:, k]
        whole = inverse + np.tril(inverse, -1).T
        twice = cone.scaled(v, beta, cone.scaled(v, beta, x))[k]
        np.testing.assert_allclose(whole @ twice, x[k], rtol=1e-9, atol=1e-9)
