"""What each goal measures of a course, by its definition: for tests that compare or perturb plans."""

from __future__ import annotations

import numpy as np
from elastic_grasp import Course, length_of, normal_forces, slip_margins
from named_goals import ranges_of, weights_of

from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array
from synergrip.tasks.timed_task import TimedTask


def goal_value(name: str, grasp: Grasp, task: TimedTask, found: Course, units: tuple[float, float] = (1, 1)) -> float:
    """Return what `name` is to make small: forces in N, references in their own units, times in seconds.

    `units` of force [N] and of references count in a weighted sum only, where time counts in durations of the task.
    """
    length, _ = length_of(grasp)
    h = np.diff(task.times)[:, None]
    rates = np.diff(found.dz_r, axis=0) / h
    span = (h[1:] + h[:-1]) / 2
    if name == "margin":
        return -float(slip_margins(grasp, found.forces).min())
    if name == "peak_force":
        return float(normal_forces(grasp, found.forces).max())
    if name == "weighted":
        return _weighted(grasp, task, found, units)
    if name == "centred":
        ranges = ranges_of(task.goals)
        middle, half = (ranges.lower + ranges.upper) / 2, (ranges.upper - ranges.lower) / 2
        return _squares((ranges.start + found.dq - middle) / half)
    spins = np.array([1 / length if component == "m" else 1.0 for _, component in grasp.components])
    value = {
        "effort": found.forces * spins, "torque": found.torques / length, "actuator": found.efforts / length,
        "references": found.dz_r, "travel": rates * np.sqrt(h), "smooth": np.diff(rates, axis=0) / np.sqrt(span),
        "steady": np.diff(found.forces * spins, axis=0) / np.sqrt(h),
    }  # fmt: skip
    return _squares(value[name])


def _weighted(grasp: Grasp, task: TimedTask, found: Course, units: tuple[float, float]) -> float:
    force, reference = units
    duration, knots = float(task.times[-1] - task.times[0]), len(task.times)
    sizes = {
        "references": reference**-2, "travel": knots * duration / reference**2,
        "smooth": knots * duration**3 / reference**2, "centred": 1.0, "steady": knots * duration / force**2,
    }  # fmt: skip
    parts = [
        weight * sizes.get(name, force**-2) * goal_value(name, grasp, task, found)
        for name, weight in weights_of(task.goals).items()
    ]
    return sum(parts)


def _squares(values: Array) -> float:
    return float((values**2).sum())
