"""Goals of motion reach their optimum whatever the size of the references: against CVXPY in units that suit it.

    python tests/judged_motion_goals.py 500

A random trajectory whose first goal speaks of references has them multiplied by 1e-9 to 1e3 (the synergies divided by
as much). The plan's value of the goal, in the old references, must be that of the CVXPY formulation of the old task to
1e-4, whether the plan says that it is the best; where it says that this was not verified, that is counted.
"""

from __future__ import annotations

import sys
from collections import Counter
from dataclasses import replace
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))

from elastic_grasp import course
from goal_values import goal_value
from named_goals import goals, name_of
from random_trajectories import random_trajectory

from synergrip.conic.limits.actuator_effort import ActuatorEffort
from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.synergy_acceleration import SynergyAcceleration
from synergrip.conic.limits.synergy_rate import SynergyRate
from synergrip.conic.limits.synergy_reference import SynergyReference
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import frozen
from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan
from synergrip.referee.judge import referee
from synergrip.statics.analysis import analyse
from synergrip.tasks.timed_task import TimedTask

GOALS = ("references", "travel", "smooth")
SAME = 1e-4


def smaller(grasp: Grasp, task: TimedTask, factor: float) -> tuple[Grasp, TimedTask]:
    """The same question with references `factor` times as large."""
    changed = replace(grasp, S=frozen(grasp.S / factor), C_z=frozen(grasp.C_z * factor**2))
    return changed, replace(task, limits=tuple(_changed(limit, factor) for limit in task.limits))


def _changed(limit: Limit, factor: float) -> Limit:
    if isinstance(limit, SynergyReference | SynergyRate | SynergyAcceleration):
        return replace(limit, limit=frozen(limit.limit * factor))
    if isinstance(limit, ActuatorEffort):
        return replace(limit, limit=frozen(limit.limit / factor))
    return limit


def judged(seed: int) -> str:
    """What becomes of the task of one seed: "same", "better", "not verified", or what is wrong."""
    rng = np.random.default_rng(10_000 + seed)
    grasp, task = random_trajectory(seed, int(rng.integers(4, 12)))
    task = replace(task, goals=goals(GOALS[seed % len(GOALS)]))
    factor = float(10 ** rng.uniform(-9, 3))
    answer = referee(analyse(grasp), task)
    outcome = plan(*smaller(grasp, task, factor))
    if answer.verdict != "feasible" or answer.dz_r is None:
        return "infeasible" if outcome.verdict == answer.verdict or answer.verdict == "unknown" else (
            f"seed {seed}: {answer.verdict} became {outcome.verdict} at {factor:.0e}"
        )  # fmt: skip
    if not isinstance(outcome, Plan):
        return f"seed {seed}: feasible became {outcome.verdict} at {factor:.0e}"
    goal = name_of(task.goal)
    found, best = (
        goal_value(goal, grasp, task, course(grasp, task.times, dz_r, task.wrench))
        for dz_r in (outcome.motion.dz_r / factor, answer.dz_r)
    )
    nothing = 1e-10 * float((answer.dz_r**2).sum()) / float(np.diff(task.times).min()) ** (2 * GOALS.index(goal))
    if found > best * (1 + SAME) + nothing:
        if any("not verified" in note for note in outcome.notes):
            print("not verified", seed, goal, f"{found / best - 1:.1e}", f"{factor:.0e}")
            return "not verified"
        return f"seed {seed}: {goal} {found / best - 1:.1e} above the optimum at {factor:.0e}"
    return "same"


def main(count: int) -> int:
    """Judge the tasks of seeds 0 to count - 1 and return how many are wrong."""
    kinds = Counter[str]()
    for seed in range(count):
        told = judged(seed)
        if told.startswith("seed"):
            print(told, flush=True)
        kinds["wrong" if told.startswith("seed") else told] += 1
    print(f"{count} motion goals:", dict(kinds))
    return kinds["wrong"]


if __name__ == "__main__":
    sys.exit(bool(main(int(sys.argv[1]))))
