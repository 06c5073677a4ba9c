"""What is said of limits between the knots."""

from __future__ import annotations

import numpy as np

from synergrip.conic.limits.limit import Usage
from synergrip.reports.text.text_between import to_within


def used(title: str, unit: str, value: float, upper: float) -> Usage:
    return Usage(title, unit, ("a",), np.array([[value]]), np.array([-np.inf]), np.array([upper]), np.ones(1), [0.0])  # type: ignore[arg-type]


def test_what_counts_as_kept_is_told_with_what_it_misses() -> None:
    assert not to_within([used("force", "N", 5.0 + 5e-7, 5.0)])  # rounding
    case = used("force", "N", 5.0 + 2e-3, 5.0)
    missed = [used("force", "N", 5.0 + 1e-3, 5.0), case, used("drift", "m", 3e-6, 0.0), used("turn", "rad", 1e-4, 0.0)]
    assert to_within(missed) == " (force to within 2 mN, drift to within 3 um, turn to within 0.0058 deg)"
