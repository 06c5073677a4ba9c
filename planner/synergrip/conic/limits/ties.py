"""Which of values that are as bad as each other is named: the same one wherever it is told."""

from __future__ import annotations

import numpy as np

from synergrip.linalg import Array

ALIKE = 3e-6
"""Share of a value up to which others are as bad: less than what is shown of it."""
ROUNDING = 1e-6
"""The same as a share of the largest value, or of a scale that is given, for worst ones that are about 0."""
BROKEN = 1e-5
"""Share of its scale by which a limit is broken from which on the very worst is named, which alone may be beyond it."""


def first_worst(badness: Array, shown: Array, least: float = 0.0, *, scale: float | None = None) -> tuple[int, int]:
    """Return knot and item of the worst: of those alike the first item of the earliest knot.

    Optimal plans lie on their limits at many knots at once: neither rounding nor the measure in which it is told may
    choose the one that is named.

    Args:
        badness: (T, m) how bad each value is.
        shown: (T, m) the values, in the unit of the badness.
        least: difference that is none in any case.
        scale: how large values are that count; None is the largest, which says nothing where some divide by about 0.
    """
    sizes = np.abs(shown)
    worst = int(np.argmax(badness))
    size, finite = float(sizes.ravel()[worst]), sizes[np.isfinite(sizes)]
    about = float(finite.max(initial=0.0)) if scale is None else scale
    tie = max(ALIKE * size, ROUNDING * about, least) if np.isfinite(size) else 0.0
    k, i = divmod(int(np.argmax(badness >= badness.ravel()[worst] - tie)), badness.shape[1])
    return k, i


def first_largest(values: Array, tie: float = 1e-6) -> tuple[int, int]:
    """Return row and column of the largest of `values` (T, m); the first of those that differ by less than `tie`."""
    flat = int(np.argmax(values.ravel() > values.max() - tie))
    return flat // values.shape[1], flat % values.shape[1]
