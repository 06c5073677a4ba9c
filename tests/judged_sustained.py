"""How small what joints carry for long may be, judged by a program of its own.

    python tests/judged_sustained.py 200 [first seed]

Random grasps that move an object under loads that change. Of each an independent program (cvxpy, from the maps alone)
finds the least number that bounds the root of the mean square of every joint's torque; 0.01 % more must have a plan,
and 0.01 % less none. Counts the grasps and what is wrong.
"""

from __future__ import annotations

import sys
from collections import Counter
from dataclasses import replace
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))

from planning.test_sustained import moving

import synergrip as sg

APART = 1e-4


def main(count: int, first: int) -> None:
    """Print what came of many grasps."""
    counted: Counter[str] = Counter()
    for seed in range(first, first + count):
        grasp, _, task, least = moving(np.random.default_rng([43, seed]))
        verdicts = [
            sg.plan(grasp, replace(task, limits=(sg.SustainedTorque((1 + side * APART) * least),))).verdict
            for side in (1, -1)
        ]
        counted["grasps"] += 1
        counted["unknown"] += "unknown" in verdicts
        if verdicts[0] == "infeasible" or verdicts[1] == "feasible":
            counted["wrong"] += 1
            print(f"seed {seed}: {verdicts}", flush=True)
    print(", ".join(f"{name} {counted[name]}" for name in ("grasps", "unknown", "wrong")))


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 0)
