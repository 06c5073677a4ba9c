"""What is known of random samples of a grasp on a hand, from one walk to the next that asks for more."""

from __future__ import annotations

from dataclasses import dataclass

from synergrip.values import Value

DESIGN = 100
"""Samples that a plan is made with, at most."""

Number = tuple[int, int]
"""Part of the seed, and place of a sample in it."""


@dataclass(frozen=True, eq=False, repr=False)
class Known(Value):
    """Which samples a plan is made with, and how often fresh ones were looked at."""

    numbers: tuple[Number, ...]
    among: int
    """Of how many samples these came nearest to a limit."""
    made_with: int
    """How many samples were looked at to make the plan with, those of looks that did not pass among them."""
    rounds: int = 0
    """How often more was asked for since fresh ones were looked at."""
    looks: int = 0


def first(fresh: int) -> Known:
    """Return the samples that a plan is made with: as many as the fresh ones that judge it, up to a number."""
    count = min(fresh, DESIGN)
    return Known(tuple((0, number) for number in range(count)), count, count)


def unseen(looks: int = 0) -> Known:
    """Return that a walk was made with no samples, after looks at fresh ones that others had."""
    return Known((), 1, 0, looks=looks)
