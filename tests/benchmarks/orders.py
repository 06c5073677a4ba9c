"""What later goals of a long trajectory cost beside the first, and how often solvers were run.

    python tests/benchmarks/orders.py [KNOTS ...]

Goals "travel" and "smooth", alone (what they leave open is settled by least effort, unasked) and with "effort" asked
for after them, on the grasp matrices of the start posture: three hard contacts with 4 synergies, and four with 12
actuators. Bounded forces, torques and rates couple the knots. Prints processor time of the first goal's program, that
of all later ones beside it, runs of solvers, what the whole planning takes, by how much memory grows at its peak, and
whether each goal verified; all in one process, one after the other.
"""

from __future__ import annotations

import sys
import time

from peak_memory import grown

from synergrip.conic.program import Program
from synergrip.conic.question import Question
from synergrip.conic.solution import Settings, Solution
from synergrip.planning.outcome import Outcome, Plan
from synergrip.planning.planning import plan_of_start_posture
from synergrip.planning.solvers import SOLVERS
from synergrip.problems.problem import load_problem

GRASPS = {"3 hard contacts": "barrett-ball-hold", "12 actuators": "dlr-ball-move"}
GOALS = {"travel": '"travel"', "smooth": '"smooth"'}
ORDERS = {"travel, effort": ["travel", "effort"], "smooth, effort": ["smooth", "effort"]}
LIMITS = 'limits={margin="0.5 N", normal_force="20 N", joint_torque="hand", synergy_rate=0.5}'


def row(label: str, name: str, goal: str, knots: int) -> str:
    """Return one line of the table."""
    problem = load_problem(name, [f"task.knots={knots}", f"goal={goal}", 'task.between="report"', LIMITS])
    spent: dict[str, float] = {}

    def timed(question: Question, program: Program, settings: Settings) -> Solution:
        start = time.process_time()
        found = SOLVERS["clarabel"](question, program, settings)
        spent[question.goal.name] = spent.get(question.goal.name, 0.0) + time.process_time() - start
        return found

    found: list[Outcome] = []
    start = time.process_time()
    memory = grown(lambda: found.append(plan_of_start_posture(problem.grasp, problem.task, timed)))
    whole, outcome = time.process_time() - start, found[0]
    assert isinstance(outcome, Plan), outcome
    first, *later = spent.values()
    runs = "+".join(str(decision.attempts) for decision in outcome.decisions)
    verified = "all" if all(decision.optimal for decision in outcome.decisions) else "not all"
    cost = f"{first:>9.2f} {sum(later) / first:>9.2f} {runs:>7} {whole:>9.2f} {memory:>6.0f}"
    return f"{label:<32} {knots:>6} {cost}  {verified}"


def main() -> None:
    """Print the table."""
    print(f"{'':<32} {'knots':>6} {'first [s]':>9} {'later':>9} {'runs':>7} {'all [s]':>9} {'MB':>6}  verified")
    for knots in [int(text) for text in sys.argv[1:]] or [501, 2001, 5001]:
        for grasp, name in GRASPS.items():
            for goal, text in GOALS.items():
                print(row(f"{grasp}, {goal}", name, f"{{minimise={text}}}", knots), flush=True)
            for goal, order in ORDERS.items():
                print(row(f"{grasp}, {goal}", name, f"{{order={order}}}", knots), flush=True)


if __name__ == "__main__":
    main()
