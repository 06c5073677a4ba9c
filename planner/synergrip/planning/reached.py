"""How far a motion got that was not followed to its end."""

from __future__ import annotations

from dataclasses import dataclass

from synergrip.linalg import Array
from synergrip.values import Value


@dataclass(frozen=True, eq=False, repr=False)
class Reached(Value):
    """How far a motion got that was not followed to its end."""

    until_s: float
    pose: Array
    """(6,) displacement of the object there: translation and rotation vector [m, rad]."""
    because: str
    off_m: float | None = None
    """By how much the object is off the wanted motion at most [m]; None where that is not gone through to its end, or
    where a joint at the end of its range is why."""
