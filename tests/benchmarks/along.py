"""What planning along the motion changes and costs, on the bundled problems of hands.

    python tests/benchmarks/along.py [--knots] [PROBLEM ...]

Prints for each problem: the worst slip margin that a plan of the start posture promises and the one that the hand then
really keeps (executed with rolling pads); the worst margin of the plan along the motion, at its knots and between them;
how often it was linearised anew, and its processor time relative to that of the plan of the start posture: first as it
is made, then as `linearise = "once"` gives it, which is executed, too, before it is shown (the least of `TIMES` each,
by turns); with the knots of the problem, and with --knots also with 41 and with 401, where so many fit its corners.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable

import numpy as np

from synergrip.errors import InputError
from synergrip.files import bundled
from synergrip.grasps.grasp import Grasp
from synergrip.planning.executing import Executor
from synergrip.planning.outcome import Outcome, Plan, Unknown
from synergrip.planning.planning import plan, plan_of_start_posture
from synergrip.problems.problem import load_problem
from synergrip.tasks.task import Task

TIMES, COUNTS = 5, (41, 401)
"""How often each plan is timed, and knots that all problems are timed with."""


def seconds(run: Callable[[], Outcome]) -> float:
    """Return the processor time [s] of a call."""
    start = time.process_time()
    run()
    return time.process_time() - start


def ratio(grasp: Grasp, task: Task) -> str:
    """Return the time of a plan along the motion relative to the two of the start posture; "-" where there is none."""
    once = task.replace(linearise="once")
    runs = (lambda: plan_of_start_posture(grasp, task), lambda: plan(grasp, once), lambda: plan(grasp, task))
    try:
        bare, executed, along = np.min([[seconds(run) for run in runs] for _ in range(TIMES)], axis=0)
    except InputError:  # a corner that is on no knot
        return f"{'-':>12}"
    return f"{f'x{along / bare:.1f}':>5}  {f'x{along / executed:.1f}':>5}"


def told(answer: Outcome) -> str:
    """Return the margins of a plan, or why there is none."""
    if isinstance(answer, Plan):
        between = answer.between.usages[0].value.min() if answer.between is not None else answer.margins.min()
        return f"{answer.margins.min():>8.3f}  {between:>8.3f}  {answer.passes:>6}"
    return f"{answer.verdict}, {answer.stage}" if isinstance(answer, Unknown) else answer.verdict


def main() -> None:
    """Print one line for each problem."""
    counts = COUNTS if "--knots" in sys.argv else ()
    names = [name for name in sys.argv[1:] if name != "--knots"] or sorted(
        path.stem for path in bundled("problems").glob("*.toml")
    )
    times = ["   time   once", *(f"{f'at {count}':>7}   once" for count in counts)]
    columns = f"{'promised':>8}  {'true':>8}  {'along':>8}  {'between':>8}  passes" + "".join(times)
    print(f"{'problem':28}  {'knots':>5}  {columns}")
    for name in names:
        problem = load_problem(name)
        if problem.grasp.held is None:
            continue
        task = problem.task.replace(linearise="along")
        along = plan(problem.grasp, task)
        once = plan_of_start_posture(problem.grasp, task)
        if not isinstance(once, Plan):
            found = told(along) if isinstance(along, Plan) else along.verdict
            print(f"{name:28}  {len(along.task.times):>5}  {'-':>8}  {'-':>8}  {found}", flush=True)
            continue
        executed = Executor.of(once.analysis, once.task).run(once.time, once.dz_r, once.task.wrench, once.motion)
        promised, true = once.margins.min(), executed.margins.min()
        ratios = [ratio(problem.grasp, each) for each in (task, *(task.replace(knots=count) for count in counts))]
        print(
            f"{name:28}  {len(once.time):>5}  {promised:>8.3f}  {true:>8.3f}  {told(along)}  {'  '.join(ratios)}",
            flush=True,
        )


if __name__ == "__main__":
    main()
