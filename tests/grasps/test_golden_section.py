"""The smallest value of functions whose smallest value is known."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from synergrip.grasps.golden_section import lowest


@pytest.mark.parametrize(
    ("function", "lower", "upper", "place", "value"),
    [
        (lambda x: (x - 0.3) ** 2 + 1, 0.0, 1.0, 0.3, 1.0),
        (lambda x: abs(x - math.pi), 0.0, 10.0, math.pi, 0.0),
        (lambda x: max(-2 * x, 0.1 * x - 0.5, -0.2), -3.0, 5.0, None, -0.2),  # flat at its lowest
        (lambda x: x, -1.0, 2.0, -1.0, -1.0),
        (lambda x: -x, -1.0, 2.0, 2.0, -2.0),
        (lambda x: 5.0, 1.0, 1.0, 1.0, 5.0),
    ],
)
def test_the_lowest_place_is_found(
    function: Callable[[float], float], lower: float, upper: float, place: float | None, value: float
) -> None:
    found, least = lowest(function, lower, upper)
    assert least == pytest.approx(value, abs=1e-11)
    assert least == function(found)
    assert lower <= found <= upper
    if place is not None:
        assert found == pytest.approx(place, abs=1e-7)


def test_a_kink_is_found_to_the_last_digits() -> None:
    for place in (0.0, 1e-6, 0.123456789, 0.999999, 1.0):
        assert lowest(lambda x, at=place: abs(x - at), 0.0, 1.0)[0] == pytest.approx(place, abs=1e-12)  # type: ignore[misc]
