"""What hostile files cost: the processor time and the memory of whole processes, start-up included.

    python tests/benchmarks/hostile_files.py [PART OF A NAME]

Runs every case of `tests/hostile_files.py` and `tests/hostile_models.py` as a command of its own; each is to end with
exit code 2 within 2 s and 500 MB. Prints those that do not, the slowest and the largest. POSIX only.
"""

from __future__ import annotations

import os
import signal
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from hostile_models import CASES

LONGEST, LARGEST = 2.0, 500.0  # s, MB
GIVEN_UP = 30  # s
SHOWN = 8


@dataclass(frozen=True)
class Cost:
    """What one command took."""

    name: str
    code: int
    seconds: float
    """Of the processor: what it takes on a machine that does nothing else."""
    passed: float
    """On the clock [s]."""
    megabytes: float
    said: str

    def __str__(self) -> str:
        clock = f"({self.passed:.2f} on the clock)"
        return f"{self.name:36} exit {self.code:4} {self.seconds:6.2f} s {clock} {self.megabytes:5.0f} MB  {self.said}"


def run(name: str, command: list[str], folder: Path) -> Cost:
    """Return what a command takes as a process of its own; its output goes into the folder."""
    begin = time.perf_counter()
    process = os.fork()
    if process == 0:
        with (folder / "said").open("wb") as stream:
            os.dup2(stream.fileno(), 1)
            os.dup2(stream.fileno(), 2)
        signal.alarm(GIVEN_UP)
        os.environ.pop("PYTHONDONTWRITEBYTECODE", None)  # an installed program is compiled once
        os.execv(sys.executable, [sys.executable, "-m", "synergrip", *command])
    _, status, usage = os.wait4(process, 0)
    passed, seconds = time.perf_counter() - begin, usage.ru_utime + usage.ru_stime
    said = (folder / "said").read_text(encoding="utf-8", errors="replace").strip().split("\n")
    told = next((line for line in said if line.startswith("error")), said[-1])
    return Cost(name, os.waitstatus_to_exitcode(status), seconds, passed, usage.ru_maxrss / 1024, told[:110])


def main() -> None:
    """Run them all."""
    chosen = [case for case in CASES if len(sys.argv) < 2 or sys.argv[1] in case.name]
    costs = []
    for case in chosen:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            case.lay(folder)
            cost = run(case.name, [part.replace("@", name) for part in case.command], folder)
            costs.append(cost)
            if len(sys.argv) > 2 or cost.code != 2 or cost.seconds > LONGEST or cost.megabytes > LARGEST:
                print(cost, flush=True)
    print(f"{len(costs)} commands")
    print("slowest", *sorted(costs, key=lambda cost: -cost.seconds)[:SHOWN], sep="\n  ")
    print("largest", *sorted(costs, key=lambda cost: -cost.megabytes)[:SHOWN], sep="\n  ")


if __name__ == "__main__":
    main()
