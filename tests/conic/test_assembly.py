"""Bands stacked into a sparse matrix, against the dense matrix that their definition gives entry by entry."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from synergrip.conic.assembly import Band, stacked
from synergrip.conic.rows import Earlier

Array = NDArray[np.float64]


def dense(bands: list[Band], knots: int, n_v: int, extra: int) -> Array:
    """Write every copy of every band where it belongs."""
    dense_rows = []
    for band in bands:
        for copy in range(band.count):
            knot = knots - band.count + copy
            rows = np.zeros((len(band.matrix), knots * n_v + extra))
            rows[:, knot * n_v : (knot + 1) * n_v] += band.matrix
            for part in band.earlier:
                start = (knot - part.lag) * n_v
                rows[:, start : start + n_v] += part.weights[copy] * part.matrix
            if extra:
                rows[:, -1] = band.scalar
            dense_rows.append(rows)
    return np.vstack(dense_rows)


def random_band(rng: np.random.Generator, knots: int, n_v: int, extra: int) -> Band:
    """Return one whose own knot speaks by its matrix, or, weighted, as the earlier knot of lag 0."""
    height, lags, weighted = int(rng.integers(1, 5)), int(rng.integers(0, 3)), rng.random() < 0.3
    sparse_matrix = rng.normal(size=(height, n_v)) * (rng.random((height, n_v)) < 0.7) * (not weighted)
    earlier = tuple(
        Earlier(lag, rng.normal(size=(height, n_v)) * (rng.random((height, n_v)) < 0.7), rng.normal(size=knots - lags))
        for lag in rng.permutation(np.arange(0 if weighted else 1, lags + 1))
    )
    scalar = rng.normal(size=height) * (rng.random(height) < 0.5) * extra
    return Band(sparse_matrix, earlier, scalar, knots - lags)


@pytest.mark.parametrize("seed", range(40))
def test_stacked_bands_are_what_they_are_entry_by_entry(seed: int) -> None:
    rng = np.random.default_rng(seed)
    knots, n_v, extra = int(rng.integers(3, 8)), int(rng.integers(1, 4)), int(rng.integers(0, 2))
    bands = [random_band(rng, knots, n_v, extra) for _ in range(rng.integers(1, 5))]
    found = stacked(bands, knots, n_v, extra)
    assert np.array_equal(found.toarray(), dense(bands, knots, n_v, extra))
    assert np.all(found.data != 0)
    assert found.has_canonical_format
    assert found.indices.dtype == np.int32


@pytest.mark.parametrize("seed", range(10))
def test_bands_of_one_knot_are_what_they_are_entry_by_entry(seed: int) -> None:
    rng = np.random.default_rng(seed)
    n_v, extra = int(rng.integers(1, 4)), int(rng.integers(0, 2))
    bands = []
    for height in rng.integers(1, 5, size=3):
        matrix = rng.normal(size=(height, n_v)) * (rng.random((height, n_v)) < 0.7)
        bands.append(Band(matrix, (), rng.normal(size=height) * (rng.random(height) < 0.5) * extra, 1))
    found = stacked(bands, 1, n_v, extra)
    assert np.array_equal(found.toarray(), dense(bands, 1, n_v, extra))
    assert np.all(found.data != 0)
    assert found.has_canonical_format
    assert found.indices.dtype == np.int32
    own = [Band(band.matrix[None], (), band.scalar, 1) for band in bands]  # with one matrix for each knot
    assert np.array_equal(stacked(own, 1, n_v, extra).toarray(), found.toarray())


@pytest.mark.parametrize("knots", [1, 2])
def test_entries_that_are_no_rounding_stay(knots: int) -> None:
    band = Band(np.array([[1.0, 2e-16], [2e-16, 1e-20]]), (), np.zeros(2), knots, exact=True)
    assert np.array_equal(stacked([band], knots, 2, 0).toarray()[:2, :2], band.matrix)


@pytest.mark.parametrize("knots", [1, 2])
def test_what_rounding_left_of_zeros_is_dropped_and_small_entries_are_kept(knots: int) -> None:
    band = Band(np.array([[1.0, 2e-16], [1e-14, 1.0], [1e-30, 1e-30]]), (), np.zeros(3), knots)
    found = stacked([band], knots, 2, 0)
    assert np.array_equal(found.toarray()[:3, :2], [[1.0, 0.0], [1e-14, 1.0], [1e-30, 1e-30]])


def test_nothing_stacked_is_an_empty_matrix() -> None:
    assert stacked([], 3, 2, 1).shape == (0, 7)
