"""Caps that do not bind and units that differ change no answer: random tasks, each asked in many ways.

    python tests/judged_units.py 1000

Every task is asked as it is, with a largest normal force of 1, 1e3, 1e6 and 1e9 times the largest that its plan needs,
and with all its forces and motions multiplied by 1e-12 to 1e6. Verdicts must be the same, and margins to 1e-6 of the
largest load or contact force.
"""

from __future__ import annotations

import sys
from collections import Counter
from dataclasses import replace
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))

from random_tasks import random_task_on_grasp

from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import frozen
from synergrip.planning.outcome import Outcome, Plan
from synergrip.planning.planning import plan
from synergrip.tasks.timed_task import TimedTask

CAPS = (1.0, 1e3, 1e6, 1e9)
LOADS = (1e-12, 1e-9, 1e-6, 1e-3, 1e3, 1e6)
SAME = 1e-6
"""Of the load, or of the largest contact force."""


def capped(task: TimedTask, upper: float) -> TimedTask:
    """The task with another largest normal force [N]."""
    rest = [limit for limit in task.limits if not isinstance(limit, NormalForce)]
    lower = max((limit.lower for limit in task.limits if isinstance(limit, NormalForce)), default=0.0)
    return replace(task, limits=(NormalForce(lower, upper), *rest))


def in_units(grasp: Grasp, task: TimedTask, factor: float) -> tuple[Grasp, TimedTask]:
    """The same question with every force and every motion multiplied by a factor."""
    lambda_0 = None if grasp.lambda_0 is None else frozen(factor * grasp.lambda_0)
    wanted = replace(task.target, values=frozen(factor * task.target.values))
    return (
        replace(grasp, lambda_0=lambda_0, w_0=frozen(factor * grasp.w_0)),
        replace(
            task, wrench=frozen(factor * task.wrench), target=wanted, margin=factor * task.margin,
            tolerance=factor * task.tolerance, limits=tuple(_times(limit, factor) for limit in task.limits),
        ),
    )  # fmt: skip


def _times(limit: Limit, factor: float) -> Limit:
    if isinstance(limit, NormalForce):
        return replace(limit, lower=factor * limit.lower, upper=factor * limit.upper)
    return replace(limit, limit=frozen(factor * limit.limit))  # type: ignore[type-var, call-arg, attr-defined]


def ways(grasp: Grasp, task: TimedTask, base: Outcome) -> dict[str, tuple[Grasp, TimedTask, float]]:
    """The same question asked in other ways, each with its factor of forces."""
    found = {f"loads {factor:g}": (*in_units(grasp, task, factor), factor) for factor in LOADS}
    if isinstance(base, Plan):
        peak = float(base.motion.forces[:, grasp.normal_rows].max())
        free = plan(grasp, capped(task, 1e3 * peak))
        if isinstance(free, Plan):
            binding = float(free.motion.forces[:, grasp.normal_rows].max())
            found |= {f"cap {cap:g}": (grasp, capped(task, cap * binding * (1 + 1e-7)), 1.0) for cap in CAPS}
            found["cap, free"] = (grasp, capped(task, 1e3 * peak), 1.0)
    return found


def judged(seed: int) -> list[str]:
    """What differs when the task of a seed is asked in other ways."""
    grasp, task = random_task_on_grasp(np.random.default_rng(seed))
    base, told = plan(grasp, task), []
    asked = ways(grasp, task, base)
    free = asked.pop("cap, free", None)
    uncapped = plan(*free[:2]) if free else base
    for name, (other, changed, factor) in asked.items():
        outcome = plan(other, changed)
        reference = uncapped if name.startswith("cap") else base
        if outcome.verdict != reference.verdict:
            told.append(f"{name}: {reference.verdict} became {outcome.verdict}")
        elif isinstance(outcome, Plan) and isinstance(reference, Plan):
            size = max(reference.formulation.load_size, float(np.abs(reference.motion.forces).max()))
            error = abs(outcome.margins.min() / factor - reference.margins.min()) / size
            if error > SAME:
                told.append(f"{name}: margin off by {error:.1e}")
    return told


def main(count: int) -> int:
    """Judge the tasks of seeds 0 to count - 1 and return how many differ."""
    differ, kinds = 0, Counter[str]()
    for seed in range(count):
        told = judged(seed)
        differ += bool(told)
        kinds.update(each.split(":")[0] for each in told)
        for each in told:
            print(f"seed {seed}: {each}", flush=True)
    print(f"{count} tasks, each in {len(CAPS) + len(LOADS)} ways: {differ} differ", dict(kinds) or "")
    return differ


if __name__ == "__main__":
    sys.exit(bool(main(int(sys.argv[1]))))
