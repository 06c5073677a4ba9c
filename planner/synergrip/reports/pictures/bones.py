"""The bones of a hand: straight lines between the origins of its links, and out to places on them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from synergrip.linalg import Array, Places

SHORTEST = 1e-6
"""A bone below this is the same point twice [m]."""


def bone_ends(links: Sequence[str], parents: Mapping[str, str], tips: Mapping[int, str]) -> Places:
    """Return the numbers (n, 2) of the points between which the bones of a hand lie.

    Args:
        links: whose origins are the first points.
        parents: link -> the link that carries it.
        tips: number of each further point to which a bone leads -> the link that it is on.
    """
    number = {link: i for i, link in enumerate(links)}
    between = [(number[above], number[link]) for link, above in parents.items()]
    out = [(number[link], point) for point, link in tips.items()]
    return np.array([*between, *out], dtype=np.intp).reshape(-1, 2)


def bones_between(points: Array, ends: Places) -> Array:
    """Return the bones (..., n, 2, 3) [m] between points (..., k, 3), without those that have no length anywhere."""
    bones = points[..., ends, :]
    lengths = np.linalg.norm(bones[..., 1, :] - bones[..., 0, :], axis=-1)
    long = lengths.reshape(-1, len(ends)).max(axis=0) > SHORTEST
    return np.asarray(bones[..., long, :, :])
