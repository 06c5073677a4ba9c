"""What the limits on |value| of joints and synergies share."""

from __future__ import annotations

import numpy as np

from synergrip.conic.limits.limit import Usage
from synergrip.conic.rows import Rows, within
from synergrip.conic.situation import Affine
from synergrip.linalg import Array


def symmetric_rows(key: str, items: tuple[str, ...], value: Affine, limit: Array) -> list[Rows]:
    """Return rows ``-limit <= value <= limit`` in units of the limit (m,)."""
    unit = np.where(np.isfinite(limit), limit, 1.0)
    return within(key, items, value, -limit, limit, unit)


def symmetric_usage(title: str, unit: str, items: tuple[str, ...], value: Array, limit: Array, times: Array) -> Usage:
    """Return the usage of ``|value| <= limit``, value (T, m)."""
    scale = np.where(np.isfinite(limit), limit, 1.0)
    return Usage(title, unit, items, value, -limit, limit, scale, times)
