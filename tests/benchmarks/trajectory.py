"""What a long trajectory costs: our planning against Clarabel alone, and against the same problem written in CVXPY.

    python tests/benchmarks/trajectory.py [KNOTS ...]

Three hard-finger contacts, bounded synergy rates, and least effort with a price on the travel, so that all knots are
one program. Prints, for each number of knots, processor time per knot of the whole planning (assembly, solution,
certificate, the plan's own checks), its ratio to Clarabel alone on the same program, and, up to 10,000 knots, the
ratios of time and peak memory to the vectorised CVXPY model. Every figure is the least of a few runs in processes of
their own, taken in turns.
"""

from __future__ import annotations

import resource
import subprocess
import sys
import time
from collections.abc import Callable
from typing import TYPE_CHECKING

from synergrip.errors import SynergripError

if TYPE_CHECKING:
    from synergrip.conic.program import Program
    from synergrip.conic.question import Question
    from synergrip.conic.solution import Settings, Solution
    from synergrip.problems.problem import Problem

GOAL = "goal={minimise={effort=1, travel=0.001}}"
BETWEEN = 'task.between="report"'
LIMITS = 'limits={margin="0.5 N", normal_force="20 N", joint_torque="hand", synergy_rate=0.5}'
CVXPY_KNOTS = 10_000
"""More than that takes the CVXPY model minutes."""
RUNS = 5


def measured(run: Callable[[], object]) -> tuple[float, float]:
    """Return processor time [s] and growth of the peak memory [MB] of a call."""
    before, start = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, time.process_time()
    run()
    return time.process_time() - start, (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1e3


def child(what: str, knots: int) -> None:
    """Measure one thing in this process and print time and memory."""
    from synergrip.conic.solution import Settings
    from synergrip.conic.solvers import clarabel_
    from synergrip.planning.outcome import Plan
    from synergrip.planning.planning import plan_of_start_posture as plan
    from synergrip.problems.problem import load_problem
    from synergrip.referee import judge as referee

    problem = load_problem("barrett-ball-hold", [f"task.knots={knots}", GOAL, BETWEEN, LIMITS])
    small = load_problem("barrett-ball-hold", ["task.knots=3", GOAL, BETWEEN, LIMITS])
    warm = plan(small.grasp, small.task)
    assert isinstance(warm, Plan), "the problem is meant to be feasible"
    if what == "plan":
        outcomes: list[object] = []
        print(*measured(lambda: outcomes.append(plan(problem.grasp, problem.task))))
        assert isinstance(outcomes[0], Plan), outcomes[0]
        return
    question = first_question(problem)
    program = question.program()
    if what == "clarabel":
        print(*measured(lambda: clarabel_.solve(program, Settings())))
    else:
        three = first_question(small)
        referee.solve(three, three.program(), Settings())  # CVXPY's own imports are no part of the comparison
        print(*measured(lambda: referee.solve(question, program, Settings())))


class Asked(SynergripError):
    """Carries the question out of the planning before anything is solved."""


def first_question(problem: Problem) -> Question:
    """Return the one question that planning asks of this problem, unanswered: an answer would leave memory behind."""
    from synergrip.planning.planning import plan_of_start_posture as plan

    def stop(question: Question, program: Program, settings: Settings) -> Solution:
        raise Asked(question)

    try:
        plan(problem.grasp, problem.task, stop)
    except Asked as asked:
        question: Question = asked.args[0]
        return question
    raise AssertionError("planning asked nothing")


def figures(knots: int) -> dict[str, tuple[float, float]]:
    """Return least processor time [s] and memory [MB] of each thing that is measured."""
    things = ("plan", "clarabel", *(["cvxpy"] if knots <= CVXPY_KNOTS else []))
    found: dict[str, list[tuple[float, ...]]] = {what: [] for what in things}
    for _ in range(RUNS):
        for what in things:
            command = [sys.executable, __file__, "--child", what, str(knots)]
            output = subprocess.run(command, check=True, capture_output=True, text=True).stdout
            found[what].append(tuple(float(number) for number in output.split()))
    return {what: (min(run[0] for run in runs), min(run[1] for run in runs)) for what, runs in found.items()}


def main() -> None:
    """Print one line for each number of knots."""
    if sys.argv[1:2] == ["--child"]:
        child(sys.argv[2], int(sys.argv[3]))
        return
    print(f"{'knots':>6}  {'ms per knot':>11}  {'/ Clarabel alone':>16}  {'time / CVXPY':>12}  {'memory / CVXPY':>14}")
    for knots in [int(text) for text in sys.argv[1:]] or [100, 1_000, 2_000, 10_000]:
        least = figures(knots)
        ours, alone = least["plan"], least["clarabel"]
        row = f"{knots:>6}  {1e3 * ours[0] / knots:>11.3f}  {ours[0] / alone[0]:>16.2f}"
        if "cvxpy" in least:
            theirs = least["cvxpy"]
            row += f"  {ours[0] / theirs[0]:>12.2f}  {ours[1] / theirs[1]:>14.2f}"
        print(row, flush=True)


if __name__ == "__main__":
    main()
