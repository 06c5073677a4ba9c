"""What the limits on sizes share: on |value| of joints and synergies, on the norm of a motion of the object."""

from __future__ import annotations

import numpy as np

from synergrip.conic.formulation import Affine
from synergrip.conic.limits.limit import Usage
from synergrip.conic.rows import Rows, within
from synergrip.linalg import Array, frozen


def symmetric_rows(key: str, items: tuple[str, ...], value: Affine, limit: Array) -> list[Rows]:
    """Return rows ``-limit <= value <= limit`` in units of the limit (m,)."""
    unit = np.where(np.isfinite(limit), limit, 1.0)
    return within(key, items, value, -limit, limit, unit)


def symmetric_usage(title: str, unit: str, items: tuple[str, ...], value: Array, limit: Array, times: Array) -> Usage:
    """Return the usage of ``|value| <= limit``, value (T, m)."""
    scale = np.where(np.isfinite(limit), limit, 1.0)
    return Usage(title, unit, items, value, -limit, limit, scale, times)


def norm_usage(title: str, unit: str, item: str, norm: Array, limit: float, times: Array) -> Usage:
    """Return the usage of ``norm <= limit``, norm (T,)."""
    none, bound = frozen([-np.inf]), frozen([limit])
    return Usage(title, unit, (item,), norm[:, None], none, bound, bound, times)
