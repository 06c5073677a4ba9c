"""Ranges of synergy sets: spans, principal angles and shares against closed forms and invariance."""

import math

import numpy as np
import pytest
import scipy.linalg
from hypothesis import given
from hypothesis import strategies as st

from synergrip.errors import InputError
from synergrip.hands.folder import load_hand
from synergrip.hands.synergies.angles import compare
from synergrip.hands.synergies.pairing import pair_of_files, pair_of_hand
from synergrip.hands.synergies.span import span

SEEDS = st.integers(0, 2**32 - 1)
KEYS = ("A", "B", "--first")


def drawn(seed):
    rng = np.random.default_rng(seed)
    n = int(rng.integers(2, 8))
    return rng, *(rng.normal(size=(n, int(rng.integers(1, n + 1)))) for _ in "ab")


# Spans


def test_lengths_singular_values_and_rank_by_hand():
    found = span(np.array([[3.0, 0, 6], [4, 0, 8], [0, 2, 0]]))
    np.testing.assert_allclose(found.norms, [5, 2, 10])
    np.testing.assert_allclose(found.singular_values, [math.sqrt(125), 2, 0], atol=1e-14)
    assert (found.rank, found.repeated, found.orthonormal, found.decision.ambiguous) == (2, 1, False, False)
    np.testing.assert_allclose(found.basis @ found.basis.T, [[0.36, 0.48, 0], [0.48, 0.64, 0], [0, 0, 1]], atol=1e-14)


def test_any_matrix_has_a_span():
    for S, rank in ((np.zeros((3, 2)), 0), (np.ones((1, 4)), 1), (np.eye(4)[:, [0, 0, 2]], 2)):
        found = span(S)
        assert (found.rank, found.repeated) == (rank, S.shape[1] - rank)
        assert found.singular_values.shape == found.norms.shape == (S.shape[1],)
        assert found.basis.shape == (len(S), rank)


@pytest.mark.parametrize(("tilt", "rank", "ambiguous"), [(1e-3, 2, False), (1e-6, 2, True), (1e-13, 1, False)])
def test_columns_that_are_nearly_parallel_are_flagged(tilt, rank, ambiguous):
    found = span(np.array([[1.0, 1], [0, tilt]]))
    assert (found.rank, found.decision.ambiguous) == (rank, ambiguous)


def test_orthonormal_means_both_orthogonal_and_of_length_1():
    turned = np.linalg.qr(np.random.default_rng(0).normal(size=(5, 3)))[0]
    assert span(turned).orthonormal
    assert not span(1.001 * turned).orthonormal
    assert not span(np.array([[1.0, math.sqrt(0.5)], [0, math.sqrt(0.5)]])).orthonormal


# Angles


@pytest.mark.parametrize("angle", [0.0, 1e-9, 0.3, math.pi / 4, math.pi / 2])
def test_two_planes_through_a_line(angle):
    """The planes of (x, y) and of (x, y turned to z): one direction in common, the other at the angle."""
    A = np.eye(4)[:, :2] @ [[1, 2], [3, 4]]
    B = np.array([[1, 0], [0, math.cos(angle)], [0, math.sin(angle)], [0, 0]])
    found = compare(A, B)
    np.testing.assert_allclose(found.angles, [0, angle], atol=1e-15)
    square = math.cos(angle) ** 2
    assert found.second.share == pytest.approx((1 + square) / 2, abs=1e-14)
    np.testing.assert_allclose(found.second.shares, [1, square], atol=1e-14)
    assert found.first.inside is found.second.inside is (angle < 1e-8)


def test_two_planes_of_four_dimensions_turned_twice():
    a, b = 0.2, 1.1
    B = np.array([[math.cos(a), 0], [0, math.cos(b)], [math.sin(a), 0], [0, math.sin(b)]])
    np.testing.assert_allclose(compare(np.eye(4)[:, :2], B).angles, [a, b], atol=1e-15)


@given(SEEDS)
def test_scipy_finds_the_same_angles(seed):
    _, A, B = drawn(seed)
    np.testing.assert_allclose(compare(A, B).angles, scipy.linalg.subspace_angles(A, B)[::-1], atol=1e-7)


@given(SEEDS)
def test_the_cosines_are_the_singular_values_of_the_product_of_bases(seed):
    _, A, B = drawn(seed)
    found = compare(A, B)
    cosines = np.linalg.svd(np.linalg.qr(A)[0].T @ np.linalg.qr(B)[0], compute_uv=False)
    np.testing.assert_allclose(np.cos(found.angles), np.minimum(cosines, 1), atol=1e-7)
    assert found.first.share * A.shape[1] == pytest.approx(np.sum(cosines**2), abs=1e-7)
    assert np.all(np.diff(found.angles) >= 0)


@given(SEEDS)
def test_the_share_of_a_column_is_what_least_squares_reproduces(seed):
    _, A, B = drawn(seed)
    left = A - B @ np.linalg.lstsq(B, A, rcond=None)[0]
    expected = 1 - np.sum(left**2, axis=0) / np.sum(A**2, axis=0)
    np.testing.assert_allclose(compare(A, B).first.shares, expected, atol=1e-7)


@given(SEEDS)
def test_swapping_the_sets_swaps_the_answer(seed):
    _, A, B = drawn(seed)
    one, other = compare(A, B), compare(B, A)
    np.testing.assert_allclose(one.angles, other.angles, atol=1e-9)
    for mine, theirs in ((one.first, other.second), (one.second, other.first)):
        np.testing.assert_allclose(mine.shares, theirs.shares, atol=1e-9)
        assert mine.share == pytest.approx(theirs.share, abs=1e-9)
        assert mine.inside == theirs.inside


@given(SEEDS)
def test_mixing_and_repeating_columns_changes_no_angle(seed):
    rng, A, B = drawn(seed)
    mix = np.linalg.qr(rng.normal(size=(A.shape[1], A.shape[1])))[0] * rng.uniform(0.5, 2, A.shape[1])
    mixed = np.column_stack([A @ mix, A[:, 0], np.zeros(len(A))])
    found, again = compare(A, B), compare(mixed, B)
    np.testing.assert_allclose(again.angles, found.angles, atol=1e-7)
    assert again.first.share == pytest.approx(found.first.share, abs=1e-7)
    np.testing.assert_allclose(again.second.shares, found.second.shares, atol=1e-7)
    assert again.first.span.rank == A.shape[1]
    assert math.isnan(again.first.shares[-1])


def test_a_set_that_moves_nothing_has_no_angles():
    found = compare(np.zeros((3, 2)), np.eye(3)[:, :1])
    assert found.angles.shape == (0,)
    assert np.all(np.isnan(found.first.shares))
    np.testing.assert_array_equal(found.second.shares, [0])
    assert (found.first.inside, found.second.inside, found.second.share) == (True, False, 0)


# Pairs


def test_two_sets_of_a_hand():
    """Closing together is the mean of closing one by one."""
    pair = pair_of_hand(load_hand("barrett"), "motors", "close", None, KEYS)
    found = compare(pair.first.S, pair.second.S)
    np.testing.assert_allclose(found.angles, [0, 0], atol=1e-12)
    assert (found.first.inside, found.second.inside) == (False, True)
    np.testing.assert_allclose(found.first.shares, [1, 1 / 3, 1 / 3, 1 / 3], rtol=1e-12)
    first = pair_of_hand(load_hand("barrett"), "motors", "close", 1, KEYS)
    assert (first.first.synergies, first.second.synergies) == (("spread",), ("spread",))


def write(path, joints, S):
    synergies = [f"s{i}" for i in range(len(S[0]))]
    path.write_text(f"schema = 1\njoints = {joints}\nsynergies = {synergies}\nS = {S}\n", encoding="utf-8")
    return str(path)


def test_two_files_are_matched_by_the_names_of_their_joints(tmp_path):
    a = write(tmp_path / "a.toml", ["x", "y", "z"], [[1, 0], [0, 1], [0, 0]])
    b = write(tmp_path / "b.toml", ["w", "y", "x"], [[3.0], [4.0], [0.0]])
    pair = pair_of_files(a, b, None, KEYS)
    assert (pair.joints, pair.only_first, pair.only_second) == (("x", "y", "z", "w"), ("z",), ("w",))
    found = compare(pair.first.S, pair.second.S)
    np.testing.assert_allclose(found.angles, [math.acos(0.8)])
    np.testing.assert_allclose(found.second.shares, [0.64])
    np.testing.assert_allclose(found.first.shares, [0, 0.64])
    assert pair_of_files(a, b, 1, KEYS).first.synergies == ("s0",)


def test_pairs_that_cannot_be(tmp_path):
    a = write(tmp_path / "a.toml", ["x", "y"], [[1, 0], [0, 1]])
    b = write(tmp_path / "b.toml", ["u", "v"], [[1], [0]])
    hand = load_hand("barrett")
    for call, key, fragment in (
        (lambda: pair_of_files(a, b, None, KEYS), "B", "no joint in common"),
        (lambda: pair_of_files(a, "motors", None, KEYS), "B", "files that end in .toml, got 'motors'"),
        (lambda: pair_of_files(a + "l", b, None, KEYS), "A", "files that end in .toml"),
        (lambda: pair_of_files(a, "none.toml", None, KEYS), "B", "not found"),
        (lambda: pair_of_files(a, a, 3, KEYS), "--first", "expected 1 to 2"),
        (lambda: pair_of_hand(hand, "motrs", "close", None, KEYS), "A", "did you mean 'motors'?"),
        (lambda: pair_of_hand(hand, "motors", "close", 3, KEYS), "--first", "synergies of 'close', got 3"),
        (lambda: pair_of_hand(hand, "motors", a, None, KEYS), "joints[0]", "'x' is not one of"),
    ):
        with pytest.raises(InputError) as caught:
            call()
        assert caught.value.issues[0].key == key
        assert fragment in caught.value.issues[0].message
