"""What slippery contacts cost: the least peak normal force for each friction, down to the least with a plan."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from synergrip.changes.asked import Asked
from synergrip.changes.turning import friction_dial
from synergrip.grasps.grasp import Grasp
from synergrip.margin.direct import Wanted, number_of
from synergrip.margin.front import GOALS
from synergrip.planning.outcome import Outcome, Plan
from synergrip.planning.planning import plan
from synergrip.tasks.task import Task
from synergrip.tasks.timed_task import TimedTask

LEAST_SCALE = 0.1
"""Least factor of the friction where no end of it was found."""


@dataclass(frozen=True)
class FrictionPoint:
    """The least peak normal force of a task whose friction is multiplied by a factor."""

    scale: float
    peak: float  # [N] largest normal force
    plan: Plan
    setting: str
    """The argument of ``--set`` that asks for the friction."""


def least_peak(grasp: Grasp, task: Task | TimedTask) -> Outcome:
    """Return the plan with the least peak normal force, or why there is none; the goals of the task play no part."""
    return plan(grasp, replace(task, goals=GOALS))


def friction_front(best: Plan, task: Task | TimedTask, count: int) -> Iterator[FrictionPoint]:
    """Yield `count` points of the front of friction and peak normal force, by growing friction, up to what it is.

    The factors are those of all contacts, spin friction too, as many times one as the next is of it; the first is the
    least that margins attain, as its peak would be anything below. A point without a verified plan is left out.

    Args:
        best: the plan of `least_peak`.
        task: of which it is.
        count: at least 2.

    Raises:
        KeyboardInterrupt: somebody interrupted; the points before are whole.
    """
    asked = Asked.of(best.grasp, replace(task, goals=GOALS), best.task)
    dial, posed = friction_dial(asked), asked.posed(best.analysis)
    if dial is None or posed is None:
        return
    found = number_of(Wanted("critical_friction_scale", "", dial, "", dial.value), dial, posed, best)
    least = LEAST_SCALE if found.value is None else found.value
    for scale in np.geomspace(least, 1.0, count).tolist():
        value = min(dial.rounded(scale * dial.value), dial.value)
        point = best if value == dial.value else dial.turned(value).outcome()
        if isinstance(point, Plan):
            peak = float(point.motion.forces[:, best.grasp.normal_rows].max())
            yield FrictionPoint(value / dial.value, peak, point, dial.set(value))
