"""What the compiled functions cost before they answer: compiled for the first time, and loaded from then on.

    python tests/benchmarks/compiling.py

Processor time of processes of their own, with a folder for what is compiled that begins empty. Nothing without Numba.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from importlib.util import find_spec

EACH = """
import time
from synergrip.batch import fast_kernel, fast_statics
for name, compiled in (("kernel", fast_kernel.compiled), ("statics", fast_statics.compiled)):
    word, start = "loaded" if compiled.kept() else "compiled", time.process_time()
    compiled()
    print(f"{name:>8} {word} in {time.process_time() - start:.1f} s", flush=True)
"""


def main() -> None:
    """Compile, and load."""
    if not find_spec("numba"):
        print("Numba is not installed: nothing is compiled")
        return
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(2):
            subprocess.run([sys.executable, "-c", EACH], check=True, env=os.environ | {"NUMBA_CACHE_DIR": folder})


if __name__ == "__main__":
    main()
