"""All benchmarks, one after the other: ``python tests/benchmarks/all.py [quick] [NAME ...]``.

As docs/performance.md quotes them, which takes an hour or two, or `quick`: sizes at which each takes seconds, to see
that all of them run. NAME is one below, to run that alone. First come versions, the machine and what else keeps it
busy, then each benchmark with its command and what it prints; in the end how many failed and which, with exit code 1
if any did.

What all have in common: processor time of one thread unless a line says that it is by the clock; things that are
compared take turns in one process, or in processes of their own; medians over runs (the least of a few where a line
says so). Random are grasps of fingers with three joints around a small object, 3 hard or 4 soft contacts, friction,
stiffness and loads (`tests/random_cone_problems.py`, `tests/random_tasks.py`), always from seed 0. Tolerances are 1e-8
for small programs, Clarabel's own, and 1e-9 for trajectories; answers are judged by the same verifier, whoever found
them.
"""

from __future__ import annotations

import subprocess
import sys
import time
from pathlib import Path

from conditions import conditions

FOLDER = Path(__file__).parent
COMMANDS: dict[str, tuple[str, str | None]] = {
    "startup": ("7", "3"),
    "compiling": ("", None),
    "many": ("4096 3", "256 1"),
    "many_against": ("60 3", "10 1"),
    "many_sizes": ("100000", "1000"),
    "threads_of_many": ("100000 3", "2000 1"),
    "many_end_to_end": ("20000", "400"),
    "statics_in_batch": ("1000", "50"),
    "one_plan": ("20 9", "2 1"),
    "coupled": ("1000 10000", "200"),
    "orders": ("1001 5001", "201"),
    "trajectory": ("1000 10000", "100"),
    "along": ("", "barrett-ball-hold"),
    "explain": ("", "pinch-soft limits.joint_torque=0.05"),
    "margins": ("", "tripod"),
    "pyramids": ("300", "5"),
}
"""Benchmark -> its arguments, and those of the quick run; None where it is never quick."""


def main() -> None:
    """Run those that are asked for."""
    quick, names = "quick" in sys.argv[1:], [name for name in sys.argv[1:] if name != "quick"]
    unknown = [name for name in names if name not in COMMANDS]
    if unknown:
        sys.exit(f"no such benchmark: {', '.join(unknown)}; there are {', '.join(COMMANDS)}")
    print(conditions(), flush=True)
    failed = []
    asked = {name: COMMANDS[name][quick] for name in names or COMMANDS}
    asked = {name: arguments for name, arguments in asked.items() if arguments is not None}
    for name, told in asked.items():
        arguments = told.split()
        print(f"\n$ python tests/benchmarks/{name}.py {' '.join(arguments)}".rstrip(), flush=True)
        start = time.perf_counter()
        code = subprocess.run([sys.executable, str(FOLDER / f"{name}.py"), *arguments]).returncode
        print(f"({time.perf_counter() - start:.0f} s{f', FAILED with exit code {code}' if code else ''})", flush=True)
        failed += [name] if code else []
    print(f"\n{len(failed)} of {len(asked)} failed{': ' + ', '.join(failed) if failed else ''}")
    sys.exit(bool(failed))


if __name__ == "__main__":
    main()
