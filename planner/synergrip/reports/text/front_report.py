"""The Pareto front of slip margin and peak force, as a table and as a document."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from synergrip.hands.units import torque_unit
from synergrip.margin.front import FrontPoint
from synergrip.problems.problem import Problem
from synergrip.reports.text.tables import table
from synergrip.reports.text.text_problem import problem_lines


def front_text(problem: Problem, points: Sequence[FrontPoint], interrupted: bool) -> str:
    """Return one line for each point: margin, least peak force, and the largest joint torque that goes with it."""
    header = ("slip margin", "least peak normal force", "largest joint torque")
    unit = torque_unit([joint.kind for joint in problem.held.hand.joints] if problem.held else [])
    torques = [f"{np.abs(point.plan.motion.torques).max():.4g} {unit}".rstrip() for point in points]
    rows = [
        (f"{point.margin:.4g} N", f"{point.peak:.4g} N", torque) for point, torque in zip(points, torques, strict=True)
    ]
    asked = "front    least peak normal force for each margin, then least effort; the problem's own goals play no part"
    lines = [*problem_lines(problem), asked, "", table(header, rows, right=(0, 1, 2))]
    return "\n".join(lines + (["interrupted; these points are finished"] if interrupted else []))


def front_document(points: Sequence[FrontPoint], interrupted: bool) -> dict[str, Any]:
    """Return the points with the references of each plan."""
    entries = [
        {"margin_N": point.margin, "peak_normal_N": point.peak, "dz_r": point.plan.motion.dz_r.tolist()}
        for point in points
    ]
    return {"verdict": "feasible", "front": entries, "interrupted": interrupted}
