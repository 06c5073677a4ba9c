"""Ranks under one policy, and bases that depend on nothing but their subspace."""

from __future__ import annotations

import numpy as np
import pytest

from synergrip.linalg import Decision, canonical, frozen, left_singular, split


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


@pytest.mark.parametrize(("rows", "columns", "rank"), [(4, 6, 4), (4, 6, 2), (6, 4, 4), (6, 4, 3), (3, 3, 1)])
def test_the_space_of_the_largest_singular_values(rows: int, columns: int, rank: int) -> None:
    """Of wide and tall matrices, of full and of less rank, one and many at once."""
    rng = np.random.default_rng(rows + 10 * columns + 100 * rank)
    matrices = rng.normal(size=(5, rows, rank)) @ rng.normal(size=(5, rank, columns))
    values, space = left_singular(matrices, rank)
    assert values.shape == (5, columns)
    expected = np.linalg.svd(matrices, compute_uv=False)
    np.testing.assert_allclose(values[:, : min(rows, columns)], expected, atol=1e-7 * expected.max())
    np.testing.assert_array_equal(values[:, min(rows, columns) :], 0.0)
    for matrix, basis in zip(matrices, space, strict=True):
        assert basis.shape == (rows, rank)
        projector = basis @ np.linalg.pinv(basis)
        np.testing.assert_allclose(projector @ matrix, matrix, atol=1e-9)
    np.testing.assert_allclose(left_singular(matrices[2], rank)[1], space[2], atol=1e-12)
