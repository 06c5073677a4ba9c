"""What moves the object without being asked to: the squeeze, and the change of its load; first both together."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from synergrip.conic.limits.elastic_motion import ElasticMotion
from synergrip.conic.limits.object_error import AXES
from synergrip.conic.limits.ties import first_worst
from synergrip.documents.quantities import in_mm
from synergrip.linalg import Array
from synergrip.planning.outcome import Plan
from synergrip.reports.text.tables import wrapped

ROUNDING = 1e-9
"""A motion this small beside the length of the grasp is rounding."""
SHOWN = 1e-6
"""Motions below this [m] are told as within it: the hand that moves is followed no closer."""
CANCELLED = 0.5
"""Share of the larger of two motions below which their sum says that they cancel."""


def moved_lines(plan: Plan, *, details: bool = False) -> Iterator[str]:
    """Yield how far the object moves beyond its rigid motion, and what of it the squeeze and the load do alone.

    Args:
        plan: what is told of.
        details: whether the two are told as well where they cancel.
    """
    rounding = ROUNDING * plan.analysis.response.scale.length
    squeeze, sag = plan.elastic_motion, plan.motion.sag
    parts = [("the squeeze", squeeze), ("change of load (sag)", sag)]
    sizes = {what: _sizes(plan, motion).max(initial=0.0) for what, motion in parts}
    moving = [(what, motion) for what, motion in parts if sizes[what] >= rounding]
    task = plan.task
    hold = task.target.kind == "hold" and task.tracking == "rigid" and len(task.axes) == len(AXES)  # no rigid motion
    if not moving:
        yield from wrapped("moved    ", "neither the squeeze nor a change of load moves the object")
        return
    both = float(_sizes(plan, squeeze + sag).max(initial=0.0))
    cancel = len(moving) > 1 and both < CANCELLED * max(sizes.values())
    if cancel:
        start = "where it starts" if hold else "its rigid motion"
        told = f"the object stays within {in_mm(max(both, SHOWN))} of {start}: the squeeze makes up for the sag"
    else:
        beyond = "" if hold else ", beyond its rigid motion,"
        told = f"the object{beyond} by up to {_largest(plan, squeeze + sag)}"
    if len(moving) == 1:
        told += f", all of it by {moving[0][0]}"
    elif details or not cancel:
        # of a limit on what the squeeze does the table above has a row
        limited = any(isinstance(limit, ElasticMotion) for limit in task.limits)
        alone = moving[1:] if limited else moving
        told += "; " + ", ".join(f"{what} alone {_largest(plan, motion)}" for what, motion in alone)
    yield from wrapped("moved    ", told)


def _largest(plan: Plan, motion: Array) -> str:
    """Return the largest of motions (T, 6) and when it is."""
    sizes = _sizes(plan, motion)
    at = first_worst(sizes[:, None], sizes[:, None])[0]
    return f"{in_mm(float(sizes[at]))} (t = {plan.motion.times[at]:.2f} s)"


def _sizes(plan: Plan, motion: Array) -> Array:
    """Return the sizes (T,) of motions (T, 6), rotations times the length of the grasp [m]."""
    return np.asarray(np.linalg.norm(plan.analysis.response.scale.twist(motion), axis=1))
