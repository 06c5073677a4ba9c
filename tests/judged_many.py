"""Plans of many tasks at once against one plan after the other: ``python tests/judged_many.py 2000``.

Each grasp (hand-like, contacts of all kinds) gets 50 tasks with random loads and factors of friction; a third of the
grasps come as stacks with a grasp for each task. Prints verdicts that differ, the largest difference of margin or
effort in units of the load, how many were verified, and how many were planned one by one. With ``numba`` by the
compiled kernel.
"""

from __future__ import annotations

import sys
from collections import Counter
from dataclasses import replace

import numpy as np
from random_cone_problems import grasp_like, random_wrenches
from random_tasks import hand_like_grasp

import synergrip as sg
from synergrip.errors import InputError
from synergrip.linalg import frozen
from synergrip.planning.outcome import Outcome
from synergrip.planning.planning import plan_of_start_posture

EACH = 50
KINDS = {"hard": 0.5, "soft": 0.3, "patch": 0.1, "soft-elliptic": 0.1}
FORMS = (["hard"] * 3, ["soft"] * 4, ["hard", "soft", "soft"])


def task_of(rng: np.random.Generator) -> sg.Task:
    """A task with a margin to keep, a random choice of limits, and one of the goals."""
    limits: list[sg.Limit] = [sg.NormalForce(lower=float(rng.choice([0.0, 0.1])), upper=float(rng.uniform(2.0, 12.0)))]
    limits += [sg.JointTorque(float(rng.uniform(0.1, 0.8)))] * (rng.uniform() < 0.8)
    limits += [sg.ActuatorEffort(float(rng.uniform(0.2, 1.0)))] * (rng.uniform() < 0.3)
    limits += [sg.SynergyReference(float(10 ** rng.uniform(-1.3, 0.3)))] * (rng.uniform() < 0.4)
    limits += [sg.SlipMargin(float(rng.uniform(0.0, 0.5)))] * (rng.uniform() < 0.7)
    goals = (sg.LargestMargin(), sg.LargestMargin(), sg.LeastEffort(), sg.LeastEffort("torque"))
    return sg.Task(knots=1, limits=limits, goals=[goals[int(rng.integers(len(goals)))]])


def alone(grasp: sg.Grasp, task: sg.Task, wrench: np.ndarray, friction: float) -> Outcome:
    """The answer by the planner of one task."""
    contacts = tuple(replace(each, kind=each.kind.slippery(friction)) for each in grasp.contacts)
    own = replace(grasp, contacts=contacts)
    return plan_of_start_posture(own, replace(task.timed(own), wrench=frozen(wrench[None]), course=None))


def main() -> None:
    """Print what is wrong, and the figures."""
    count, kernel = int(sys.argv[1]), "numba" if "numba" in sys.argv else "numpy"
    told, worst = Counter[str](), 0.0
    for seed in range(-(-count // EACH)):
        rng = np.random.default_rng(seed)
        task, form = task_of(rng), FORMS[seed % len(FORMS)]
        grasps = [grasp_like(rng, form) for _ in range(EACH)] if seed % 3 == 0 else [hand_like_grasp(rng, KINDS)] * EACH
        wrenches = random_wrenches(rng, EACH) * rng.uniform(0.1, 3.0, (EACH, 1))
        friction_factors = rng.uniform(0.05, 1.5, EACH)
        whose = grasps if seed % 3 == 0 else grasps[0]
        many = sg.plan_many(whose, task, wrenches=wrenches, friction_factors=friction_factors, kernel=kernel)
        told["verified"] += int(many.verified.sum())
        told["one by one"] += int(many.one_by_one.sum())
        for i, (grasp, wrench, friction) in enumerate(zip(grasps, wrenches, friction_factors, strict=True)):
            try:
                one = alone(grasp, task, wrench, friction)
            except InputError as error:
                told[f"error: {error}"] += 1
                continue
            told[f"{one.verdict} by plan"] += 1
            if one.verdict != many.verdicts[i]:
                told["verdicts that differ"] += 1
                print(f"seed {seed}, task {i}: plan says {one.verdict}, plan_many {many.verdicts[i]}", flush=True)
            elif isinstance(one, sg.Plan):
                load = float(np.abs(wrench[:3]).max())
                if one.largest_margin is not None:
                    apart = abs(one.largest_margin - many.largest_margin[i]) / load
                else:
                    goal = task.goals[0]
                    assert isinstance(goal, sg.LeastEffort)
                    scale = one.analysis.response.scale
                    J = np.diag(scale.force) if goal.of == "contact" else grasp.J.T / scale.length
                    ours, theirs = (float(np.linalg.norm(J @ f)) for f in (many.forces[i], one.forces[0]))
                    apart = abs(ours - theirs) / load
                worst = max(worst, apart)
    print("; ".join(f"{number} {what}" for what, number in told.most_common()))
    print(f"largest difference of margin or effort: {worst:.1e} of the load")


if __name__ == "__main__":
    main()
