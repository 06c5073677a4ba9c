"""How long a bundled plan takes, start to end, against only importing the libraries it stands on.

    python tests/benchmarks/startup.py [RUNS]

Processor time of whole processes that take turns, the end of each included: importing what no plan does without,
`plan` of a bundled problem, and ``--help``. Medians, and the ratio to the imports; at most 1.5 is the aim for `plan`.
Python keeps what it compiles in a folder that is made for this: where it may keep nothing, as in some containers, it
compiles all of synergrip in each process, which is no part of the comparison. The first run of each warms up.
"""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

IMPORTS = "import numpy, scipy.sparse, mujoco, clarabel, pydantic, tree_sitter, typer"


def cpu_seconds(environment: dict[str, str], *command: str) -> float:
    """Return the processor time of one run of a command, start and end included."""
    before = os.times()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, env=environment)
    after = os.times()
    return after.children_user + after.children_system - before.children_user - before.children_system


def main() -> None:
    """Run all in turn and print medians and ratios."""
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 9
    with tempfile.TemporaryDirectory() as folder:
        environment = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
        environment["PYTHONPYCACHEPREFIX"] = str(Path(folder) / "compiled")
        verbs = {"plan": ("plan", "barrett-ball-hold", "-o", str(Path(folder) / "out")), "--help": ("--help",)}
        commands = {"imports": (sys.executable, "-c", IMPORTS)}
        commands |= {name: (sys.executable, "-m", "synergrip", *verb) for name, verb in verbs.items()}
        turns = [{name: cpu_seconds(environment, *each) for name, each in commands.items()} for _ in range(runs + 1)]
    for name in commands:
        spent = statistics.median(turn[name] for turn in turns[1:])
        ratios = sorted(turn[name] / turn["imports"] for turn in turns[1:])
        told = f"{statistics.median(ratios):.2f} times the imports, from {ratios[0]:.2f} to {ratios[-1]:.2f}"
        print(f"{name:>8} {spent:>6.2f} s  {told}")


if __name__ == "__main__":
    main()
