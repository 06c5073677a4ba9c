"""Coupled trajectories: the banded interior point beside Clarabel on the same programs.

    python tests/benchmarks/coupled.py [KNOTS ...]

Random grasps of 3 hard contacts with 5 synergies and of 4 soft ones with 8, fingers of three joints; a load that turns;
bounded normal forces, torques, rates and accelerations of the references, which bind; goals with squares (effort and
travel), with a scalar (largest margin, least peak). Prints processor time of both (medians of runs that take turns,
set-up included), Clarabel with our settings and as it comes, all asked for 1e-9, the ratio to the faster of the two,
how far the objectives are apart, beside 1 or themselves, and the growth of peak memory, each in a process of its own.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from statistics import median

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
import numpy as np

sys.path.insert(0, str(Path(__file__).parent.parent))
from named_goals import goals
from peak_memory import grown
from random_cone_problems import grasp_like

from synergrip.conic.decide import judge
from synergrip.conic.goals.goal import Goal
from synergrip.conic.limits.joint_torque import JointTorque
from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.limits.synergy_acceleration import SynergyAcceleration
from synergrip.conic.limits.synergy_rate import SynergyRate
from synergrip.conic.program import Program
from synergrip.conic.question import Question
from synergrip.conic.solution import Settings, Solution
from synergrip.conic.solvers import banded_, clarabel_
from synergrip.errors import SynergripError
from synergrip.linalg import frozen
from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan_of_start_posture
from synergrip.statics.analysis import Analysis, analyse
from synergrip.tasks.timed_task import TimedTask, still

FORMS = {"3 hard": (["hard"] * 3, 5), "4 soft": (["soft"] * 4, 8)}
GOALS = {
    "effort, travel": goals("weighted", weights={"effort": 1.0, "travel": 1e-3}),
    "margin": goals("margin"), "peak": goals("peak_force"),
}  # fmt: skip
SOLVERS: dict[str, Callable[[Program, Settings], Solution | None]] = {
    "banded": banded_.solve, "clarabel": clarabel_.solve,
    "as it comes": lambda program, settings: clarabel_.solve(program, Settings(equilibrate=True)),
}  # fmt: skip
RUNS, COARSE = 3, 41
RATE, ACCELERATION = 0.9, 3.0
"""Of what the least effort without these limits uses: its largest rate, and that over a tenth of the duration."""


class Asked(SynergripError):
    """Carries the program out of the planning before anything is solved."""


def _task(knots: int, waves: np.ndarray, limits: tuple[Limit, ...], goal: tuple[Goal, ...]) -> TimedTask:
    times = np.linspace(0.0, 2.0, knots)
    angle = np.pi * times[:, None]
    wrench = np.sin(angle) * waves[0] + np.cos(angle) * waves[1]
    return TimedTask(frozen(times), frozen(wrench), still(times), 0.05, limits, goal)


def posed(form: str, goal: str, knots: int, seed: int = 0) -> tuple[Analysis, TimedTask]:
    """Return a random grasp and its task, which has a plan without bounds on rates."""
    kinds, n_z = FORMS[form]
    rng = np.random.default_rng(seed)
    limits = (NormalForce(0.0, 20.0), JointTorque(0.5))
    while True:
        analysis = analyse(grasp_like(rng, kinds, n_z))
        waves = rng.normal(size=(2, 6)) * [1.0, 1.0, 1.0, 0.02, 0.02, 0.02]
        easy = plan_of_start_posture(analysis, _task(COARSE, waves, limits, goals("effort")))
        if isinstance(easy, Plan):
            rate = float(np.abs(np.diff(easy.dz_r, axis=0)).max()) / float(np.diff(easy.time)[0])
            bounds = (SynergyRate(RATE * rate), SynergyAcceleration(ACCELERATION * rate / 0.2))
            return analysis, _task(knots, waves, (*limits, *bounds), GOALS[goal])


def program_of(form: str, goal: str, knots: int, seed: int = 0) -> Program:
    """Return the first program that planning asks for."""

    def stop(question: Question, program: Program, settings: Settings) -> Solution:
        raise Asked(program)

    try:
        plan_of_start_posture(*posed(form, goal, knots, seed), stop)
    except Asked as asked:
        program: Program = asked.args[0]
        return program
    raise AssertionError("planning asked nothing")


def memory(solver: str, form: str, goal: str, knots: int) -> None:
    """Print by how much one solution lets the memory of this process grow [MB]."""
    SOLVERS[solver](program_of(form, goal, 201), Settings())
    program = program_of(form, goal, knots)
    print(grown(lambda: SOLVERS[solver](program, Settings())))


def row(form: str, goal: str, knots: int) -> str:
    """Return one line of the table."""
    program = program_of(form, goal, knots)
    spent: dict[str, list[float]] = {name: [] for name in SOLVERS}
    found: dict[str, Solution] = {}
    for _ in range(RUNS):
        for name, solve in SOLVERS.items():
            start = time.process_time()
            solution = solve(program, Settings())
            spent[name].append(time.process_time() - start)
            assert solution is not None
            found[name] = solution
    ours, theirs, default = (1e6 * median(each) / knots for each in spent.values())
    values = [program.objective(each.x) for each in found.values()]
    apart = abs(values[0] - values[1]) / max(1.0, abs(values[1]))
    verified = "/".join("yes" if judge(program, each).verified else "no" for each in found.values())
    iterations = "/".join(str(each.iterations) for each in found.values())
    command = [sys.executable, __file__, "--memory"]
    grown = [
        float(subprocess.run([*command, name, form, goal, str(knots)], check=True, capture_output=True).stdout)
        for name in ("banded", "clarabel")
    ]
    ratio = min(theirs, default) / ours
    return (
        f"{form:<7} {goal:<15} {knots:>6} {ours:>7.0f} {theirs:>9.0f} {default:>12.0f} {ratio:>6.2f} "
        f"{iterations:>10} {apart:>8.0e} {verified:>12} {grown[0]:>7.0f} {grown[1]:>9.0f}"
    )


def main() -> None:
    """Print the table."""
    if sys.argv[1:2] == ["--memory"]:
        solver, form, goal, knots = sys.argv[2:]
        memory(solver, form, goal, int(knots))
        return
    print(
        f"{'':<7} {'us a knot':<15} {'knots':>6} {'banded':>7} {'Clarabel':>9} {'as it comes':>12} {'ratio':>6} "
        f"{'iterations':>10} {'apart':>8} {'verified':>12} {'MB':>7} {'Clarabel':>9}"
    )
    for knots in [int(text) for text in sys.argv[1:]] or [200, 1_000, 10_000]:
        for form in FORMS:
            for goal in GOALS:
                print(row(form, goal, knots), flush=True)


if __name__ == "__main__":
    main()
