"""What the direct numbers cost, beside one plan of the same problem: ``python tests/benchmarks/margins.py [NAME ...]``.

Processor time, the least of three for the plan and one run of all numbers, one thread. It should be at
most 40 times.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable

for _name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_name, "1")

import synergrip as sg  # noqa: E402 - after the threads

PROBLEMS = (
    "tripod", "pinch-soft", "barrett-ball-hold", "barrett-ball-arm", "gripper-peg", "dlr-ball-move", "human-ball-5",
    "human-glass", "robonaut-handle",
)  # fmt: skip
NUMBERS = (
    "critical_friction_scale", "heaviest_kg", "load_factor", "least_peak_N", "least_effort", "shortest_duration_s",
    "largest_amplitude",
)  # fmt: skip


def seconds(run: Callable[[], object]) -> float:
    """Return the processor time [s] of a call."""
    begun = time.process_time()
    run()
    return time.process_time() - begun


def main() -> None:
    """Print a line for each."""
    print(f"{'problem':20} {'plan [s]':>9} {'numbers [s]':>11}  ratio  attained  proven")
    for name in sys.argv[1:] or PROBLEMS:
        problem = sg.load_problem(name)
        planned = min(seconds(lambda p=problem: sg.plan(p.grasp, p.task)) for _ in range(3))  # type: ignore[misc]
        begun = time.process_time()
        found = sg.margins(problem.grasp, problem.task, only=NUMBERS)
        spent = time.process_time() - begun
        if not isinstance(found, sg.Margins):
            print(f"{name:20} {found.verdict}")
            continue
        attained = [each for each in found.direct.values() if each.value is not None]
        print(
            f"{name:20} {planned:9.3f} {spent:11.2f}  {spent / planned:5.1f}  {len(attained):8}  "
            f"{sum(each.proven for each in attained):6}",
            flush=True,
        )


if __name__ == "__main__":
    main()
