"""Motions of the sizes of public in-grasp benchmarks: which a hand follows, and whether the others are possible.

    python tests/benchmarks/in_grasp.py [--hands dlr human allegro] [--motions 100] [--first 0] [--keep FILE]
    python tests/benchmarks/in_grasp.py --table FILE ...

Each motion takes the object 6 to 66 mm (36 in the median) in a random direction and turns it by 2 to 50 degrees (20 in
the median) about a random axis, within 2 s, with all joint ranges and torques and a slip margin of 0.2 N. The wanted
motions are general ones: nothing is projected on what a hand can do. A hand with a few synergies has few rigid motions
and would be refused nearly all of them, so every joint of the fingers that hold is driven, which gives all six
(`grasps_of_reach.py`); what is then not reached is beyond the ranges of the joints.

Prints a line for each motion and one table: what is reached (how far the executed object ends from where it is wanted,
0.6 mm at most in the median; the worst margin that a second execution finds, which shares no code with the planner),
not reached, infeasible or without a verified answer. What is not reached is looked for by a search that shares no code
with the planner either (`second/reach.py`); what is reached is given to it, too: where it does not find that, it proves
nothing. With --keep the results are written to a file, a line each, so that parts may be run one after another.
"Allegro" needs the package example-robot-data.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Iterable, Iterator
from dataclasses import asdict, dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

REPOSITORY = Path(__file__).resolve().parent.parent.parent
sys.path[:0] = [str(REPOSITORY / "tests"), str(Path(__file__).parent)]

from grasps_of_reach import GRASPS  # noqa: E402
from second.reach import Found, Search  # noqa: E402
from second.tree import read_tree  # noqa: E402
from second_execution import executed  # noqa: E402

import synergrip as sg  # noqa: E402
from synergrip.planning.outcome import Outcome, Plan, Unknown  # noqa: E402
from synergrip.problems.problem import Problem  # noqa: E402
from synergrip.reports.data.execution import execution_document  # noqa: E402
from synergrip.reports.data.json_plan import outcome_document  # noqa: E402

KNOTS, DURATION = 21, 2.0
SIZES = (0.0, 20e-3, 40e-3, np.inf)
"""[m] Shares are told for motions up to 20 mm, 20 to 40 mm, and beyond."""


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


@dataclass(frozen=True)
class Result:
    """What became of one motion of a hand."""

    hand: str
    index: int
    size: float  # [m]
    kind: str
    """The verdict of the planner, with the stage of an unknown one."""
    seconds: float
    """Processor time of the plan [s]."""
    found: bool
    """Whether the search reaches it."""
    off: float = np.nan
    """How far the executed object ends from where it is wanted [m]."""
    margin: float = np.nan
    """The worst one that the second execution finds [N]."""


def motions(count: int, seed: int = 7) -> list[Motion]:
    """Return motions of the sizes of the benchmark."""
    rng, found = np.random.default_rng(seed), []
    for _ in range(count):
        size = np.clip(36e-3 * np.exp(0.6 * rng.standard_normal()), 6e-3, 66e-3)
        angle = np.clip(np.radians(20) * np.exp(0.8 * rng.standard_normal()), np.radians(2), np.radians(50))
        along, about = rng.standard_normal((2, 3))
        found.append(Motion(size * along / np.linalg.norm(along), angle * about / np.linalg.norm(about)))
    return found


def planned(problem: Problem, motion: Motion, knots: int = KNOTS) -> Outcome:
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
    return Search(block, read_tree(REPOSITORY / block["hand_file"], block["root_link"], block["joints"]))


def told(answer: Outcome) -> str:
    """Return the kind of an answer."""
    return f"unknown, {answer.stage}" if isinstance(answer, Unknown) else answer.verdict


def off(answer: Plan, motion: Motion) -> float:
    """Return how far the object ends from where it is wanted [m]."""
    assert answer.executed is not None
    return float(np.linalg.norm(answer.executed.du[-1, :3] - motion.shift))


def verified(problem: Problem, answer: Plan) -> float:
    """Return the worst margin of a plan by the second execution; NaN where that does not come to its end [N]."""
    document: dict[str, Any] = json.loads(json.dumps(outcome_document(problem.title, problem.grasp, answer)))
    found = executed(document, REPOSITORY, document["true"]["contact_model"])
    return np.nan if found.ended else float(found.margins.min())


def judged(hand: str, problem: Problem, search: Search, index: int, motion: Motion) -> Result:
    """Plan a motion and look for it; print and return what became of it."""
    start = time.process_time()
    answer = planned(problem, motion)
    seconds, found = time.process_time() - start, search.to(motion.pose)
    ends = (off(answer, motion), verified(problem, answer)) if isinstance(answer, Plan) else (np.nan, np.nan)
    size = float(np.linalg.norm(motion.shift))
    result = Result(hand, index, size, told(answer), round(seconds, 3), found.reached, *ends)
    why = f"margin {result.margin:.4f} N" if isinstance(answer, Plan) else (answer.why or "")[:200]
    print(f"{hand} {index:3} {motion} {result.kind}, {seconds:.1f} s; {_searched(found)}; {why}", flush=True)
    return result


def _searched(found: Found) -> str:
    if found.reached:
        return "the search reaches it"
    return f"the search does not reach it: {1e3 * found.apart:.1f} mm apart, {found.beyond:.3f} beyond"


def table(results: Iterable[Result]) -> Iterator[str]:
    """Yield the lines of the table, a hand each, and of the shares by size."""
    results = list(results)
    hands = [hand for hand in GRASPS if any(result.hand == hand for result in results)]
    yield "| hand | motions | reached (by the search, too) | off their places: median, largest " \
          "| least margin, second execution | not reached | by the search neither | infeasible | other " \
          "| time, median |"  # fmt: skip
    yield "| --- " * 10 + "|"
    for hand in hands:
        yield _row(hand, [result for result in results if result.hand == hand])
    yield from ("", "| hand | " + " | ".join(f"reached, {name}" for name in _names()) + " |", "| --- " * 4 + "|")
    for hand in hands:
        each = [[r for r in results if r.hand == hand and a <= r.size < b]
                for a, b in pairwise(SIZES)]  # fmt: skip
        shares = [f"{sum(r.kind == 'feasible' for r in some)} of {len(some)}" for some in each]
        yield f"| {hand} | {' | '.join(shares)} |"


def _names() -> tuple[str, ...]:
    small, large = (f"{1e3 * size:.0f} mm" for size in SIZES[1:3])
    return f"up to {small}", f"{small} to {large}", f"beyond {large}"


def _row(hand: str, results: list[Result]) -> str:
    reached = [result for result in results if result.kind == "feasible"]
    short = [result for result in results if result.kind == "unknown, reach"]
    no = sum(result.kind == "infeasible" for result in results)
    ends, margins = ([getattr(r, name) for r in reached] or [np.nan] for name in ("off", "margin"))
    cells = [
        hand, len(results), f"{len(reached)} ({sum(r.found for r in reached)})",
        f"{1e3 * np.median(ends):.2f}, {1e3 * max(ends):.2f} mm", f"{min(margins):.3f} N", len(short),
        sum(not result.found for result in short), no, len(results) - len(reached) - len(short) - no,
        f"{np.median([result.seconds for result in results]):.1f} s",
    ]  # fmt: skip
    return f"| {' | '.join(map(str, cells))} |"


def main() -> None:
    """Print a line for each motion, and the table."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--hands", nargs="+", default=["dlr", "human"], choices=list(GRASPS))
    parser.add_argument("--motions", type=int, default=100)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--keep", type=Path)
    parser.add_argument("--table", nargs="+", type=Path)
    asked, results = parser.parse_args(), list[Result]()
    if asked.table:
        lines = [line for file in asked.table for line in file.read_text(encoding="utf-8").splitlines()]
        results = [Result(**json.loads(line)) for line in lines]
    for hand in [] if asked.table else asked.hands:
        problem = GRASPS[hand]()
        search, rigid = searching(problem), sg.analyse(problem.grasp).spaces.Gamma_ucs.shape[1]
        print(f"{hand}: {rigid} of 6 rigid motions")
        for index, motion in enumerate(motions(asked.motions)[asked.first :], asked.first):
            results.append(judged(hand, problem, search, index, motion))
            if asked.keep:
                with asked.keep.open("a", encoding="utf-8") as file:
                    file.write(json.dumps(asdict(results[-1])) + "\n")
    print("\n".join(table(results)))


if __name__ == "__main__":
    main()
