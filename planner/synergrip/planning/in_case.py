"""One case of those that a plan is to hold for, and what the plan uses of its limits there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from synergrip.conic.limits.limit import Usage
from synergrip.documents.in_order import InOrder
from synergrip.documents.naming import made_by
from synergrip.values import Value

ALIKE = 1e-6
"""Share of the smallest margin by which another one is as small."""


@made_by("plan(grasp, task).cases")
@dataclass(frozen=True, eq=False, repr=False)
class InCase(Value):
    """What a plan uses of its limits in one case of those that it is to hold for.

    Example:
        >>> worst = min(answer.cases, key=lambda case: case.margin)  # doctest: +SKIP
        >>> worst.title, worst.margin  # doctest: +SKIP
        ('least friction, mass 0.3 kg', 0.5)
    """

    title: str
    """What it is: "least friction, mass 0.3 kg"; "as stated" for what the task says itself."""
    usages: tuple[Usage, ...]
    """Of the limits that speak of an instant, friction cones first, with the friction of the case."""
    by_maps: bool = False
    """Whether it is not executed, as others of a hand that moves are, but from the maps of the knots: one of many with
    contacts that are off, and none of the worst."""

    def __post_init__(self) -> None:
        """Let limits be found by their names, too."""
        object.__setattr__(self, "usages", InOrder("usages", self.usages, "title"))

    @property
    def margin(self) -> float:
        """The smallest slip margin [N]."""
        return float(self.usages[0].value.min())


def worst_case(cases: Sequence[InCase]) -> InCase:
    """Return the case with the smallest slip margin; the first of those that differ by rounding."""
    least = min(case.margin for case in cases)
    return next(case for case in cases if case.margin <= least + ALIKE * abs(least))
