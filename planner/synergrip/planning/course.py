"""How far the object leaves the wanted course between the knots, where references are straight lines."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from synergrip.conic.intersample import Looks
from synergrip.conic.limits.object_error import axis_weights
from synergrip.documents.quantities import in_mm
from synergrip.equilibrium.execution import Execution
from synergrip.linalg import interpolated
from synergrip.planning.between import Between
from synergrip.planning.executing import sag_of
from synergrip.planning.walk import Walker
from synergrip.planning.walk_so_far import Walk
from synergrip.tasks.timed_task import TimedTask

SEEN = 1e-4
"""[m, rotations times the length of the grasp] off the course from which on more knots are advised."""
AIM = 0.5
"""Share of that at which this advice aims."""


def off_course(executed: Execution, looks: Looks, walk: Walk, walker: Walker) -> float:
    """Return how far the object is at most off where it is wanted between the knots, beyond what it is at these [m].

    What the load makes of it is left out: it sags as much with more knots.

    Args:
        executed: the references at the instants that are looked at, all reached.
        looks: these instants.
        walk: the same references at the knots.
        walker: whose task it is.
    """
    task, start = walker.task, walker.start
    if task.target.kind == "hold":
        return 0.0
    seen = axis_weights(task.axes, start.response.scale.length)
    there = executed.left(looks.target) + sag_of(executed.maps, looks.wrench, start)
    at_knots = walk.executed.left(walker.wanted) + sag_of(walk.executed.maps, task.wrench, start)
    beyond = (there - interpolated(looks.times, task.times, at_knots)) @ seen.T
    return float(np.linalg.norm(beyond, axis=1).max(initial=0.0))


def course_notes(between: Between | None, task: TimedTask) -> Iterator[str]:
    """Yield how many knots a plan should have whose object leaves the course by much between these."""
    limit = max(SEEN, task.tolerance)
    if between is None or between.off_course <= limit:
        return
    knots = 1 + math.ceil((len(task.times) - 1) * math.sqrt(between.off_course / (AIM * limit)))
    yield (
        f"between its {len(task.times)} knots the object leaves the wanted course by up to "
        f"{in_mm(between.off_course, 2)}, for references go straight there; task.knots = {knots} would leave about "
        f"{in_mm(AIM * limit, 2)} (an estimate: it falls with the square of the distance of the knots)"
    )
