"""Plans killed and interrupted at random instants: what stands in the folder, what is said, how it ends.

    python tests/judged_endings.py kills [COUNT] | interrupts [COUNT] | sweep [STEP_MS]

`kills` (250) replaces a plan by another and kills that process while it writes; `interrupts` (60) sends SIGINT between
the start of the process and its end, `sweep` every STEP_MS (10) of the first 1.5 s. Instants before Python runs the
first line of synergrip are counted by themselves: their traceback is the interpreter's.
"""

from __future__ import annotations

import json
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

import numpy as np

from synergrip.scratch import NAME

FILES = ("plan.json", "plan.csv", "plan.npz")
MARGINS = (0.5, 1.0)
"""[N] Slip margins of the two plans that replace each other."""
PROBLEM = "barrett-ball-hold"
OURS = "synergrip" + os.sep


def command(folder: Path, margin: float) -> list[str]:
    """Return the command that plans."""
    return [sys.executable, "-m", "synergrip", "plan", PROBLEM, "-o", str(folder), "--set", f"limits.margin={margin} N"]


def started(folder: Path, margin: float) -> subprocess.Popen[str]:
    """Start a plan."""
    return subprocess.Popen(command(folder, margin), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def references(path: Path) -> np.ndarray:
    """Return the synergy references of a file of a plan (T, n_z)."""
    if path.suffix == ".json":
        return np.array(json.loads(path.read_text(encoding="utf-8"))["dz_r"])
    if path.suffix == ".npz":
        with np.load(path, allow_pickle=False) as stored:
            return np.array(stored["dz_r"])
    return np.loadtxt(path, delimiter=",", skiprows=1)[:, 1:5]


def answers(folder: Path, known: dict[float, np.ndarray]) -> tuple[list[float], int]:
    """Return whose answer each file holds, and how many files there are."""
    found = [references(folder / name) for name in FILES if (folder / name).exists()]
    whose = [next((margin for margin, z in known.items() if np.array_equal(z, each)), -1.0) for each in found]
    return whose, len(found)


def hidden(folder: Path) -> list[Path]:
    """Return what is left in a folder and beside it."""
    return [path for place in (folder, folder.parent) for path in place.iterdir() if NAME.fullmatch(path.name)]


def writing_begins(process: subprocess.Popen[str], folder: Path, until: float) -> None:
    """Wait until a process has begun to write."""
    while time.monotonic() < until and process.poll() is None and not hidden(folder):
        time.sleep(0.0002)


def kills(count: int) -> list[str]:
    """Kill while plans are written, with nothing else in the folder and with a file of the user's."""
    wrong: list[str] = []
    tally: Counter[str] = Counter()
    chance = random.Random(0)
    with tempfile.TemporaryDirectory() as name:
        for beside in (False, True):
            folder = Path(name, "beside" if beside else "alone", "plan")
            folder.mkdir(parents=True)
            known: dict[float, np.ndarray] = {}
            for margin in MARGINS:
                subprocess.run(command(folder, margin), check=True, capture_output=True)
                known[margin] = references(folder / "plan.json")
            if beside:
                (folder / "mine.txt").write_text("mine")
            for index in range(count // 2):
                process = started(folder, MARGINS[index % 2])
                writing_begins(process, folder, time.monotonic() + 60)
                time.sleep(chance.uniform(0, 0.08))
                process.kill()
                process.communicate()
                whose, files = answers(folder, known)
                state = "ended" if process.returncode == 0 else "killed"
                left = "old" if whose and whose[0] != MARGINS[index % 2] else "new"
                tally[f"{'beside' if beside else 'alone'}: {state}, {files} files, {left}"] += 1
                if len(set(whose)) != 1 or -1.0 in whose:
                    wrong.append(f"{folder.parent.name} {index}: answers {whose}")
                if beside and (folder / "mine.txt").read_text() != "mine":
                    wrong.append(f"{index}: another file was changed")
            subprocess.run(command(folder, MARGINS[0]), check=True, capture_output=True)
            if hidden(folder):
                wrong.append(f"the next run leaves {hidden(folder)}")
    print(*(f"{key}: {value}" for key, value in sorted(tally.items())), sep="\n")
    return wrong


def interrupted(after_s: float, tally: Counter[str]) -> list[str]:
    """Interrupt a plan some time after its start."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name, "plan")
        process = started(folder, MARGINS[0])
        time.sleep(after_s)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate()
        files = {path.name for path in folder.iterdir()} if folder.exists() else set()
        left = hidden(folder) if folder.exists() else [path for path in Path(name).iterdir() if path != folder]
    code = process.returncode
    if code not in (0, 130) and OURS not in err and not out:  # not one line of ours had run
        tally["before the first line of synergrip"] += 1
        return []
    tally[f"exit {code}, {'a plan' if files else 'nothing'} written"] += 1
    wrong = [f"exit {code}"] if code not in (0, 130) else []
    wrong += ["traceback"] if "Traceback" in err or "Exception ignored" in err else []
    wrong += ["more than a line"] if len(err.splitlines()) > 1 else []
    wrong += [f"files {files}"] if files not in (set(), set(FILES)) else []
    wrong += [f"left {left}"] if left else []
    return [f"{after_s * 1e3:.0f} ms: {word}\n{err[-500:]}" for word in wrong]


def interrupts(instants: list[float]) -> list[str]:
    """Interrupt plans at instants [s]."""
    signal.signal(signal.SIGINT, signal.default_int_handler)  # what a shell's background job ignores, its children do
    tally: Counter[str] = Counter()
    wrong = [word for instant in instants for word in interrupted(instant, tally)]
    print(*(f"{key}: {value}" for key, value in sorted(tally.items())), sep="\n")
    return wrong


def main() -> None:
    """Judge, and print what is wrong."""
    what, number = sys.argv[1], [int(word) for word in sys.argv[2:]]
    if what == "kills":
        wrong = kills(*(number or [250]))
    elif what == "interrupts":
        with tempfile.TemporaryDirectory() as name:
            start = time.monotonic()
            subprocess.run(command(Path(name, "plan"), MARGINS[0]), check=True, capture_output=True)
            whole = time.monotonic() - start
        chance = random.Random(0)
        wrong = interrupts([chance.uniform(0, 1.1 * whole) for _ in range(*(number or [60]))])
    else:
        step = (number or [10])[0]
        wrong = interrupts([ms / 1e3 for ms in range(0, 1501, step)])
    print(*wrong, f"{len(wrong)} wrong", sep="\n")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
