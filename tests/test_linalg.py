"""Ranks under one policy, and bases that depend on nothing but their subspace."""

from __future__ import annotations

import numpy as np
import pytest

from synergrip.linalg import (
    Decision,
    Decisions,
    canonical,
    decided,
    frozen,
    left_singular,
    null_spaces,
    right_singular,
    singular_values,
    split,
)


@pytest.mark.parametrize("seed", range(20))
def test_a_canonical_basis_depends_on_the_subspace_alone(seed: int) -> None:
    rng = np.random.default_rng(seed)
    basis = rng.normal(size=(8, 3))
    mixed = basis @ rng.normal(size=(3, 3))
    one, two = canonical(basis), canonical(mixed)
    assert np.allclose(one, two, atol=1e-9)
    assert np.allclose(one.T @ one, np.eye(3), atol=1e-12)
    assert np.allclose(one @ (one.T @ basis), basis, atol=1e-12)
    assert np.all(one[np.abs(one).argmax(axis=0), range(3)] > 0)


def test_a_subspace_of_axes_comes_back_as_the_axes() -> None:
    rng = np.random.default_rng(1)
    axes = np.eye(6)[:, [4, 1]] @ rng.normal(size=(2, 2))
    assert np.allclose(canonical(axes), np.eye(6)[:, [1, 4]], atol=1e-12)


def test_an_empty_basis_stays_empty() -> None:
    assert canonical(np.zeros((5, 0))).shape == (5, 0)


@pytest.mark.parametrize(
    ("values", "rank", "ambiguous"),
    [([1, 0.5], 2, False), ([1, 1e-4], 2, False), ([1, 1e-7], 2, True), ([1, 1e-9], 1, True), ([1, 1e-13], 1, False)],
)
def test_the_grey_zone_is_flagged(values: list[float], rank: int, ambiguous: bool) -> None:
    for unit in (1.0, 1e6, 1e-6):
        decision = Decision.of(unit * np.array(values), unit)
        assert (decision.rank, decision.ambiguous) == (rank, ambiguous)


def test_nothing_at_all_has_rank_zero() -> None:
    assert Decision.of(np.array([0.0, 0.0]), 0.0).rank == 0
    assert split(np.zeros((0, 3))).null_space.shape == (3, 3)


@pytest.mark.parametrize("shape", [(3, 5), (5, 3), (4, 4)])
def test_row_space_and_null_space_split_the_domain(shape: tuple[int, int]) -> None:
    rng = np.random.default_rng(2)
    matrix = rng.normal(size=(shape[0], 2)) @ rng.normal(size=(2, shape[1]))
    found = split(matrix)
    both = np.hstack([found.row_space, found.null_space])
    assert found.decision.rank == 2
    assert np.allclose(both.T @ both, np.eye(shape[1]), atol=1e-12)
    assert np.abs(matrix @ found.null_space).max() < 1e-12


def test_frozen_arrays_cannot_be_changed() -> None:
    array = frozen([1.0, 2.0])
    with pytest.raises(ValueError, match="read-only"):
        array[0] = 3.0


def stack_of(rng: np.random.Generator, shape: tuple[int, int]) -> np.ndarray:
    """Matrices of every rank, and with small singular values of every size."""
    least = min(shape)
    left, right = (np.linalg.qr(rng.normal(size=(30, side, side)))[0][..., :least] for side in shape)
    values = np.sort(10.0 ** rng.uniform(-1, 1, (30, least)))[:, ::-1].copy()
    values[5:25, -1] *= np.geomspace(1, 1e-14, 20)
    values[25:, rng.integers(0, least) :] = 0.0
    return np.asarray((left * values[:, None]) @ right.mT)


@pytest.mark.parametrize("shape", [(9, 4), (4, 4), (3, 5), (6, 1)])
def test_singular_values_of_a_stack_are_those_of_each(shape: tuple[int, int]) -> None:
    stack = stack_of(np.random.default_rng(7), shape)
    true = np.array([np.pad(np.linalg.svd(matrix)[1], (0, max(shape[1] - shape[0], 0))) for matrix in stack])
    size = true[:, :1]
    assert np.all(np.abs(singular_values(stack) - true) <= 1e-13 * size)
    values, directions = right_singular(stack, true[:, 0])
    assert np.all(np.abs(values - true) <= 1e-13 * size)
    lengths = np.linalg.norm(stack @ directions, axis=-2)
    small = true < 1e-3 * size  # the directions of small values are told apart from the others
    assert np.all(np.abs(lengths - true)[small] <= 1e-13 * np.broadcast_to(size, true.shape)[small])
    assert np.allclose(directions.mT @ directions, np.eye(shape[1]), atol=1e-13)
    decisions = decided(stack)
    for place, matrix in enumerate(stack):
        alone = split(matrix).decision
        assert (decisions.at(place).rank, decisions.at(place).ambiguous) == (alone.rank, alone.ambiguous)
    for rank in range(1, min(shape) + 1):
        values, columns = left_singular(stack, rank)
        assert np.all(np.abs(values - true[:, : min(shape)]) <= 1e-13 * size)
        for place in np.flatnonzero(true[:, rank - 1] > 0.01 * true[:, 0]):
            vectors, own, _ = np.linalg.svd(stack[place])
            if rank == len(own) or own[rank] < 0.5 * own[rank - 1]:  # the space is told apart
                ours, theirs = np.linalg.qr(columns[place])[0], vectors[:, :rank]
                assert np.allclose(ours @ ours.T, theirs @ theirs.T, atol=1e-11)


def test_empty_matrices_have_no_singular_values() -> None:
    assert singular_values(np.zeros((2, 3, 0))).shape == (2, 0)
    values, directions = right_singular(np.zeros((2, 0, 3)), np.ones(2))
    assert np.array_equal(values, np.zeros((2, 3)))
    assert np.array_equal(directions[1], np.eye(3))
    assert left_singular(np.zeros((2, 3, 0)), 0)[1].shape == (2, 3, 0)


def test_canonical_bases_of_a_stack_are_those_of_each() -> None:
    rng = np.random.default_rng(4)
    stack = rng.normal(size=(2, 5, 8, 3))
    stack[0, 1] = np.eye(8)[:, [6, 2, 4]] @ rng.normal(size=(3, 3))  # columns of the projector that tie
    together = canonical(stack)
    assert together.shape == stack.shape
    for place in np.ndindex(2, 5):
        assert np.allclose(together[place], canonical(stack[place]), rtol=0, atol=1e-14)


def test_decisions_of_a_stack_follow_the_policy_of_one() -> None:
    values = np.array([[1, 1e-7, 0], [1, 1e-9, 1e-9], [2, 1, 1], [0, 0, 0]])
    references = np.array([1.0, 1.0, 2.0, 0.0])
    together = Decisions.of(values, references)
    for place, (row, reference) in enumerate(zip(values, references, strict=True)):
        alone, mine = Decision.of(row, float(reference)), together.at(place)
        assert (mine.rank, mine.ambiguous) == (alone.rank, alone.ambiguous)
        assert np.array_equal(mine.singular_values, alone.singular_values)
    assert together.ranks.tolist() == [2, 1, 3, 0]
    assert together.ambiguous.tolist() == [True, True, False, False]


def test_null_spaces_are_those_of_split() -> None:
    rng = np.random.default_rng(3)
    for rows, columns, rank in ((2, 5, 2), (5, 5, 3), (7, 4, 4), (7, 4, 0), (0, 3, 0)):
        stack = rng.normal(size=(6, rows, rank)) @ rng.normal(size=(6, rank, columns))
        found = null_spaces(stack)
        for matrix, directions in zip(stack, found, strict=True):
            space = split(matrix).null_space
            assert directions @ directions.T == pytest.approx(space @ space.T, abs=1e-12)
            assert np.count_nonzero(directions.any(axis=0)) == columns - rank
    few = null_spaces(np.array([np.diag([1e-3, 1e-14])] * 2), np.array([1.0, 1e-13]))
    assert [np.count_nonzero(each.any(axis=0)) for each in few] == [1, 0]
