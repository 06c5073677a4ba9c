"""Numbers of files: read and judged, with advice how a quantity is written where no unit stands."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

from synergrip.documents.documents import LARGEST_NUMBER
from synergrip.documents.quantities import EXAMPLES, UNITS, kind_of, quantity, ratio
from synergrip.documents.validation import shown
from synergrip.errors import InputError

SAME_LENGTH = 1e-15
"""How far from 1 rounding leaves the length of a vector that was divided by it."""


def number(value: object, *, above: float = -math.inf, at_least: float = -math.inf) -> float:
    """Return a finite number of the file; ``true`` and texts are none.

    Raises:
        InputError: no number, not finite, not greater than `above` or less than `at_least`.
    """
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise InputError.at("", f"expected a number, got {shown(value)}{_as_number(value)}")
    if not math.isfinite(value):
        raise InputError.at("", f"{value} is not a finite number")
    return bounded(float(value), shown(value), above=above, at_least=at_least)


def _as_number(value: object) -> str:
    """Return the advice how a text with a number in it is written where no unit stands: in SI, and of the same size."""
    if not isinstance(value, str) or not any(map(str.isdigit, value)):
        return ""
    kind = kind_of(value, tuple(UNITS))
    try:
        size = quantity(value, kind) if kind else ratio(value.strip())
    except InputError:
        return ""
    return f"; there is no unit here, write {size:.12g}"


def number_or(kind: str) -> Callable[[Any], float]:
    """Return the function that reads a quantity of `kind` with its unit, or a plain number in SI."""

    def read(value: object) -> float:
        if not isinstance(value, str):
            return number(value)
        if not any(mark.isdigit() for mark in value):
            raise InputError.at(
                "", f'expected a number, got {shown(value)}; or with a unit, such as "{EXAMPLES[kind]}"'
            )
        return bounded(quantity(value, kind), shown(value))

    return read


def bounded(value: float, text: str, *, above: float = -math.inf, at_least: float = -math.inf) -> float:
    """Return `value`, written as `text`, when it is greater than `above` and not less than `at_least`."""
    if abs(value) > LARGEST_NUMBER:
        raise InputError.at("", f"{text} is too large")
    if not value > above:
        raise InputError.at("", f"must be greater than {above:g}, got {text}")
    if not value >= at_least:
        raise InputError.at("", f"must be at least {at_least:g}, got {text}")
    return value


def unit_vector(direction: Sequence[float]) -> tuple[float, ...]:
    """Return a direction, which is not zero, with length 1; one that has it already stays as it is, to the digit."""
    size = math.hypot(*direction)
    if abs(size - 1.0) <= SAME_LENGTH:
        return tuple(direction)
    return tuple(part / size for part in direction)
