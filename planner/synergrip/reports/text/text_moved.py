"""What moves the object without being asked to: the squeeze, and the change of its load."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from synergrip.conic.limits.elastic_motion import ElasticMotion
from synergrip.conic.limits.limit import first_largest
from synergrip.documents.quantities import in_mm
from synergrip.linalg import Array
from synergrip.planning.outcome import Plan
from synergrip.reports.text.tables import wrapped

ROUNDING = 1e-9
"""A motion this small beside the length of the grasp is rounding."""


def moved_lines(plan: Plan) -> Iterator[str]:
    """Yield how far the squeeze moves the object, which a limit on it tells already, and how far it sags."""
    told = []
    if not any(isinstance(limit, ElasticMotion) for limit in plan.task.limits):
        how_far, when = _largest(plan, plan.elastic_motion)
        beyond = "" if plan.task.target.kind == "hold" else ", beyond its rigid motion,"
        told.append(f"the squeeze moves the object{beyond} by {how_far}{when}" if when
                    else "the squeeze does not move the object by itself")  # fmt: skip
    how_far, when = _largest(plan, plan.motion.sag)
    told.append(f"sag since the start, by change of load: {how_far}{when}" if when
                else "no sag since the start")  # fmt: skip
    yield from wrapped("moved    ", "; ".join(told))


def _largest(plan: Plan, motion: Array) -> tuple[str, str]:
    """Return the largest of motions (T, 6) and when it is; nothing where it is rounding."""
    scale = plan.analysis.response.scale
    sizes = np.linalg.norm(scale.twist(motion), axis=1)
    if sizes.max(initial=0.0) < ROUNDING * scale.length:
        return "0 mm", ""
    at = first_largest(sizes[:, None], 1e-6 * float(sizes.max()))[0]
    return in_mm(float(sizes[at])), f" (t = {plan.motion.times[at]:.2f} s)"
