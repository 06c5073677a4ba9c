"""What plans promise, against what a physics engine makes of them.

    python tests/judged_playing.py [FIRST [LAST [half]]]

plans bundled problems and variations of them (`CASES`, from FIRST to LAST) along the motion, plays each plan in MuJoCo
by `synergrip simulate`, and prints promised and played margin, how far the object is from where the plan has it, and
how far contacts slipped; beside it the same of the plan of the start posture, whatever that is worth. "half" plays the
plan along the motion with half the step, too. A plan is wrong where the smallest margin is off by more than 0.05 N and
2 % of the largest force, the motion by more than 0.15 mm, or where a contact slips.
"""

from __future__ import annotations

import sys
import time
from dataclasses import dataclass
from unittest.mock import patch

import numpy as np

from synergrip.planning.outcome import Plan
from synergrip.planning.planning import plan
from synergrip.problems.problem import Problem, load_problem
from synergrip.simulation.simulation import Simulation, simulate

SAME, SHARE = 0.05, 0.02
"""How far the worst margin may be from the promised one [N], and the share of the largest force that is added."""
MOTION = 1.5e-4
"""How far the object may be from where the plan has it [m]."""


@dataclass(frozen=True)
class Case:
    """A bundled problem, and what is different."""

    name: str
    overrides: tuple[str, ...] = ()

    @property
    def problem(self) -> Problem:
        """The problem."""
        return load_problem(self.name, overrides=list(self.overrides))

    def __str__(self) -> str:
        """Return how it is planned from the command line."""
        return " ".join([self.name, *(f"--set '{override}'" for override in self.overrides)])


CASES = (
    Case("gripper-peg"),
    Case("gripper-box"),
    Case("gripper-box", ("task.move[0].lift=3 mm",)),
    Case("gripper-box", ("task.move[0].lift=-15 mm", "limits.margin=0.3 N")),
    Case("gripper-box", ("task.move[0].lift=-6 mm", "limits.margin=1 N", "object.mass=400 g")),
    Case("barrett-ball-lift-joints"),
    Case("barrett-ball-lift-joints", ("task.move[0].lift=-10 mm", "limits.margin=0.3 N")),
    Case("barrett-ball-lift-joints", ("task.move[0].lift=5 mm", "task.move[1].roll=8 deg", "limits.margin=1 N")),
    Case("barrett-ball-roll"),
    Case("barrett-ball-carry", ("object.mass=300 g",)),
    Case("dlr-ball-lift-free"),
    Case("dlr-ball-move"),
    Case("dlr-ball-move", ("task.move[0].lift=-4 mm", "limits.margin=0.3 N")),
    Case("dlr-ball-move", ("task.move[0].lift=1 mm", "task.move[1].roll=8 deg", "object.mass=450 g")),
    Case("dlr-ball-corners"),
    Case("human-ball"),
    Case("human-ball", ("task.move[0].lift=5 mm", "object.mass=100 g")),
    Case("human-ball-near", ("limits.margin=0.4 N",)),
    Case("human-glass"),
    Case("human-glass-set-down"),
    Case("robonaut-handle-knock"),
    Case("brown-asada-ball"),
    Case("utah-mit-ball"),
)


@dataclass(frozen=True)
class Judged:
    """A plan that was played."""

    promised: float  # [N] smallest margin
    played: float  # [N]
    largest: float  # [N] largest force of the plan
    off: float
    """[m] of the object, at most."""
    simulation: Simulation

    @property
    def agrees(self) -> bool:
        """Whether the engine does what the plan promises."""
        same = abs(self.played - self.promised) <= SAME + SHARE * self.largest
        return same and self.off <= MOTION and self.simulation.verdict == "held"

    def __str__(self) -> str:
        """Return promise and play in a line."""
        slip, half = 1e3 * float(self.simulation.slip.max(initial=0.0)), self.simulation.half_step
        told = f"promised {self.promised:.3f} N, played {self.played:.3f} of {self.largest:.1f}"
        finer = "" if half is None else f", half the step {half[0]:.3f} N {1e3 * half[1]:.3f} mm"
        return f"{told}, off {1e3 * self.off:.3f} mm, slid {slip:.3f} mm{finer}, {self.simulation.verdict}"


def judged(answer: Plan, *, half_step: bool = False) -> Judged:
    """Play a plan."""
    found = simulate(answer, half_step=half_step)
    largest = float(np.abs(np.array(answer.forces)).max())
    return Judged(found.promised_worst, found.worst[0], largest, found.motion_error[0], found)


def linear(problem: Problem) -> Plan:
    """Return the plan of the start posture as the linear model has it, not executed."""
    with patch("synergrip.planning.walked.on_the_hand", lambda answer, *rest: answer):
        answer = plan(problem.grasp, problem.task.replace(linearise="once"))
    assert isinstance(answer, Plan), answer
    return answer


def main(first: int = 0, last: int = len(CASES) - 1, half: str = "") -> int:
    """Judge some of the cases, and return how many plans are wrong."""
    wrong = 0
    for number, case in enumerate(CASES[first : last + 1], start=first):
        start, problem = time.perf_counter(), case.problem
        answer = plan(problem.grasp, problem.task.replace(linearise="along"))
        if not isinstance(answer, Plan):
            print(f"{number} {case}\n    along: {answer}", flush=True)
            continue
        found = judged(answer, half_step=half == "half")
        wrong += not found.agrees
        shift, turn = (np.linalg.norm(answer.motion.du[:, part], axis=1).max() for part in (slice(0, 3), slice(3, 6)))
        print(f"{number} {case}: {1e3 * shift:.1f} mm, {np.degrees(turn):.1f} deg")
        print(f"    along: {found}{'' if found.agrees else ' WRONG'}", flush=True)
        print(f"    once:  {judged(linear(problem))}; {time.perf_counter() - start:.0f} s", flush=True)
    print(f"{wrong} plans along the motion are not what the engine makes of them")
    return wrong


if __name__ == "__main__":
    sys.exit(bool(main(*map(int, sys.argv[1:3]), *sys.argv[3:4])))
