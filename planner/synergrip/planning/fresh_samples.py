"""What random samples say of a plan on a hand that was not made with them."""

from __future__ import annotations

from dataclasses import dataclass

from synergrip.documents.naming import made_by
from synergrip.values import Value


@made_by("plan(grasp, task).fresh")
@dataclass(frozen=True, eq=False, repr=False)
class FreshSamples(Value):
    """What became of samples that a plan was not made with, all executed once at the true equilibria.

    Of any others no larger share than the one that is asked misses a limit, with the confidence that is asked, where
    `share` is no larger than that.
    """

    count: int
    missing: int
    """How many of them miss a limit."""
    allowed: int
    """How many of them may, which was decided before they were drawn."""
    share: float
    """Of all samples that miss, at most, with the confidence of one look."""
    asked: float
    """The same as it is asked."""
    looks: int
    """How often fresh samples were looked at, with these."""
    instants: int
    """At which of each sample limits were looked at: knots, corners, and some between."""
    made_with: int
    """Other samples that the plan was made with."""
    missed: str = ""
    """What some of them miss, in words."""

    @property
    def said(self) -> str:
        """Why nothing is promised; empty where something is."""
        if self.share <= self.asked:
            return ""
        told = f"of {self.count} fresh scenarios executed at the true equilibrium {self.missing} miss a limit"
        most = f"all that is sure is that no more than {100 * self.share:.3g} % do, and {100 * self.asked:.4g} % may"
        return f"{told}, {self.allowed} may; {most}: {self.missed}"
