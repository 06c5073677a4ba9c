"""What plans withstand and how good grasps are, judged by second models.

    python tests/judged_disturbances.py 500 [first seed]

Plans on random grasps given as matrices, with half of the largest margin. The passive ball and a box must be those of
a second model (`second_disturbances.py`, in cvxpy), within all limits and of the friction cones alone; no wrench in
10,000 directions inside the balls leaves a cone; of 3 directions in the active ball internal forces answer, and to the
wrench at its end, 0.1 % larger, none do. Random grasps of four hard fingers must have the epsilon of a hull
of pyramids made here. Counts plans, grasps and what is wrong; tells the worst differences and how tight balls are.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))

from random_grasps import random_grasp
from scipy.spatial import ConvexHull
from second_disturbances import SecondModel, some_question
from second_wrench_space import EDGES, edge_wrenches

from synergrip.margin.disturbance.disturbances import Disturbances, disturbances
from synergrip.margin.wrench_space.quality import wrench_space_quality
from synergrip.planning.outcome import Plan

SAME = 1e-4
"""Relative difference from the second model."""
WIDTHS = np.array([1.0, 0.5, 0.8, 0.02, 0.01, 0.03])


def differences(plan: Plan, found: Disturbances) -> Iterator[tuple[str, float]]:
    """Yield the relative differences of balls and boxes from the second model."""
    unit = 1e-2 * plan.formulation.force_unit
    for name, alone in (("passive", False), ("slip", True)):
        model = SecondModel(plan, cones_alone=alone)
        pairs = ((getattr(found, name), model.radius()), (getattr(found.box, name), model.factor(WIDTHS)))
        for which, (own, other) in zip(("ball", "box"), pairs, strict=True):
            assert own.upper is not None
            yield f"{name} {which}", abs(own.upper - other) / max(other, unit)


def wrong_of(plan: Plan, found: Disturbances, rng: np.random.Generator) -> Iterator[str]:
    """Yield what sampled wrenches have against the balls."""
    units = rng.normal(size=(10_000, 6))
    units /= np.linalg.norm(units, axis=1)[:, None]
    unit = plan.formulation.force_unit
    for name, alone in (("passive", False), ("slip", True)):
        if SecondModel(plan, cones_alone=alone).worst(getattr(found, name).lower * units) > 1e-6 * unit:
            yield f"{name}: a wrench inside leaves a cone"
    model, active = SecondModel(plan), found.active
    if not all(model.has_answer(active.lower * direction, 1e-5 * unit) for direction in units[:3]):
        yield "active: no answer inside"
    if active.upper is not None and active.wrench is not None:
        if not active.proven:
            yield "active: its end is not proven"
        elif model.has_answer(1.001 * np.linalg.solve(model.unscale, active.wrench)):
            yield "active: an answer outside"


def main(count: int, first: int) -> None:
    """Print what came of many plans and grasps."""
    counted, worst, shares = Counter[str](), dict[str, float](), list[float]()
    for seed in range(first, first + count):
        rng = np.random.default_rng([43, seed])
        plan = next((each for each in (some_question(100 * seed + i) for i in range(100)) if each is not None), None)
        if plan is not None:
            counted["plans"] += 1
            found = disturbances(plan, box=WIDTHS)
            told = list(wrong_of(plan, found, rng))
            for name, difference in differences(plan, found):
                worst[name] = max(worst.get(name, 0.0), difference)
                told += [f"{name}: differs by {difference:.1e}"] * int(difference > SAME)
            shares += [] if found.known_share is None else [found.known_share]
            counted["wrong"] += len(told)
            for each in told:
                print(f"seed {seed}: {each}", flush=True)
        grasp = random_grasp(rng, ["hard"] * 4)
        epsilon = max(-float(ConvexHull(edge_wrenches(grasp, EDGES)).equations[:, -1].max()), 0.0)
        own = wrench_space_quality(grasp, edges=EDGES)
        counted["grasps"] += 1
        counted["with force closure"] += own.epsilon[0] > 0
        if abs(own.epsilon_pyramids[0] - epsilon) > 1e-9 or own.epsilon[1] < epsilon - 1e-9:
            counted["wrong"] += 1
            print(f"seed {seed}: epsilon {own.epsilon_pyramids[0]:.9g}, of a hull {epsilon:.9g}", flush=True)
    print(", ".join(f"{name} {counted[name]}" for name in ("plans", "grasps", "with force closure", "wrong")))
    print("worst differences:", ", ".join(f"{name} {value:.1e}" for name, value in worst.items()))
    if shares:
        tight = np.percentile(shares, [0, 10, 50, 90])
        print(f"active: proven share of the ball, least and percentiles 10, 50, 90: {np.round(tight, 3)}")


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 0)
