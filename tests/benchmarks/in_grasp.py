"""Motions of the sizes of public in-grasp benchmarks: which a hand follows, and whether the others are possible.

    python tests/benchmarks/in_grasp.py [--hands dlr human allegro] [--motions 100] [--first 0]

Each motion takes the object 6 to 66 mm (36 in the median) in a random direction and turns it by 2 to 50 degrees (20 in
the median) about a random axis, within 2 s, with all joint ranges and torques and a slip margin. Prints how many are
planned (and how far the executed object ends from where it is wanted, 0.6 mm at most in the median), not reached,
infeasible or without a verified answer. What is not reached is looked for by a search that shares no code with the
planner (`second/reach.py`); what is reached is given to it, too: where it does not find that, it proves nothing.
"Allegro" needs the package example-robot-data.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter
from dataclasses import dataclass
from importlib.metadata import files
from pathlib import Path

import numpy as np

REPOSITORY = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(REPOSITORY / "tests"))

from second.reach import Found, Search  # noqa: E402
from second.tree import read_tree  # noqa: E402

import synergrip as sg  # noqa: E402
from synergrip.planning.outcome import Outcome, Plan, Unknown  # noqa: E402
from synergrip.problems.problem import Problem  # noqa: E402
from synergrip.reports.data.execution import execution_document  # noqa: E402

KNOTS, DURATION = 21, 2.0
FINGER, THUMB = (0.0, 0.6, 1.0, 0.6), (1.35, 0.3, 0.9, 0.8)
"""[rad] Joint values of the Allegro hand: of each finger, of its thumb."""
ALLEGRO = {
    "schema": 1,
    "object": {"shape": {"sphere": {"radius": "36 mm"}}, "mass": "100 g"},
    "contacts": {"friction": 0.8, "stiffness": "6 N/mm"},
    "contact": [
        {"link": f"link_{joint}.0_tip", "point": ["0 mm", "0 mm", "0 mm"], "radius": "12 mm"} for joint in (15, 3, 11)
    ],
    "task": {"gravity": [0, 0, -9.81]},
    "limits": {"margin": "0.2 N", "normal_force": "20 N"},
}
"""A ball between thumb, first and third finger."""


@dataclass(frozen=True)
class Motion:
    """A wanted displacement of the object."""

    shift: np.ndarray  # (3,) [m]
    turn: np.ndarray  # (3,) rotation vector [rad]

    def __str__(self) -> str:
        """Return its sizes."""
        return f"{1e3 * np.linalg.norm(self.shift):4.1f} mm {np.degrees(np.linalg.norm(self.turn)):4.1f} deg"

    @property
    def pose(self) -> np.ndarray:
        """(6,) [m, rad]."""
        return np.concatenate([self.shift, self.turn])


def motions(count: int, seed: int = 7) -> list[Motion]:
    """Return motions of the sizes of the benchmark."""
    rng, found = np.random.default_rng(seed), []
    for _ in range(count):
        size = np.clip(36e-3 * np.exp(0.6 * rng.standard_normal()), 6e-3, 66e-3)
        angle = np.clip(np.radians(20) * np.exp(0.8 * rng.standard_normal()), np.radians(2), np.radians(50))
        along, about = rng.standard_normal((2, 3))
        found.append(Motion(size * along / np.linalg.norm(along), angle * about / np.linalg.norm(about)))
    return found


def problems(names: list[str]) -> dict[str, Problem]:
    """Return the grasps, as problems that hold the object."""
    found = {
        "dlr": lambda: sg.load_problem("dlr-ball-move"),
        "human": lambda: sg.load_problem("human-ball", ["hand.synergies=all"]),
        "allegro": _allegro,
    }
    return {name: found[name]() for name in names}


def _allegro() -> Problem:
    """Return a ball in the Allegro hand of example-robot-data."""
    (model,) = (file for file in files("example-robot-data") or () if file.name == "allegro_right_hand.urdf")
    values = [*FINGER, *FINGER, *FINGER, *THUMB]
    hand = {
        "model": str(model.locate()), "synergies": "all", "compliance": {"joint": "0.02 rad/(N m)"},
        "posture": {f"joint_{joint}.0": f"{value} rad" for joint, value in enumerate(values)},
    }  # fmt: skip
    return sg.load_problem({**ALLEGRO, "hand": hand})


def planned(problem: Problem, motion: Motion, knots: int) -> Outcome:
    """Return the answer to one motion, with the gravity of the problem and the palm at rest."""
    times, share = np.linspace(0, DURATION, knots), np.linspace(0, 1, knots)
    share = share**3 * (10 - 15 * share + 6 * share**2)
    target = sg.MotionTable(times, np.outer(share, motion.pose))
    loads = [load for load in problem.task.loads if isinstance(load, sg.Gravity)]
    return sg.plan(problem.grasp, problem.task.replace(target=target, knots=knots, loads=loads, duration=None))


def searching(problem: Problem) -> Search:
    """Return the search for postures of a grasp."""
    limits = [limit for limit in problem.task.limits if not isinstance(limit, sg.SlipMargin)]
    hold = sg.plan(problem.grasp, problem.task.replace(target=sg.Hold(), knots=2, limits=limits))
    assert isinstance(hold, Plan), hold
    block = execution_document(hold)
    assert block is not None
    path = Path(block["hand_file"])
    path = path if path.is_absolute() else REPOSITORY / path
    return Search(block, read_tree(path, block["root_link"], block["joints"]))


def told(answer: Outcome) -> str:
    """Return the kind of an answer."""
    return f"unknown, {answer.stage}" if isinstance(answer, Unknown) else answer.verdict


def off(answer: Plan, motion: Motion) -> float:
    """Return how far the object ends from where it is wanted [m]."""
    assert answer.executed is not None
    return float(np.linalg.norm(answer.executed.du[-1, :3] - motion.shift))


def main() -> None:
    """Print a line for each motion, and the counts."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--hands", nargs="+", default=["dlr", "human"])
    parser.add_argument("--motions", type=int, default=100)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--knots", type=int, default=KNOTS)
    asked = parser.parse_args()
    for name, problem in problems(asked.hands).items():
        search, counts, ends, agreed, missed = searching(problem), Counter[str](), list[float](), 0, 0
        for index, motion in enumerate(motions(asked.motions)[asked.first :], asked.first):
            start = time.process_time()
            answer = planned(problem, motion, asked.knots)
            kind, seconds = told(answer), time.process_time() - start
            counts[kind] += 1
            found = search.to(motion.pose)
            if isinstance(answer, Plan):
                ends.append(off(answer, motion))
                missed += not found.reached
            elif kind == "unknown, reach":
                agreed += not found.reached
            print(f"{name} {index:3} {motion} {kind}, {seconds:.1f} s; {_searched(found)}; {_why(answer)}", flush=True)
        print(f"{name}: {', '.join(f'{kind}: {count}' for kind, count in sorted(counts.items()))}")
        if ends:
            print(f"{name}: ends {1e3 * np.median(ends):.2f} mm off in the median, {1e3 * max(ends):.2f} mm at most")
        print(f"{name}: not reached by the search either: {agreed} of {counts['unknown, reach']}; of those reached the "
              f"search misses {missed} of {len(ends)}")  # fmt: skip


def _searched(found: Found) -> str:
    if found.reached:
        return "the search reaches it"
    return f"the search does not reach it: {1e3 * found.apart:.1f} mm apart, {found.beyond:.3f} beyond"


def _why(answer: Outcome) -> str:
    return f"margin {answer.margins.min():.3f} N" if isinstance(answer, Plan) else (answer.why or "")[:200]


if __name__ == "__main__":
    main()
