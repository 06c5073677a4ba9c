"""What figures were measured with: versions, the machine, and how busy it is."""

from __future__ import annotations

import os
import platform
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

PACKAGES = (
    "synergrip", "numpy", "scipy", "clarabel", "mujoco", "numba", "cvxpy", "qoco", "moreau", "osqp", "piqp",
    "qpsolvers",
)  # fmt: skip


def conditions() -> str:
    """Return versions of what is installed, what is not, the processor and the load on it, in two lines."""
    there, missing = [f"Python {platform.python_version()}"], []
    for name in PACKAGES:
        try:
            there.append(f"{name} {version(name)}")
        except PackageNotFoundError:
            missing.append(name)
    without = f"; without {', '.join(missing)}" if missing else ""
    busy = f", {os.getloadavg()[0]:.1f} processes busy" if hasattr(os, "getloadavg") else ""
    return f"{', '.join(there)}{without}\n{os.cpu_count()} cores, {_processor()}{busy}"


def _processor() -> str:
    """Return the name of the processor and how wide its vectors are, as far as the system says."""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return platform.processor() or platform.machine()
    told = dict(line.split(":", 1) for line in lines if ":" in line)
    told = {name.strip(): value.strip() for name, value in told.items()}
    wide = next((word for word in ("avx512f", "avx2") if word in told.get("flags", "").split()), "")
    return f"{told.get('model name', platform.machine())} {wide}".strip()
