"""The Pareto fronts of slip margin, or of friction, and peak force, as a table and as a document."""

from __future__ import annotations

from collections.abc import Sequence
from shlex import quote
from typing import Any

import numpy as np

from synergrip.documents.quantities import plain
from synergrip.hands.units import torque_unit
from synergrip.margin.friction_front import FrictionPoint
from synergrip.margin.front import FrontPoint
from synergrip.problems.problem import Problem
from synergrip.reports.text.tables import table
from synergrip.reports.text.text_problem import problem_lines

Points = Sequence[FrontPoint | FrictionPoint]


def front_text(problem: Problem, points: Points, interrupted: bool) -> str:
    """Return one line for each point: margin or friction, least peak force, and the joint torque that goes with it."""
    slippery = any(isinstance(point, FrictionPoint) for point in points)
    unit = torque_unit([joint.kind for joint in problem.held.hand.joints] if problem.held else [])
    rows = [_row(point, unit) for point in points]
    first, last = ("friction", ("with",)) if slippery else ("slip margin", ())
    header = (first, "least peak normal force", "largest joint torque", *last)
    each = "friction" if slippery else "margin"
    asked = f"front    least peak normal force for each {each}, then least effort; the problem's own goals play no part"
    lines = [*problem_lines(problem), asked, "", table(header, rows, right=(0, 1, 2))]
    return "\n".join(lines + (["interrupted; these points are finished"] if interrupted else []))


def _row(point: FrontPoint | FrictionPoint, unit: str) -> tuple[str, ...]:
    torque = f"{plain(np.abs(point.plan.motion.torques).max())} {unit}".rstrip()
    if isinstance(point, FrontPoint):
        return f"{plain(point.margin)} N", f"{plain(point.peak)} N", torque
    return f"{plain(point.scale)} times", f"{plain(point.peak)} N", torque, f"--set {quote(point.setting)}"


def front_document(points: Points, interrupted: bool) -> dict[str, Any]:
    """Return the points with the references of each plan."""
    return {"verdict": "feasible", "front": [_entry(point) for point in points], "interrupted": interrupted}


def _entry(point: FrontPoint | FrictionPoint) -> dict[str, Any]:
    dz_r = point.plan.motion.dz_r.tolist()
    if isinstance(point, FrontPoint):
        return {"margin_N": point.margin, "peak_normal_N": point.peak, "dz_r": dz_r}
    return {"friction_scale": point.scale, "peak_normal_N": point.peak, "set": point.setting, "dz_r": dz_r}
