"""An extra wrench on the hand that really moves: whether what the linear model withstands is withstood there, too."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.documents.naming import made_by
from synergrip.linalg import Array, frozen
from synergrip.margin.disturbance.withstood import Withstood
from synergrip.planning.executing import Executor
from synergrip.planning.outcome import Plan
from synergrip.planning.walk_so_far import kept_for
from synergrip.values import Value

SHARE = 0.98
"""Of the wrench at which the first contact slips in the linear model."""


@made_by("disturbances(plan).executed")
@dataclass(frozen=True, eq=False, repr=False)
class ExecutedWrench(Value):
    """The references of a plan under an extra wrench, executed.

    Example:
        >>> disturbances(plan).executed.holds  # doctest: +SKIP
        True
    """

    wrench: Array
    """(6,) about B where it starts, axes of N [N, N m]: beside the load at every knot."""
    share: float
    """Of the wrench at which the first contact slips in the linear model."""
    margin: float | None
    """The smallest slip margin [N] of all contacts and knots; None where the hand does not reach them all."""
    contact: str
    time_s: float | None
    holds: bool
    """Whether every contact stays in its friction cone, to the digits of a true plan."""
    why: str = ""
    """Why the hand does not reach all knots."""


def executed_wrench(plan: Plan, slip: Withstood) -> ExecutedWrench | None:
    """Return what becomes of the worst extra wrench on the hand that moves; None where there is no such hand or wrench.

    Args:
        plan: of any task.
        slip: the ball of extra wrenches up to which no contact slips in the linear model.
    """
    if plan.executed is None or slip.wrench is None or not slip.lower > 0:
        return None
    wrench = frozen(SHARE * slip.wrench)
    executor = Executor.of(plan.analysis, plan.task)
    found = executor.run(plan.time, plan.dz_r, frozen(plan.task.wrench + wrench), plan.executed)
    if not found.whole:
        return ExecutedWrench(wrench, SHARE, None, "", None, holds=False, why=found.why)
    margins = found.margins
    k, i = (int(place) for place in np.unravel_index(np.argmin(margins), margins.shape))
    room = kept_for(plan.analysis.response.scale.largest_force(found.states.forces))
    worst = float(margins[k, i])
    return ExecutedWrench(wrench, SHARE, worst, plan.grasp.contacts[i].name, float(plan.time[k]), worst >= -room)
