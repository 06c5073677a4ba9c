"""Single changes that make an infeasible task feasible, as far as its proof already knows them."""

from __future__ import annotations

from typing import Any

from synergrip.planning.outcome import Infeasible


def repairs(outcome: Infeasible) -> list[dict[str, Any]]:
    """Return the changes: key, from, to. Only what a verified optimum has shown to be enough is listed."""
    largest = outcome.largest_margin
    if outcome.stage == "magnitude" and largest is not None and largest >= 0:
        return [{"key": "limits.margin", "from_N": outcome.task.margin, "to_N": largest}]
    return []
