"""From the point B to the centroid of the contacts and back, in lanes. Imported only where Numba is there."""

from __future__ import annotations

from typing import Any

from synergrip.batch.lanes import all_of, kept_apart, load, store
from synergrip.batch.lanes_algebra import compiled


@compiled
def about_centroid(w: Any, at: Any) -> None:
    """Write G with moments about the centroid of the contacts."""
    kept_apart()
    for j in range(at.l):
        for i in range(3):
            store(w, at.turned + i * at.l + j, load(w, at.G + i * at.l + j))
            total = load(w, at.G + (3 + i) * at.l + j)
            for k in range(3):
                total = total + load(w, at.motion + 6 * i + 3 + k) * load(w, at.G + k * at.l + j)
            store(w, at.turned + (3 + i) * at.l + j, total)


@compiled
def in_place(w: Any, at: Any) -> None:
    """Turn motions and moments of the maps from the centroid back to B."""
    kept_apart()
    l, z, k = at.l, at.z, at.k  # noqa: E741
    for j in range(k):
        for i in range(3):
            total = load(w, at.maps + (l + i) * k + j)
            for m in range(3):
                total = total + load(w, at.motion + 6 * m + 3 + i) * load(w, at.maps + (l + 3 + m) * k + j)
            store(w, at.maps + (l + i) * k + j, total)
    for i in range(at.n):
        for j in range(3):
            total = load(w, at.maps + i * k + z + j)
            for m in range(3):
                total = total + load(w, at.motion + 6 * m + 3 + j) * load(w, at.maps + i * k + z + 3 + m)
            store(w, at.maps + i * k + z + j, total)
    for i in range(6):
        for j in range(i):
            a, b = at.maps + (l + i) * k + z + j, at.maps + (l + j) * k + z + i
            mean = all_of(0.5) * (load(w, a) + load(w, b))
            store(w, a, mean)
            store(w, b, mean)
