"""Cost of a task against how many there are: ``python tests/benchmarks/many_sizes.py [LARGEST] [PICTURE]``.

`plan_many` of 3 hard and of 4 soft contacts, largest margin, one grasp with many loads and a grasp for each, from a
thousand tasks to LARGEST (100,000; up to a million): microseconds of processor time a task, by the compiled lanes where
there are any, the memory that was needed at most, and Clarabel cold on the same programs, one after the other. PICTURE
is a file (.svg); docs/images/cost-against-size.svg is made so.
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
from many_against import programs  # noqa: E402
from other_solvers import clarabel_cold  # noqa: E402
from random_cone_problems import grasp_like, random_wrenches  # noqa: E402

import synergrip as sg  # noqa: E402

FORMS = {"3 hard": (["hard"] * 3, 5), "4 soft": (["soft"] * 4, 8)}
KERNEL = "numba" if find_spec("numba") else "numpy"
TASK = sg.Task(knots=1, limits=[sg.NormalForce(upper=10.0), sg.JointTorque(0.5), sg.SlipMargin(0.1)])
AT_LEAST = 20_000
"""Tasks in all runs of a size together: a few milliseconds by themselves are what others leave of the core."""
Curve = list[tuple[int, float]]
FEW = 100
"""Tasks that Clarabel is measured with."""
COLORS = {"3 hard": "#0072b2", "4 soft": "#d55e00"}


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


def clarabel(form: str) -> float:
    """Return microseconds a task of Clarabel cold; the better of two runs."""
    problems, took = programs(form, FEW), []
    for _ in range(2):
        start = time.process_time()
        clarabel_cold(problems)
        took.append(time.process_time() - start)
    return 1e6 * min(took) / FEW


def draw(curves: dict[str, Curve], alone: dict[str, float], path: Path) -> None:
    """Draw cost against size, beside Clarabel's."""
    import matplotlib as mpl

    mpl.use("svg")
    mpl.rcParams |= {"svg.fonttype": "none", "svg.hashsalt": "synergrip", "font.family": "sans-serif"}
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(figsize=(6.0, 3.4), layout="constrained")
    sizes, ends = np.array([0.0]), dict[str, float]()
    for name, points in curves.items():
        sizes, costs = np.array(points).T
        color, each = COLORS[name.split(",")[0]], "each" in name
        axes.loglog(sizes, costs, "o--" if each else "o-", color=color, mfc="white" if each else color)
        ends[name] = costs[-1]
    for form, cost in alone.items():
        axes.plot(sizes[[0, -1]], [cost, cost], ":", color=COLORS[form])
        ends[f"{form}, Clarabel"] = cost
    height = 0.0
    for name, cost in sorted(ends.items(), key=lambda each: each[1]):
        height = max(cost, 1.35 * height)  # one above the other
        axes.annotate(name, (sizes[-1], height), (8, 0), textcoords="offset points", va="center",
                      color=COLORS[name.split(",")[0]], fontsize="small")  # fmt: skip
    axes.set(xlabel="tasks", ylabel="µs of processor time a task", ylim=(2, 1000))
    axes.spines[["top", "right"]].set_visible(False)
    axes.grid(visible=True, axis="y", alpha=0.3)
    figure.savefig(path, metadata={"Date": None, "Creator": None})


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
    alone = {form: clarabel(form) for form in FORMS}
    print("; ".join(f"Clarabel cold, {form}: {cost:.0f} us" for form, cost in alone.items()))
    if len(sys.argv) > 2:
        draw(curves, alone, Path(sys.argv[2]))


if __name__ == "__main__":
    main()
