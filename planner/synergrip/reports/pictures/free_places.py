"""Places for short texts, free of what is drawn."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from synergrip.linalg import Array

DIRECTIONS = 24


def free_places(anchors: Array, wanted: Array, lines: Sequence[Array], reach: float) -> Array:
    """Return a place (n, 2) beside each anchor that is far from lines and from the places before it.

    Args:
        anchors: (n, 2) what the texts are about.
        wanted: (n, 2) directions in which they would stand best.
        lines: polylines (., 2) that are drawn.
        reach: how far from its anchor a text stands.
    """
    angles = np.linspace(0.0, 2 * np.pi, DIRECTIONS, endpoint=False)
    around = np.column_stack([np.cos(angles), np.sin(angles)])
    taken = [np.atleast_2d(line) for line in lines] + [anchor[None] for anchor in anchors]
    found: list[Array] = []
    for anchor, direction in zip(anchors, wanted, strict=True):
        length = float(np.linalg.norm(direction))
        leaning = around @ (direction / length) if length > 1e-12 else np.zeros(DIRECTIONS)
        candidates = anchor + reach * around
        room = np.min([distances(candidates, line) for line in [*taken, *(each[None] for each in found)]], axis=0)
        found.append(candidates[int(np.argmax(np.minimum(room, reach) + 0.1 * reach * leaning))])
    return np.array(found).reshape(-1, 2)


def apart(values: Array, least: float) -> Array:
    """Return values (n,) moved as little as it takes to keep a distance between neighbours: pushed apart in pairs."""
    order = np.argsort(values, kind="stable")
    moved = np.array(values, dtype=float)[order]
    for _ in range(100):
        short = np.maximum(least - np.diff(moved), 0.0)
        if short.max(initial=0.0) < 1e-3 * least:
            break
        moved[:-1] -= short / 2
        moved[1:] += short / 2
    found = np.empty_like(moved)
    found[order] = moved
    return found


def distances(points: Array, line: Array) -> Array:
    """Return how far points (n, 2) are from a polyline (m, 2)."""
    if len(line) == 1:
        return np.asarray(np.linalg.norm(points - line[0], axis=1))
    starts, along = line[:-1], np.diff(line, axis=0)
    squares = np.maximum((along**2).sum(axis=1), 1e-300)
    share = np.clip(((points[:, None] - starts) * along).sum(axis=-1) / squares, 0.0, 1.0)
    nearest = starts + share[..., None] * along
    return np.asarray(np.linalg.norm(points[:, None] - nearest, axis=-1).min(axis=1))
