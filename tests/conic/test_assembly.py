"""Tiles stacked into a sparse matrix, against the dense matrix that their definition gives entry by entry."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from synergrip.conic.assembly import Tile, stacked
from synergrip.conic.rows import Earlier

Array = NDArray[np.float64]


def dense(tiles: list[Tile], knots: int, n_v: int, extra: int) -> Array:
    """Write every copy of every tile where it belongs."""
    blocks = []
    for tile in tiles:
        for copy in range(tile.count):
            knot = knots - tile.count + copy
            rows = np.zeros((len(tile.matrix), knots * n_v + extra))
            rows[:, knot * n_v : (knot + 1) * n_v] += tile.matrix
            for part in tile.earlier:
                start = (knot - part.lag) * n_v
                rows[:, start : start + n_v] += part.weights[copy] * part.matrix
            if extra:
                rows[:, -1] = tile.scalar
            blocks.append(rows)
    return np.vstack(blocks)


def random_tile(rng: np.random.Generator, knots: int, n_v: int, extra: int) -> Tile:
    """Return one whose own knot speaks by its matrix, or, weighted, as the earlier knot of lag 0."""
    height, lags, weighted = int(rng.integers(1, 5)), int(rng.integers(0, 3)), rng.random() < 0.3
    sparse_matrix = rng.normal(size=(height, n_v)) * (rng.random((height, n_v)) < 0.7) * (not weighted)
    earlier = tuple(
        Earlier(lag, rng.normal(size=(height, n_v)) * (rng.random((height, n_v)) < 0.7), rng.normal(size=knots - lags))
        for lag in rng.permutation(np.arange(0 if weighted else 1, lags + 1))
    )
    scalar = rng.normal(size=height) * (rng.random(height) < 0.5) * extra
    return Tile(sparse_matrix, earlier, scalar, knots - lags)


@pytest.mark.parametrize("seed", range(40))
def test_stacked_tiles_are_what_they_are_entry_by_entry(seed: int) -> None:
    rng = np.random.default_rng(seed)
    knots, n_v, extra = int(rng.integers(3, 8)), int(rng.integers(1, 4)), int(rng.integers(0, 2))
    tiles = [random_tile(rng, knots, n_v, extra) for _ in range(rng.integers(1, 5))]
    found = stacked(tiles, knots, n_v, extra)
    assert np.array_equal(found.toarray(), dense(tiles, knots, n_v, extra))
    assert np.all(found.data != 0)
    assert found.has_canonical_format
    assert found.indices.dtype == np.int32


def test_what_rounding_left_of_zeros_is_dropped_and_small_entries_are_kept() -> None:
    tile = Tile(np.array([[1.0, 2e-16], [1e-14, 1.0], [1e-30, 1e-30]]), (), np.zeros(3), 2)
    found = stacked([tile], 2, 2, 0)
    assert np.array_equal(found.toarray()[:3, :2], [[1.0, 0.0], [1e-14, 1.0], [1e-30, 1e-30]])


def test_nothing_stacked_is_an_empty_matrix() -> None:
    assert stacked([], 3, 2, 1).shape == (0, 7)
