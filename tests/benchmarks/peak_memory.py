"""By how much a call lets the memory of this process grow at its peak."""

from __future__ import annotations

import gc
import math
from collections.abc import Callable
from pathlib import Path

PROCESS = Path("/proc/self")


def grown(call: Callable[[], object]) -> float:
    """Return the peak of resident memory during a call beside what there was before it [MB]; NaN where nobody tells.

    The highest mark of a process (`ru_maxrss`) is no measure: what made the program has often gone higher.
    """
    gc.collect()
    try:
        (PROCESS / "clear_refs").write_text("5")  # begins a new peak
    except OSError:
        call()
        return math.nan
    before = _of("VmRSS")
    result = call()  # kept until the peak is read
    peak = _of("VmHWM")
    del result
    return (peak - before) / 1e3


def _of(name: str) -> int:
    lines = (PROCESS / "status").read_text().splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith(f"{name}:"))
