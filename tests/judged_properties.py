"""What textbooks name of random grasps against an implementation from the definitions: how many are said otherwise.

python tests/judged_properties.py 500
"""

from __future__ import annotations

import sys

import numpy as np
from plain_properties import disagreements
from random_grasps import random_grasp


def judged(count: int) -> int:
    """Return how many of so many random grasps the package and the definitions say different things of."""
    wrong = 0
    for seed in range(count):
        grasp = random_grasp(np.random.default_rng([11, seed]), degenerate=seed % 2 == 0)
        if said := disagreements(grasp):
            wrong += 1
            print(f"seed {seed}: {', '.join(said)}")
    return wrong


if __name__ == "__main__":
    cases = int(sys.argv[1]) if len(sys.argv) > 1 else 500
    print(f"{judged(cases)} of {cases} grasps are said otherwise")
