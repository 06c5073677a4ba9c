"""The arguments of loads and targets judged as the keys of a problem file are, and kept as plain, immutable values."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from synergrip.documents.documents import LARGEST_NUMBER
from synergrip.documents.judging import described, is_number
from synergrip.documents.numbers import unit_vector
from synergrip.errors import one_of, raise_issues
from synergrip.grasps.grasp_judging import Judge
from synergrip.linalg import Array, frozen

Numbers = Sequence[float] | Array
"""What may be given as a vector (m,)."""
Rows = Sequence[Sequence[float]] | Array
"""What may be given as a table (K, m)."""

MOST_TURNS = 2
"""Whole turns of a palm or an object at most; a number that says more is one of degrees."""


class TaskArguments(Judge):
    """Judges the arguments of a load or a target, and returns each as it is kept: plain, immutable values."""

    def real(
        self, name: str, value: Any, *, above: float = -math.inf, at_least: float = -math.inf, unit: str = ""
    ) -> float:
        """Return a finite number; NaN after noting that it is none, or out of bounds."""
        wanted = f" greater than {above:g}" if above > -math.inf else ""
        wanted = f" of at least {at_least:g}" if at_least > -math.inf else wanted
        if not is_number(value) or not above < value <= LARGEST_NUMBER or not max(at_least, -LARGEST_NUMBER) <= value:
            self.refuse(name, f"expected a number{f' in {unit}' if unit else ''}{wanted}, got {described(value)}")
            return math.nan
        return float(value)

    def angle(self, name: str, value: Any) -> float:
        """Return an angle [rad] of at most `MOST_TURNS`; NaN after noting that it is none, or likely in degrees."""
        found = self.real(name, value, unit="rad")
        if abs(found) > MOST_TURNS * 2 * math.pi:
            what = f"more than {MOST_TURNS} turns; degrees are '{found:g} deg' in a file, in code in radians: "
            self.refuse(name, f"{found:g} rad are {what}np.radians(90) = 1.57")
        return found

    def turns(self, name: str, vectors: Array) -> None:
        """Note rotation vectors (K, 3) [rad] of more than `MOST_TURNS`, which are likely in degrees."""
        largest = float(np.linalg.norm(vectors, axis=1).max(initial=0.0))
        if largest > MOST_TURNS * 2 * math.pi:
            what = f"more than {MOST_TURNS} turns; rotation vectors are in radians: np.radians(90) = 1.57"
            self.refuse(name, f"a rotation vector of {largest:g} rad is {what}")

    def vector(self, name: str, value: Any, count: int, what: str) -> tuple[float, ...]:
        """Return a list of finite numbers."""
        return tuple(map(float, self.rows(name, value, (count,), what)))

    def rows(self, name: str, value: Any, shape: tuple[int, ...], what: str) -> Array:
        """Return an array of finite numbers that are not too large."""
        found = self.array(name, value, shape, f": {what}")
        if np.abs(found).max(initial=0.0) > LARGEST_NUMBER:
            self.refuse(name, f"{np.abs(found).max():g} is too large")
        return found

    def width(self, value: Any) -> int:
        """Return the number of columns of a table (K, m) that has any; 1 for what is no table."""
        shape = np.asarray(value, dtype=object).shape
        return int(shape[1]) if len(shape) == 2 and shape[1] else 1

    def direction(self, name: str, value: Any) -> tuple[float, ...]:
        """Return a unit vector from "x", "y", "z" or 3 numbers."""
        if isinstance(value, str):
            if value not in ("x", "y", "z"):
                self.refuse(name, f"{value!r} is not 'x', 'y', 'z' or 3 numbers, axes of the palm")
            return tuple(float(value == axis) for axis in "xyz")
        found = self.vector(name, value, 3, "a direction, axes of the palm; or 'x', 'y', 'z'")
        if not any(found):
            if not self.issues:
                self.refuse(name, "an axis needs a direction; all 3 numbers are 0")
            return found
        return unit_vector(found)

    def word(self, name: str, value: Any, valid: Sequence[str]) -> None:
        """Note a word that is none of the valid ones."""
        if not isinstance(value, str) or value not in valid:
            self.refuse(name, one_of(value, valid))

    def flag(self, name: str, value: Any) -> None:
        """Note what is neither true nor false."""
        if not isinstance(value, bool):
            self.refuse(name, f"expected True or False, got {described(value)}")

    def times(self, name: str, values: Any, apart: float = 0.0) -> Array:
        """Return increasing times (K,) [s], each at least `apart` [s] after the one before."""
        given = np.asarray(values, dtype=object)
        if not given.size:
            self.refuse(name, "expected one or more instants in seconds, got none")
            raise_issues(self.issues)  # whatever goes by the times cannot be judged
        if given.ndim != 1:
            self.refuse(name, f"expected shape (T,): one or more instants in seconds, got {described(values)}")
            raise_issues(self.issues)
        count, before = len(given), len(self.issues)
        found = self.rows(name, values, (count,), "one or more instants in seconds")
        early = (found[1:] <= found[:-1]) | (found[1:] < found[:-1] + apart)
        if len(self.issues) == before and np.any(early):
            k = int(np.argmax(early))
            least = f" by at least {1e6 * apart:.3g} us" if apart else ""
            self.refuse(name, f"times must increase{least}: {found[k + 1]:g} s comes after {found[k]:g} s; sort them")
        return found


def keep(of: object, judge: Judge, **values: object) -> None:
    """Put judged values into the fields of a frozen value, or raise all that is wrong with them.

    Raises:
        InputError: everything that was noted.
    """
    raise_issues(judge.issues)
    for name, value in values.items():
        object.__setattr__(of, name, frozen(value) if isinstance(value, np.ndarray) else value)
