"""What planning along the motion changes and costs, on the bundled problems of hands.

    python tests/benchmarks/along.py [PROBLEM ...]

Prints for each problem: the worst slip margin that a plan of the start posture promises and the one that the hand then
really keeps (executed with rolling pads); the worst margin of the plan along the motion, at its knots and between them;
how often it was linearised anew, and its processor time relative to that of the plan of the start posture.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable

from synergrip.files import bundled
from synergrip.planning.executing import Executor
from synergrip.planning.outcome import Outcome, Plan, Unknown
from synergrip.planning.planning import plan
from synergrip.problems.problem import load_problem


def timed(run: Callable[[], Outcome]) -> tuple[float, Outcome]:
    """Return the processor time [s] of a call, and what it returns."""
    start = time.process_time()
    found = run()
    return time.process_time() - start, found


def told(answer: Outcome) -> str:
    """Return the margins of a plan, or why there is none."""
    if isinstance(answer, Plan):
        between = answer.between.usages[0].value.min() if answer.between is not None else answer.margins.min()
        return f"{answer.margins.min():>8.3f}  {between:>8.3f}  {answer.passes:>6}"
    return f"{answer.verdict}, {answer.stage}" if isinstance(answer, Unknown) else answer.verdict


def main() -> None:
    """Print one line for each problem."""
    names = sys.argv[1:] or sorted(path.stem for path in bundled("problems").glob("*.toml"))
    print(f"{'problem':28}  {'knots':>5}  {'promised':>8}  {'true':>8}  {'along':>8}  {'between':>8}  passes  time")
    for name in names:
        problem = load_problem(name)
        if problem.grasp.held is None:
            continue
        plan(problem.grasp, problem.task)  # imports
        seconds, once = timed(lambda problem=problem: plan(problem.grasp, problem.task))
        if not isinstance(once, Plan):
            print(f"{name:28}  {once.verdict}")
            continue
        executed = Executor.of(once.analysis, once.task).run(once.time, once.dz_r, once.task.wrench, once.motion)
        task = problem.task.replace(linearise="along")
        longer, along = timed(lambda problem=problem, task=task: plan(problem.grasp, task))
        promised, true = once.margins.min(), executed.margins.min()
        ratio = f"x{longer / seconds:.1f}"
        print(f"{name:28}  {len(once.time):>5}  {promised:>8.3f}  {true:>8.3f}  {told(along)}  {ratio}", flush=True)


if __name__ == "__main__":
    main()
