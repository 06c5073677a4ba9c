"""Sensitivities judged by differences of margins that are found anew.

    python tests/judged_sensitivities.py 100 [first seed]

Random grasps given as matrices, with a plan and limits that leave some room around it. Every number of them is altered
by code of its own (`altered_grasps.py`): the largest margin is planned anew, and the worst one under the references
of the plan follows from the response of the altered grasp. Derivatives must be those of central differences to 1e-5;
one-sided ones must be those of one-sided differences. A kink may be nearer than a difference is wide: one of three
widths must agree. Counts them and what is wrong, when interrupted, too.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))

from altered_grasps import altered, largest_margin
from random_tasks import random_task_on_grasp
from too_much import with_plan

from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array
from synergrip.margin.sensitivity.sensitivities import sensitivities_of
from synergrip.margin.sensitivity.sensitivity import LARGEST, Sensitivity
from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan
from synergrip.statics.motion import forward
from synergrip.statics.response import respond
from synergrip.tasks.timed_task import TimedTask

WIDTHS = {LARGEST: (1e-3, 1e-4, 1e-5)}
OTHERS = (2e-4, 2e-5, 2e-6)
"""Widths of differences, in shares, radians or lengths of the grasp."""
CLOSE, ONE_SIDED = (1e-5, 1e-4, 1e-3), 1e-2
"""Relative errors that are allowed: of differences of each width, the narrow ones have less digits; at kinks."""


def worst(made: Plan, grasp: Grasp, task: TimedTask) -> float:
    """The worst slip margin under the references of a plan."""
    forces = forward(respond(grasp), made.time, made.dz_r, task.wrench).forces
    parts = zip(grasp.contacts, grasp.rows, strict=True)
    return float(min(contact.slip_margin(forces[:, rows]).min() for contact, rows in parts))


def anew(made: Plan, by: Sensitivity, change: float) -> float:
    """The margin of a sensitivity after a change of its number [N]; nan where there is none."""
    other = altered(made.grasp, made.task, by, change)
    if other is None:
        return np.nan
    return largest_margin(*other) if by.kind == LARGEST else worst(made, *other)


def differences(margin: Callable[[float], float], width: float) -> tuple[float, float, float]:
    """Central difference of the fourth order, and one-sided ones of the second toward less and more."""
    a, b, c, d, e = (margin(width * k) for k in (-2, -1, 0, 1, 2))
    return (8 * (d - b) - (e - a)) / (12 * width), (3 * c - 4 * b + a) / (2 * width), (4 * d - 3 * c - e) / (2 * width)


def judged(each: Sensitivity, margin: Callable[[float], float], size: float, length: float) -> str:
    """Return that it is right, or what is wrong with a sensitivity; `size` [N] is what forces are measured against."""
    scale = length if each.per == "1 mm" else 1.0
    if each.left is None or each.right is None:
        return "not known"
    told: Array = np.array([each.left, each.right]) / each.step * scale
    said = ""
    for width, close in zip(WIDTHS.get(each.kind, OTHERS), CLOSE, strict=True):
        found = differences(lambda change: margin(change * scale), width)
        if not np.all(np.isfinite(found)):
            return "not found anew"
        if each.differentiable:
            apart = abs(told[0] - found[0]) / max(abs(found[0]), size)
            if apart <= close:
                return "right" if close == CLOSE[0] else "right beside a kink"
            said += f"{told[0]:.9g} is {found[0]:.9g} by differences of {width:g} ({apart:.1e}) "
        else:
            apart = float(np.abs(told - found[1:]).max()) / max(*np.abs(found[1:]), size)
            if apart <= ONE_SIDED:
                return "right one-sided"
            said += f"{told} are {found[1:]} by differences of {width:g} "
    return f"wrong: {said}"


def main(count: int, first: int) -> None:
    """Print what came of many grasps."""
    counted: Counter[str] = Counter()
    try:
        for seed in range(first, first + count):
            judge(seed, counted)
    finally:
        for name, number in sorted(counted.items()):
            print(f"{name} {number}", flush=True)


def judge(seed: int, counted: Counter[str]) -> None:
    """Count what came of one grasp, and print what is wrong."""
    rng = np.random.default_rng([31, seed])
    question = with_plan(rng, "force_cap") if seed % 2 else random_task_on_grasp(rng)
    made = None if question is None else plan(*question)
    if not isinstance(made, Plan):
        return
    counted["grasps"] += 1
    length, size = made.analysis.response.scale.length, 0.1 * float(np.abs(made.forces).max())
    for each in sensitivities_of(made, made.task).each:
        said = judged(each, partial(anew, made, each), size, length)
        wrong = said.startswith("wrong")
        counted[f"{each.kind}: {'wrong' if wrong else said}"] += 1
        if wrong:
            print(f"seed {seed}: {each.kind}, {each.name} of {each.of} {each.direction}: {said}", flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 0)
