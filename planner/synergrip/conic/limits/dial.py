"""A number of a task that somebody may change: what it is, how far it goes, and what comes of another value."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Generic, Literal, TypeVar

import numpy as np

from synergrip.linalg import Array
from synergrip.values import Value

Cause = Literal[
    "friction", "load", "force_cap", "torque", "effort", "margin", "tolerance", "drift", "rate", "acceleration",
    "duration", "synergy_range", "joint_range", "amplitude", "stiffness", "direction", "count", "restraint", "reach",
    "limit",
]  # fmt: skip
"""What can keep a task from having a plan, in words that stay the same; "limit" is one of somebody's own."""

T = TypeVar("T")
DIGITS = 5
"""Of a value that is told: it is within 1e-4 of the least one."""


@dataclass(frozen=True, eq=False, repr=False)
class Dial(Value, Generic[T]):
    """One number of a limit, a task or a grasp: T with another value of it is had from `turned`.

    Example:
        >>> dial = NormalForce(upper=20.0).dials(grasp)[0]
        >>> dial.cause, dial.value, dial.turned(25.0).upper
        ('force_cap', 20.0, 25.0)
    """

    cause: Cause
    key: str
    """In a problem file; in code what it is an argument of."""
    value: float
    """What it is, in `unit`."""
    unit: str
    """ "N", "N m", "m", "rad", "kg", "s"; empty for a number or a factor."""
    turned: Callable[[float], T]
    """What comes of another value."""
    eased: Literal["up", "down"] = "up"
    """Which way it leaves more room."""
    end: float = np.inf
    """As far as it may go that way."""
    scale: float = 1.0
    """What a change counts against where the value is 0."""
    written: Callable[[float], str] | None = None
    """How another value is written in a problem file; as a number with its unit when None."""
    smooth: bool = True
    """Whether rows of programs may be affine in it, which is then tried; False: it changes their matrices."""
    nested: bool = True
    """Whether a plan stays one with more room; False: there may be plans here and there, and what was tried is all that
    can be told."""

    @property
    def span(self) -> float:
        """What a turn is relative to: the value itself, or the scale where it is 0."""
        return abs(self.value) or self.scale

    @property
    def reach(self) -> float:
        """The largest relative turn toward room."""
        return abs(self.end - self.value) / self.span

    def ahead(self, turn: float) -> float:
        """Return the value after a relative turn toward room."""
        return self.easier(self.value, turn * self.span)

    def easier(self, value: float, by: float) -> float:
        """Return another value moved toward room; away from it where `by` is negative."""
        return value + by if self.eased == "up" else value - by

    def rounded(self, value: float) -> float:
        """Return another value in `DIGITS` digits, rounded toward room."""
        if value == 0:
            return 0.0
        digit = 10.0 ** (math.floor(math.log10(abs(value))) - DIGITS + 1)
        count = (math.ceil if self.eased == "up" else math.floor)(value / digit)
        return float(f"{count * digit:.{DIGITS}g}")

    def set(self, value: float) -> str:
        """Return the argument of ``--set`` that gives it a value."""
        return f"{self.key}={self.written(value) if self.written else quantity(value, self.unit)}"

    def size(self, value: float) -> float:
        """Return how large a change to a value is: ``|ln(to / from)|``, or the share of `scale` where one is 0."""
        if self.value > 0 and value > 0:
            return abs(float(np.log(value / self.value)))
        if self.value > 0:
            return np.inf
        return abs(value - self.value) / self.scale


def quantity(value: float, unit: str) -> str:
    """Return a value as TOML: a number, or a text with its unit."""
    return f'"{value:.10g} {unit}"' if unit else f"{value:.10g}"


def numbers(values: Array) -> str:
    """Return numbers as TOML: one where all are the same, a list where not."""
    return quantity(float(values[0]), "") if np.all(values == values[0]) else json.dumps([_plain(v) for v in values])


def _plain(value: Any) -> float:
    return float(f"{value:.10g}")
