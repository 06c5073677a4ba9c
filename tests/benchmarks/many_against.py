"""What the same small programs cost by other means: ``python tests/benchmarks/many_against.py [TASKS] [RUNS]``.

The programs of `many.py`, largest margin of one random grasp with TASKS (60) random loads, taken in turns: Clarabel
made anew for each ("cold") and updated, CVXPY as one writes it and with parameters, QOCO and Moreau where they are
installed, pyramids of eight facets by OSQP and PIQP as far as qpsolvers has them, and the compiled kernel (4,096 loads,
after it is compiled). Microseconds of processor time a program (medians), and how many times as fast as Clarabel cold.

Accuracy beside it, over the TASKS: the largest difference of the objective to Clarabel's at 1e-9 (in pyramids the
margin is smaller, which is most of it), the largest violation of a cone (both in units of the load), the share that our
verifier accepts where multipliers are given, and how many had no answer.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from importlib.util import find_spec
from typing import Any

from many import FORMS, MARGIN, in_turns

import numpy as np  # isort: skip - after the threads
from conditions import conditions
from other_solvers import TOLERANCE, Answers, clarabel_cold, ways
from random_cone_problems import grasp_like, random_wrenches, values

import synergrip as sg
from synergrip.batch import fast_kernel, verifier
from synergrip.batch.asked import asked
from synergrip.batch.assembly import assembled
from synergrip.batch.cone_problems import ConeProblems, Tolerance
from synergrip.batch.stated import stated_on

MANY = 4096


def programs(form: str, tasks: int) -> ConeProblems:
    """Return the largest margins of one grasp with many loads."""
    kinds, n_z = FORMS[form]
    rng = np.random.default_rng(0)
    analysis, wrenches = sg.analyse(grasp_like(rng, kinds, n_z)), random_wrenches(rng, tasks)
    limits = [sg.NormalForce(upper=10.0), sg.JointTorque(0.5), sg.SlipMargin(MARGIN)]
    question = asked(analysis, sg.Task(knots=1, limits=limits), wrenches, None, None)
    return assembled(stated_on(analysis, question.task, wrenches, None)).largest_margin()


def by_kernel(problems: ConeProblems) -> Answers:
    """Solve by the compiled kernel."""
    found = fast_kernel.solve(problems, Tolerance(), np.full(len(problems), -np.inf))
    return found.x, found.z


def how_sure(problems: ConeProblems, answers: Answers, best: np.ndarray) -> str:
    """Return what the answers are worth."""
    (x, z), some = answers, ~np.isnan(answers[0]).any(axis=1)
    gap = float(np.abs(values(problems, x) - best)[some].max(initial=0.0))
    worst = verifier.outside(problems, problems.b - (problems.A @ x[:, :, None])[:, :, 0])[some].max(initial=0.0)
    told = "-"
    if z is not None:
        told = f"{verifier.judge_optimal(problems, x, z, np.full(x.shape, np.inf)).verified.mean():.0%}"
    return f"{gap:>9.0e} {worst:>9.0e} {told:>8} {int((~some).sum()):>9}"


def main() -> None:
    """Print a line for each way."""
    tasks, runs = (int(text) for text in (*sys.argv[1:], *("60", "3")[len(sys.argv) - 1 :]))
    print(f"{conditions()}\n{tasks} tasks, {runs} runs, all asked for {TOLERANCE:.0e}")
    if find_spec("numba"):
        start = time.process_time()
        fast_kernel.compiled()
        print(f"the compiled kernel was there after {time.process_time() - start:.1f} s, which no figure has in it")
    print(f"{'':>25} {'us each':>9} {'faster':>8} {'gap':>9} {'violation':>9} {'verified':>8} {'no answer':>9}")
    for form in FORMS:
        problems, each = programs(form, tasks), ways()
        things: dict[str, tuple[int, Callable[[], Any]]] = {
            name: (tasks, lambda way=way, problems=problems: way(problems)) for name, way in each.items()
        }
        if find_spec("numba"):
            whole, each["kernel"] = programs(form, MANY), by_kernel
            things["kernel"] = (MANY, lambda whole=whole: by_kernel(whole))
        took, best = in_turns(things, runs), values(problems, clarabel_cold(problems, 1e-9)[0])
        for name, microseconds in took.items():
            sure = how_sure(problems, each[name](problems), best)
            print(f"{form:>7} {name:>17} {microseconds:>9.1f} {took['Clarabel cold'] / microseconds:>8.3g} {sure}",
                  flush=True)  # fmt: skip


if __name__ == "__main__":
    main()
