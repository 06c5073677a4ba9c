"""Principal directions against generated data, against the covariance matrix, and against themselves."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import subspace_angles

from synergrip.errors import InputError
from synergrip.hands.synergies.principal import principal_directions

SIZES = st.tuples(st.integers(2, 30), st.integers(1, 8), st.integers(0, 2**32 - 1))


def postures(count, joints, seed, rank=None):
    rng = np.random.default_rng(seed)
    inner = min(joints, count - 1) if rank is None else rank
    return rng.normal(size=(count, inner)) @ rng.normal(size=(inner, joints)) + rng.normal(size=joints)


def test_a_known_subspace_comes_back():
    rng = np.random.default_rng(0)
    directions = np.linalg.qr(rng.normal(size=(7, 3)))[0]
    mean = rng.normal(size=7)
    q = mean + rng.normal(size=(200, 3)) * [3, 2, 1] @ directions.T
    found = principal_directions(q, 3)
    assert found.decision.rank == 3
    assert subspace_angles(found.directions, directions).max() < 1e-12
    assert found.rms < 1e-14
    noisy = principal_directions(q + 1e-6 * rng.normal(size=q.shape), 3)
    assert 1e-7 < subspace_angles(noisy.directions, directions).max() < 1e-5


def test_one_direction_by_hand():
    """(3, 4) t + (1, 2) at t = -1, 0, 1: direction (0.6, 0.8), singular value 5 sqrt 2, standard deviation 5."""
    found = principal_directions(np.array([[-2.0, -2], [1, 2], [4, 6]]), 1)
    np.testing.assert_allclose(found.mean, [1, 2], atol=1e-15)
    np.testing.assert_allclose(found.directions, [[0.6], [0.8]], atol=1e-15)
    np.testing.assert_allclose(found.singular_values, [5 * np.sqrt(2), 0], atol=1e-14)
    np.testing.assert_allclose(found.deviations, [5], rtol=1e-14)
    np.testing.assert_allclose(found.shares, [1, 0], atol=1e-15)


@given(SIZES)
def test_variances_are_the_eigenvalues_of_the_covariance(sizes):
    q = postures(*sizes)
    count = min(q.shape[1], len(q) - 1)
    found = principal_directions(q, count)
    variances = np.sort(np.linalg.eigvalsh(np.atleast_2d(np.cov(q.T))))[::-1]
    np.testing.assert_allclose(found.deviations**2, variances[:count], rtol=1e-7, atol=1e-9 * variances[0])
    shares = np.zeros(len(variances))
    shares[: len(found.shares)] = found.shares
    np.testing.assert_allclose(shares, variances / variances.sum(), atol=1e-9)
    assert found.shares.sum() == pytest.approx(1, abs=1e-12)


@given(SIZES)
def test_directions_are_orthonormal_and_their_largest_entry_is_positive(sizes):
    q = postures(*sizes)
    found = principal_directions(q, min(q.shape[1], len(q) - 1))
    np.testing.assert_allclose(found.directions.T @ found.directions, np.eye(found.directions.shape[1]), atol=1e-12)
    assert np.all(found.directions.max(axis=0) >= np.abs(found.directions).max(axis=0) - 2e-9)


@given(SIZES)
def test_as_many_as_the_rank_reproduce_the_data(sizes):
    q = postures(*sizes)
    found = principal_directions(q, min(q.shape[1], len(q) - 1))
    np.testing.assert_allclose(q - found.mean, (q - found.mean) @ found.directions @ found.directions.T, atol=1e-11)
    assert found.rms < 1e-12


@given(SIZES)
def test_neither_the_order_of_postures_nor_that_of_joints_nor_a_mirror_matters(sizes):
    q = postures(*sizes)
    rng = np.random.default_rng(sizes[2])
    rows, columns = rng.permutation(len(q)), rng.permutation(q.shape[1])
    found = principal_directions(q, 1)
    relative = found.singular_values / found.singular_values[0]
    if len(relative) > 1 and relative[1] > 0.99:
        return  # the first direction is hardly determined
    moved = principal_directions(q[rows][:, columns], 1)
    np.testing.assert_allclose(moved.singular_values, found.singular_values, atol=1e-12 * found.singular_values[0])
    np.testing.assert_allclose(moved.mean, found.mean[columns], atol=1e-13)
    mirrored = principal_directions(-q, 1)
    largest = np.sort(np.abs(found.directions[:, 0]))
    if len(largest) == 1 or largest[-1] - largest[-2] > 1e-8:  # else the first of them is the positive one
        np.testing.assert_allclose(moved.directions, found.directions[columns], atol=1e-10)
        np.testing.assert_allclose(mirrored.directions, found.directions, atol=1e-10)


def test_the_residual_is_what_the_smaller_directions_hold():
    q = postures(50, 6, 3)
    found = principal_directions(q, 2)
    np.testing.assert_allclose(found.residuals @ found.directions, 0, atol=1e-13)
    assert found.rms == pytest.approx(np.sqrt(np.sum(found.singular_values[2:] ** 2) / q.size), rel=1e-12)


def test_directions_of_equal_variance_are_the_canonical_basis_of_their_span():
    """A cross in the plane of joints 1 and 3, turned by any angle, has every direction of that plane alike."""
    for angle in (0.0, 0.4, 1.0):
        turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        cross = np.zeros((6, 4))
        cross[:4, [1, 3]] = np.array([[1, 0], [-1, 0], [0, 1], [0, -1]]) @ turn
        cross[4:, 0] = [0.1, -0.1]
        found = principal_directions(cross, 3)
        np.testing.assert_allclose(found.directions, np.eye(4)[:, [1, 3, 0]], atol=1e-12)
        assert found.alike == ((0, 1),)
        assert principal_directions(cross, 1).alike == ((0, 1),)
    assert principal_directions(postures(20, 4, 1), 3).alike == ()


@pytest.mark.parametrize("offset", [0.0, 1e3])
@pytest.mark.parametrize("rank", [1, 3])
def test_more_synergies_than_the_rank_are_refused_with_the_rank(rank, offset):
    q = postures(30, 5, 7, rank) + offset
    assert principal_directions(q, rank).directions.shape == (5, rank)
    for count in (rank + 1, 0, -1):
        with pytest.raises(InputError, match=f"expected 1 to {rank}, the rank .* got {count}") as caught:
            principal_directions(q, count, "-n")
        assert caught.value.issues[0].key == "-n"


@pytest.mark.parametrize("posture", [[0.0, 0.0], [0.1, 0.7], [1e80, -3e-70]])
def test_postures_that_are_all_the_same_have_rank_0(posture):
    with pytest.raises(InputError, match="all the same"):
        principal_directions(np.tile(posture, (7, 1)), 1)


def test_a_direction_that_hardly_varies_is_flagged():
    clear = np.array([[1.0, 0], [-1, 0], [0, 0.1], [0, -0.1]])
    assert not principal_directions(clear, 2).decision.ambiguous
    assert principal_directions(clear * [1, 1e-6], 2).decision.ambiguous


@pytest.mark.parametrize("size", [1e-150, 1e90])
def test_the_size_of_the_numbers_does_not_matter(size):
    q = postures(20, 4, 5)
    found, scaled = principal_directions(q, 2), principal_directions(size * q, 2)
    np.testing.assert_allclose(scaled.shares, found.shares, atol=1e-12)
    np.testing.assert_allclose(scaled.directions, found.directions, atol=1e-12)
    np.testing.assert_allclose(scaled.deviations, size * found.deviations, rtol=1e-12)
