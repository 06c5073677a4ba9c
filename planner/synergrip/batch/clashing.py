"""Which limit clashes most in each of many proofs that there is no plan: read from their multipliers."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from synergrip.conic.conflicts import COUNTS
from synergrip.conic.limits.friction_cone import FRICTION
from synergrip.conic.rows import LOWER_SIDES, Rows
from synergrip.linalg import Array

Row = tuple[str, str, bool]
"""Of a row: the key of its limit, the contact, joint or synergy, and whether it is a lower bound."""
NAMES = "<U40"


def of_cones(count: int) -> tuple[Row, ...]:
    """Return what so many rows of friction cones are of."""
    return ((FRICTION, "", False),) * count


def of_limit(rows: Rows) -> tuple[Row, ...]:
    """Return what rows of a limit at one knot are of."""
    return tuple((rows.limit, item.name, item.side in LOWER_SIDES) for item in rows.items for _ in range(rows.dim))


def clashes(of: Sequence[Row], sizes: Sequence[int], y: Array) -> NDArray[np.str_]:
    """Return (N,) the key of the limit that each of the proofs y (N, m) rests on most beside friction.

    It is "friction cone" where no other plays a part. Multipliers of the two sides of one limit cancel, as in
    `conic.conflicts`.

    Args:
        of: what each of the m rows is of.
        sizes: of the cones, in the order of the rows.
        y: multipliers, in the dual cones.
    """
    starts = np.cumsum((0, *sizes[:-1]))
    norms = np.sqrt(np.add.reduceat(y**2, starts, axis=1))  # (N, cones)
    keys = list(dict.fromkeys(of[start][0] for start in starts))
    items: dict[tuple[str, str], Array] = {}
    carried = np.zeros((len(y), len(keys)))
    for cone, start in enumerate(starts):
        key, name, lower = of[start]
        if key == FRICTION:
            carried[:, keys.index(key)] += norms[:, cone]
        else:
            items[key, name] = items.get((key, name), 0.0) + (-norms[:, cone] if lower else norms[:, cone])
    for (key, _), net in items.items():
        carried[:, keys.index(key)] += np.abs(net)
    others = np.where([key == FRICTION for key in keys], -1.0, carried)
    most = others.argmax(axis=1)
    counts = others[np.arange(len(y)), most] > COUNTS * carried.sum(axis=1)
    return np.where(counts, np.array(keys, dtype=NAMES)[most], FRICTION)
