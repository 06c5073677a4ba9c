"""Cost of a task against how many there are: ``python tests/benchmarks/many_sizes.py [LARGEST] [PICTURE]``.

`plan_many` of 3 hard and of 4 soft contacts, largest margin, one grasp with many loads and a grasp for each, from a
thousand tasks to LARGEST (100,000; up to a million): microseconds of processor time a task, by the compiled lanes where
there are any, and the memory that was needed at most. PICTURE is a file (.svg).
"""

from __future__ import annotations

import os
import resource
import sys
import time
from importlib.util import find_spec
from pathlib import Path

for _name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_name, "1")

import numpy as np  # noqa: E402 - after the threads

sys.path.insert(0, str(Path(__file__).parent.parent))
from random_cone_problems import grasp_like, random_wrenches  # noqa: E402

import synergrip as sg  # noqa: E402

FORMS = {"3 hard": (["hard"] * 3, 5), "4 soft": (["soft"] * 4, 8)}
KERNEL = "numba" if find_spec("numba") else "numpy"
TASK = sg.Task(knots=1, limits=[sg.NormalForce(upper=10.0), sg.JointTorque(0.5), sg.SlipMargin(0.1)])
AT_LEAST = 20_000
"""Tasks in all runs of a size together: a few milliseconds by themselves are what others leave of the core."""
Curve = list[tuple[int, float]]


def curve(form: str, sizes: list[int], *, stacked: bool) -> Curve:
    """Return tasks and microseconds a task; the best of two runs, or of as many more as make `AT_LEAST` tasks."""
    kinds, n_z = FORMS[form]
    rng, found = np.random.default_rng(0), Curve()
    grasp = grasp_like(rng, kinds, n_z)
    for size in (sizes[0], *sizes):  # the first one warms up
        wrenches = random_wrenches(rng, size)
        softer = rng.uniform(0.5, 2.0, (size, 1, 1))
        whose = sg.GraspStack.varied(grasp, C_s=softer * grasp.C_s) if stacked else sg.analyse(grasp)
        took = []
        for _ in range(max(2, AT_LEAST // size)):
            start = time.process_time()
            many = sg.plan_many(whose, TASK, wrenches=wrenches, kernel=KERNEL)
            took.append(time.process_time() - start)
        assert many.verified.all()
        found.append((size, 1e6 * min(took) / size))
    return found[1:]


def draw(curves: dict[str, Curve], path: Path) -> None:
    """Draw cost against size."""
    import matplotlib as mpl

    mpl.use("svg")
    mpl.rcParams["svg.fonttype"] = "none"
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(figsize=(6.0, 3.4), layout="constrained")
    for name, points in curves.items():
        sizes, costs = zip(*points, strict=True)
        axes.loglog(sizes, costs, marker="o", label=name)
    axes.set(xlabel="tasks", ylabel="µs of processor time a task", ylim=(10, 1000))
    axes.grid(visible=True, which="both", alpha=0.3)
    axes.legend(fontsize="small")
    figure.savefig(path)


def main() -> None:
    """Print the curves, and draw them."""
    largest = int(sys.argv[1]) if len(sys.argv) > 1 else 100_000
    sizes = [10**power for power in range(3, 7) if 10**power <= largest]
    curves = {
        f"{form}, {'a grasp for each' if stacked else 'one grasp'}": curve(form, sizes, stacked=stacked)
        for form in FORMS for stacked in (False, True)
    }  # fmt: skip
    for name, points in curves.items():
        told = "  ".join(f"{size:>9,}: {cost:6.1f} us" for size, cost in points)
        ratio = max(cost for _, cost in points) / min(cost for _, cost in points)
        print(f"{name:>24}  {told}; largest over smallest {ratio:.2f}")
    print(f"{resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6:.2f} GB at most; {KERNEL}")
    if len(sys.argv) > 2:
        draw(curves, Path(sys.argv[2]))


if __name__ == "__main__":
    main()
