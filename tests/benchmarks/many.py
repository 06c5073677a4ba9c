"""What many small programs cost at once, and one after the other: ``python tests/benchmarks/many.py [TASKS] [RUNS]``.

Random grasps of 3 hard and of 4 soft contacts, fingers of three joints, 5 and 8 synergies; limits of cones, normal
force and joint torque; largest margin as the goal, and then least effort. Processor time of one thread in microseconds
a task, medians of runs taken in turns, and how many times as fast as Clarabel within this run:

kernel      the programs as arrays, by the compiled kernel (``synergrip[fast]``) and by that in NumPy, solved to 1e-8,
            against Clarabel as it comes (its matrices made, set up and solved to 1e-8; default settings) on the same;
program     one grasp with many loads: arrays made, solved, verified, judged as physics (`plan_many` on an Analysis);
statics     a grasp for each task, with its statics (`plan_many` on a stack);
plan        `plan` in a loop: on the Analysis of one grasp, and on grasp after grasp.

Then how sure: the largest difference of the objective to Clarabel's at 1e-9, in units of the load (of its square for
effort), the shares that are verified and that were planned one by one.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path
from typing import Any

for _name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS", "RAYON_NUM_THREADS"):
    os.environ.setdefault(_name, "1")

import numpy as np  # noqa: E402 - after the threads
from scipy import sparse  # noqa: E402

sys.path.insert(0, str(Path(__file__).parent.parent))
from random_cone_problems import grasp_like, random_wrenches  # noqa: E402

import synergrip as sg  # noqa: E402
from synergrip.batch import fast_kernel, fast_statics, numpy_kernel, verifier  # noqa: E402
from synergrip.batch.asked import asked  # noqa: E402
from synergrip.batch.assembly import assembled  # noqa: E402
from synergrip.batch.cone_problems import ConeProblems, Tolerance  # noqa: E402
from synergrip.batch.stated import stated_on  # noqa: E402

FORMS = {"3 hard": (["hard"] * 3, 5), "4 soft": (["soft"] * 4, 8)}
GOALS = {"largest margin": sg.LargestMargin(), "least effort": sg.LeastEffort()}
MARGIN, ONE_BY_ONE = 0.1, 50
"""[N] asked for; how many tasks what goes one after the other is measured with."""


def clarabel(problems: ConeProblems, tolerance: float = 1e-8) -> list[float]:
    """Return the objectives by Clarabel, one program after the other, in units of the load."""
    import clarabel as solver

    lines = sum(size == 1 for size in problems.sizes)
    cones = [solver.NonnegativeConeT(lines)] * bool(lines)
    cones += [solver.SecondOrderConeT(size) for size in problems.sizes if size > 1]
    found = []
    for i in range(len(problems)):
        P, q, A = (each[i if len(each) > 1 else 0] for each in (problems.P, problems.q, problems.A))
        options = solver.DefaultSettings()
        options.verbose, options.max_threads = False, 1
        options.tol_gap_abs = options.tol_gap_rel = options.tol_feas = tolerance
        upper, rows = sparse.csc_matrix(np.triu(P)), sparse.csc_matrix(A)
        found.append(float(solver.DefaultSolver(upper, q, rows, problems.b[i], cones, options).solve().obj_val))
    return found


def in_turns(things: dict[str, tuple[int, Callable[[], Any]]], runs: int) -> dict[str, float]:
    """Return processor time [us] a task of each thing: the median of runs that are taken in turns."""
    times: dict[str, list[float]] = {name: [] for name in things}
    for run in range(runs + 1):  # the first one warms up
        for name, (count, call) in things.items():
            start = time.process_time()
            call()
            if run:
                times[name].append(1e6 * (time.process_time() - start) / count)
    return {name: float(np.median(each)) for name, each in times.items()}


def measured(form: str, goal: str, tasks: int, runs: int) -> None:
    """Print the lines of one form of grasp and one goal."""
    kinds, n_z = FORMS[form]
    rng = np.random.default_rng(0)
    grasps, wrenches = [grasp_like(rng, kinds, n_z) for _ in range(tasks)], random_wrenches(rng, tasks)
    stack = sg.GraspStack.of(grasps)
    limits = [sg.NormalForce(upper=10.0), sg.JointTorque(0.5), sg.SlipMargin(MARGIN)]
    task = sg.Task(knots=1, limits=limits, goals=[GOALS[goal]])
    analysis = sg.analyse(grasps[0])
    question = asked(analysis, task, wrenches, None, None)
    arrays = assembled(stated_on(analysis, question.task, wrenches, None))
    problems = arrays.largest_margin() if goal == "largest margin" else arrays.least_effort("contact", MARGIN)[0]
    few, never = problems.taken(slice(ONE_BY_ONE)), np.full(tasks, -np.inf)
    fast = find_spec("numba") is not None
    kernel = "numba" if fast else "numpy"
    solve = fast_kernel.solve if fast else numpy_kernel.solve
    loads = [task.replace(loads=[sg.Wrench(tuple(wrench))]) for wrench in wrenches[:ONE_BY_ONE]]
    pairs = list(zip(grasps, loads, strict=False))
    took = in_turns(
        {
            "kernel": (tasks, lambda: solve(problems, Tolerance(), never)),
            "numpy": (tasks, lambda: numpy_kernel.solve(problems, Tolerance(), never)),
            "clarabel": (len(few), lambda: clarabel(few)),
            "program": (tasks, lambda: sg.plan_many(analysis, task, wrenches=wrenches, kernel=kernel)),
            "statics": (tasks, lambda: sg.plan_many(stack, task, wrenches=wrenches, kernel=kernel)),
            "plan, analysed": (len(loads), lambda: [sg.plan(analysis, each) for each in loads]),
            "plan": (len(pairs), lambda: [sg.plan(grasp, each) for grasp, each in pairs]),
        },
        runs,
    )
    cold = took["clarabel"]
    shown = "  ".join(f"{took[name]:>9.1f} {cold / took[name]:>6.1f}x" for name in took if name != "clarabel")
    print(f"{form:>7} {goal:>15}  {cold:>8.0f}  {shown}", flush=True)
    told_accuracy(problems, solve, [sg.plan_many(whose, task, wrenches=wrenches, kernel=kernel)
                                    for whose in (analysis, stack)])  # fmt: skip


def told_accuracy(problems: ConeProblems, solve: Any, found: list[sg.ManyPlans]) -> None:
    """Print how sure the answers are."""
    few = problems.taken(slice(10 * ONE_BY_ONE))
    x = solve(few, Tolerance(5e-9, 2e-9), np.full(len(few), -np.inf))
    values = (x.x * ((few.P @ x.x[:, :, None])[:, :, 0] / 2 + few.q)).sum(axis=1)
    free = np.full(x.x.shape, np.inf)
    right = verifier.judge_optimal(few, x.x, x.z, free).verified
    theirs = np.array(clarabel(few, 1e-9))
    apart = np.abs(values - theirs)[right].max(initial=0.0)
    counts = [f"{each.verified.mean():.3%} verified, {each.one_by_one.sum()} of {len(each)} one by one, "
              f"{(each.verdicts == 'infeasible').mean():.0%} infeasible" for each in found]  # fmt: skip
    print(f"{'':>23}  difference to Clarabel {apart:.0e}; one grasp: {counts[0]}; stack: {counts[1]}", flush=True)


def main() -> None:
    """Print versions, a line for each form and goal, and how sure."""
    tasks, runs = (int(text) for text in (*sys.argv[1:], *("4096", "5")[len(sys.argv) - 1 :]))
    packages = ("numpy", "clarabel", *(["numba"] if find_spec("numba") else []))
    print(f"{tasks} tasks, {runs} runs; " + ", ".join(f"{name} {version(name)}" for name in packages))
    if find_spec("numba"):
        start = time.perf_counter()
        fast_kernel.compiled()
        between = time.perf_counter()
        fast_statics.compiled()
        there = f"after {between - start:.1f} s, the compiled statics after {time.perf_counter() - between:.1f} s more"
        print(f"the compiled kernel was there {there}")
    names = ("kernel", "numpy kernel", "program", "statics", "plan, analysed", "plan")
    print(f"{'us a task':>23}  {'Clarabel':>8}  " + "  ".join(f"{name:>17}" for name in names))
    for form in FORMS:
        for goal in GOALS:
            measured(form, goal, tasks, runs)


if __name__ == "__main__":
    main()
