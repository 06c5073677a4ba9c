"""What the statics of many grasps cost at once, against one by one.

    OPENBLAS_NUM_THREADS=1 python tests/benchmarks/statics_in_batch.py [GRASPS]

Random grasps (1,000) of 3 hard contacts, of 4 soft ones and of 3 hard and 4 soft ones, 9 joints and 4 synergies; then
bundled grasps with contacts of 1,000 compliances. Where synergies are many, both spend most of their time in LAPACK,
which leaves less to gain. Prints milliseconds for a thousand grasps by `analyse` in a loop and by `analyse_many`, their
ratio, how many grasps the batch worked out one by one, and the largest difference of a map or basis, relative to its
size. Times are processor times, each the least of a few runs taken in turns; the analysis of a list includes stacking
its matrices.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from dataclasses import fields
from pathlib import Path
from typing import TypeVar

import numpy as np

sys.path.insert(0, str(Path(__file__).parent.parent))
from random_grasps import random_grasp

import synergrip
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.stack import GraspStack
from synergrip.statics.analyses import Analyses, analyse_many
from synergrip.statics.analysis import Analysis, analyse
from synergrip.statics.response import Maps
from synergrip.statics.subspaces import Bases

FORMS = {"3 hard": ["hard"] * 3, "4 soft": ["soft"] * 4, "3 hard + 4 soft": ["hard"] * 3 + ["soft"] * 4}
BUNDLED = ("barrett-ball-arm", "dlr-ball-eigengrasps", "human-ball-5", "dlr-ball-corners", "human-ball-centred")
RUNS = 5
T = TypeVar("T")


def timed(run: Callable[[], T]) -> tuple[float, T]:
    """Return the processor time [s] of a call, and what it returns."""
    start = time.process_time()
    found = run()
    return time.process_time() - start, found


def difference(together: Analyses, alone: list[Analysis]) -> float:
    """Return the largest difference of a map or a basis, relative to its largest entry."""
    worst = 0.0
    for group in together.groups:
        for index, place in enumerate(group.places):
            one = alone[place]
            pairs = [(getattr(group.response, f.name)[index], getattr(one.response, f.name)) for f in fields(Maps)]
            pairs += [(getattr(group.spaces, f.name)[index], getattr(one.spaces, f.name)) for f in fields(Bases)]
            for ours, theirs in pairs:
                size = float(np.abs(theirs).max(initial=0.0))
                worst = max(worst, float(np.abs(ours - theirs).max(initial=0.0)) / (size or 1.0))
    return worst


def grasps_of(name: str, count: int) -> list[Grasp]:
    """Return random grasps of a form, or those like a bundled one."""
    if name in FORMS:
        return [random_grasp(np.random.default_rng(seed), FORMS[name], n_q=9, n_z=4) for seed in range(count)]
    grasp = synergrip.load_problem(name).grasp
    softer = np.random.default_rng(0).uniform(0.5, 2.0, (count, 1, 1))
    return list(GraspStack.varied(grasp, C_s=softer * grasp.C_s))


def main() -> None:
    """Print one line for each form of grasp."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 1_000
    print(f"{'grasps':>20}  n_z  {'loop ms':>8}  batch ms   ratio  one by one  difference")
    for name in (*FORMS, *BUNDLED):
        grasps = grasps_of(name, count)
        loops, batches = [], []
        for _ in range(RUNS):
            seconds, alone = timed(lambda grasps=grasps: [analyse(grasp) for grasp in grasps])
            loops.append(1e6 * seconds / count)
            seconds, together = timed(lambda grasps=grasps: analyse_many(grasps))
            batches.append(1e6 * seconds / count)
        least = f"{min(loops):>8.0f}  {min(batches):>8.1f}  {min(loops) / min(batches):>6.1f}"
        apart = f"{len(together.one_by_one):>10}  {difference(together, alone):>10.1e}"
        print(f"{name:>20}  {grasps[0].S.shape[1]:>3}  {least}  {apart}", flush=True)


if __name__ == "__main__":
    main()
