"""What a second thread gains where many tasks are planned: ``threads_of_many.py [TASKS] [RUNS]``.

Wall time of `plan_many` (100,000 tasks) on one thread and on two, in turns, with the compiled kernel where there is
one: one grasp of 4 soft contacts with many loads, and as many grasps. Prints the ratio of each pair of runs, and what
one thread took in processor time: where others keep the cores busy, wall time of two is what is left for them.
"""

from __future__ import annotations

import os
import sys
import time
from importlib.util import find_spec
from pathlib import Path

for _name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_name, "1")

import numpy as np  # noqa: E402 - after the threads

sys.path.insert(0, str(Path(__file__).parent.parent))
from random_cone_problems import grasp_like, random_wrenches  # noqa: E402

import synergrip as sg  # noqa: E402


def main() -> None:
    """Print the ratios."""
    tasks, runs = (int(text) for text in (*sys.argv[1:], *("100000", "3")[len(sys.argv) - 1 :]))
    rng, kernel = np.random.default_rng(0), "numba" if find_spec("numba") else "numpy"
    grasp = grasp_like(rng, ["soft"] * 4, 8)
    stack = sg.GraspStack.varied(grasp, C_s=rng.uniform(0.5, 2.0, (tasks, 1, 1)) * grasp.C_s)
    wrenches = random_wrenches(rng, tasks)
    task = sg.Task(knots=1, limits=[sg.NormalForce(upper=10.0), sg.JointTorque(0.5), sg.SlipMargin(0.1)])
    for name, whose in (("one grasp", sg.analyse(grasp)), ("a stack", stack)):
        sg.plan_many(whose, task, wrenches=wrenches, kernel=kernel)
        ratios, shares = [], []
        for _ in range(runs):
            took = []
            for threads in (1, 2):
                start, busy = time.perf_counter(), time.process_time()
                sg.plan_many(whose, task, wrenches=wrenches, kernel=kernel, threads=threads)
                took.append(time.perf_counter() - start)
                shares.append((time.process_time() - busy) / took[-1])
            ratios.append(took[0] / took[1])
        told = ", ".join(f"{ratio:.2f}" for ratio in ratios)
        cores = f"cores in use with one {np.mean(shares[::2]):.2f}, with two {np.mean(shares[1::2]):.2f}"
        print(f"{name:>10}: two threads {told} times as fast; {cores}", flush=True)


if __name__ == "__main__":
    main()
