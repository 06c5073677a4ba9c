"""What is known of random samples of a grasp on a hand, from one walk to the next that asks for more."""

from __future__ import annotations

from dataclasses import dataclass

from synergrip.values import Value

DESIGN = 100
"""Samples that a plan is made with."""

Number = tuple[int, int]
"""Part of the seed, and place of a sample in it."""


@dataclass(frozen=True, eq=False, repr=False)
class Known(Value):
    """Which samples a plan is made with, and how often fresh ones were looked at."""

    numbers: tuple[Number, ...] = tuple((0, number) for number in range(DESIGN))
    among: int = DESIGN
    """Of how many samples these came nearest to a limit."""
    rounds: int = 0
    """How often more was asked for since fresh ones were looked at."""
    looks: int = 0
    made_with: int = DESIGN
    """How many samples were looked at to make the plan with, those of looks that did not pass among them."""


def unseen(looks: int = 0) -> Known:
    """Return that a walk was made with no samples, after looks at fresh ones that others had."""
    return Known((), looks=looks, made_with=0)
