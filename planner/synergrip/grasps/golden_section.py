"""The smallest value of a function of one variable that falls, then rises."""

from __future__ import annotations

import math
from collections.abc import Callable

RATIO = (math.sqrt(5.0) - 1) / 2
STEPS = 60
"""Each shrinks the interval by `RATIO`: 3e-13 of it are left."""


def lowest(function: Callable[[float], float], lower: float, upper: float) -> tuple[float, float]:
    """Return where `function` is smallest on an interval, and its value there, by golden-section search.

    Exact to 3e-13 of the interval for a function that falls and then rises, convex ones among them; the ends of
    the interval count.
    """
    a, b = lower, upper
    left, right = b - RATIO * (b - a), a + RATIO * (b - a)
    at_left, at_right = function(left), function(right)
    for _ in range(STEPS):
        if at_left <= at_right:
            b, right, at_right = right, left, at_left
            left = b - RATIO * (b - a)
            at_left = function(left)
        else:
            a, left, at_left = left, right, at_right
            right = a + RATIO * (b - a)
            at_right = function(right)
    places = (lower, upper, left, right)
    values = (function(lower), function(upper), at_left, at_right)
    best = min(range(4), key=lambda i: values[i])
    return places[best], values[best]
