"""How long a bundled plan takes, start to end, against only importing the libraries it stands on.

    python tests/benchmarks/startup.py [RUNS]

Prints the median ratio of alternating runs; below 2 is the aim. Whole processes, so the machine's noise is in both.
"""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import tempfile

IMPORTS = "import numpy, scipy.sparse, mujoco, clarabel, pydantic, typer"


def cpu_seconds(*command: str) -> float:
    """Return the processor time of one run of a command, start-up included."""
    before = os.times()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    after = os.times()
    return after.children_user + after.children_system - before.children_user - before.children_system


def main() -> None:
    """Run both in turn and print the ratios."""
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 7
    with tempfile.TemporaryDirectory() as folder:
        plan = (sys.executable, "-m", "synergrip", "plan", "barrett-ball-hold", "-o", folder)
        libraries = (sys.executable, "-c", IMPORTS)
        pairs = [(cpu_seconds(*plan), cpu_seconds(*libraries)) for _ in range(runs + 1)][1:]  # the first one warms up
    ratios = sorted(a / b for a, b in pairs)
    whole, imports = (statistics.median(times) for times in zip(*pairs, strict=True))
    print(f"ratio: median {statistics.median(ratios):.2f}, from {ratios[0]:.2f} to {ratios[-1]:.2f}, {runs} runs")
    print(f"plan {whole:.2f} s, imports {imports:.2f} s of processor time")


if __name__ == "__main__":
    main()
