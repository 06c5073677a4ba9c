"""What the short form of a no costs, beside the planning that ends in it: ``python tests/benchmarks/explain.py``.

Processor time, the least of three, one thread. The issue that it answers: at most 20 times.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable

for _name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_name, "1")

import synergrip as sg  # noqa: E402 - after the threads

NOES = (
    ("tripod", "limits.normal_force=1 N"),
    ("pinch-soft", "limits.margin=12 N"),
    ("pinch-soft", "limits.joint_torque=0.05"),
    ("barrett-ball-lift",),
    ("barrett-ball-hold", "limits.normal_force=8 N"),
    ("barrett-ball-roll", "limits.margin=5 N"),
    ("human-glass", "limits.joint_torque=0.1"),
    ("human-ball", "limits.synergy_rate=0.01"),
    ("dlr-ball-move", "limits.normal_force=1 N"),
    ("gripper-box", "contacts.friction_factor=0.1"),
    ("robonaut-handle", "limits.normal_force=0.5 N"),
    ("robonaut-handle", "limits.normal_force=12 N"),
    ("robonaut-handle", "limits.margin=20 N"),
    ("robonaut-handle", "limits.actuator_effort=0.1"),
    ("robonaut-handle", "contacts.friction_factor=0.2"),
    ("robonaut-handle-eigengrasps", "limits.synergy_acceleration=0.01"),
    ("barrett-ball-lift", "limits.actuator_effort=0.1"),
)
"""Problems without a plan, by a change of one value."""
RUNS = 3


def least(run: Callable[[], object]) -> float:
    """Return the least processor time [s] of some runs."""
    times = []
    for _ in range(RUNS):
        begun = time.process_time()
        run()
        times.append(time.process_time() - begun)
    return min(times)


def main() -> None:
    """Print a line for each."""
    print(f"{'problem':24} {'changed':34} {'verdict':11} {'cause':14} {'plan [s]':>9} {'short [s]':>9}  ratio")
    for name, *changes in NOES if len(sys.argv) < 2 else [tuple(sys.argv[1:])]:
        problem = sg.load_problem(name, changes)
        answer = sg.plan(problem.grasp, problem.task)
        if isinstance(answer, sg.Plan):
            print(f"{name:24} {' '.join(changes):34} {answer.verdict}")
            continue
        planned = least(lambda problem=problem: sg.plan(problem.grasp, problem.task))  # type: ignore[misc]
        explained = least(lambda answer=answer: answer._explained(short=True, heard=None))  # type: ignore[misc]
        print(
            f"{name:24} {' '.join(changes):34} {answer.verdict:11} {answer.explanation.cause:14} {planned:9.3f} "
            f"{explained:9.3f}  {explained / planned:5.1f}",
            flush=True,
        )


if __name__ == "__main__":
    main()
