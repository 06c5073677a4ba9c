"""What plans promise, against the equilibria that a second execution of their references finds.

    python tests/judged_execution.py [COUNT [MODEL [FIRST_SEED [KNOTS]]]]

plans COUNT (100) random variations of the bundled problems on hands: motions of 0.5 to 40 mm and 1 to 30 degrees
along what the synergies can move, or those of the problem; loads and squeezes times 0.3 to 3. Each plan is executed
with round pads that are "rolling" (MODEL) or "fixed", or as the plan says that it was made (when it does). KNOTS is how
many knots they have, where these fit their corners; else as many as the problems. Prints what
became of each: the answer, how long it took, why there is no plan, promised and true margins; and at the end the shares
of the answers and how far the true margins are below the promised ones. A plan is wrong where they differ by more than
0.01 N and 1 % of the largest force, or where its true state misses the asked margin.
"""

from __future__ import annotations

import json
import sys
import time
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))

from second_execution import Executed, between_knots, executed

from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.limits.slip_margin import SlipMargin
from synergrip.errors import SynergripError
from synergrip.planning.outcome import Outcome, Plan, Unknown
from synergrip.planning.planning import plan
from synergrip.problems.finding import bundled_problems
from synergrip.problems.problem import Problem, load_problem
from synergrip.reports.data.json_plan import outcome_document
from synergrip.statics.analysis import analyse
from synergrip.tasks.moves import ModeMove, Moves
from synergrip.tasks.task import Task

REPOSITORY = Path(__file__).parent.parent
SAME, SHARE = 0.01, 0.01
"""How far a promised margin may be from the true one [N], and as a share of the largest force."""
MISSED, MISSED_SHARE = 1e-3, 1e-3
"""By how much the true state of a feasible plan may miss the asked margin."""
SHIFTS, TURNS, FACTORS = (0.5e-3, 40e-3), (np.radians(1), np.radians(30)), (0.3, 3.0)


@dataclass(frozen=True)
class Compared:
    """Promised and true margins of one plan."""

    promised: float
    """Worst margin over contacts and knots [N]."""
    true: float
    """The same of what was reached, NaN when nothing was [N]."""
    difference: float
    """Largest difference of a promised and a true margin at any contact and knot [N]."""
    largest_force: float  # [N]
    reached: float
    """Share of the knots."""
    ended: str | None
    between: float
    """The least true margin at the knots and between them [N]."""

    @property
    def same(self) -> bool:
        """Whether all knots were reached, and the margins are those that were promised."""
        return self.ended is None and self.difference <= max(SAME, SHARE * self.largest_force)

    def keeps(self, margin: float) -> bool:
        """Tell whether the true state keeps an asked margin [N]."""
        return self.ended is None and self.between >= margin - max(MISSED, MISSED_SHARE * self.largest_force)


def compared(promised: np.ndarray, execution: Executed, finer: Executed) -> Compared:
    """Return promised margins (T, n_c) [N] beside the true ones of an execution, of as many knots as it reached.

    Args:
        promised: at the knots.
        execution: at the knots.
        finer: between the knots, too.
    """
    count = len(execution.times)
    off = np.abs(promised[:count] - execution.margins) if count else np.full(1, np.nan)
    largest = np.abs(execution.forces).max() if count else 0.0
    least, between = (float(one.margins.min()) if len(one.times) else np.nan for one in (execution, finer))
    return Compared(
        float(promised.min()), least, float(off.max()), float(largest), count / len(promised),
        execution.ended or finer.ended, between,
    )  # fmt: skip


@dataclass(frozen=True)
class Judged:
    """What became of one variation."""

    title: str
    verdict: str
    """And what could not be shown, when it is "unknown"."""
    seconds: float
    """Processor time of the plan."""
    why: str = ""
    """Why there is no plan."""
    asked: float = 0.0
    """Slip margin that every contact was to keep [N]."""
    moved: float = 0.0
    """How far the object was to move, rotations times the length of the grasp [m]."""
    found: Compared | None = None


def drawn(rng: np.random.Generator, between: tuple[float, float]) -> float:
    """Return a size whose logarithm is evenly distributed."""
    return float(np.exp(rng.uniform(*np.log(between))))


def varied(problem: Problem, rng: np.random.Generator) -> tuple[Task, str]:
    """Return a variation of the task of a problem, and what it is in words."""
    load, squeeze = drawn(rng, FACTORS), drawn(rng, FACTORS)
    limits = [_squeezed(limit, squeeze) for limit in problem.task.limits]
    task = problem.task.replace(load_factor=load, limits=limits)
    told = f"{problem.name}: load x {load:.2f}, squeeze x {squeeze:.2f}"
    modes = analyse(problem.grasp).spaces.Gamma_ucs
    if not modes.shape[1] or rng.uniform() < 0.25:
        return task, told
    twist = modes @ (beta := rng.normal(size=modes.shape[1]))
    shift, turn = drawn(rng, SHIFTS), drawn(rng, TURNS)
    sizes = [size / most for size, most in ((shift, np.linalg.norm(twist[:3])), (turn, np.linalg.norm(twist[3:])))
             if most > 1e-9]  # fmt: skip
    beta, twist = min(sizes) * beta, min(sizes) * twist
    moves = Moves(tuple(ModeMove(mode=i, amplitude=float(size)) for i, size in enumerate(beta, start=1)))
    moved = f"{1e3 * np.linalg.norm(twist[:3]):.1f} mm, {np.degrees(np.linalg.norm(twist[3:])):.1f} deg"
    return task.replace(target=moves, axes=("x", "y", "z", "rx", "ry", "rz"), drift=None), f"{told}, {moved}"


def _squeezed(limit: Limit, factor: float) -> Limit:
    if isinstance(limit, SlipMargin):
        return replace(limit, margin=factor * limit.margin)
    return replace(limit, upper=factor * limit.upper) if isinstance(limit, NormalForce) else limit


def on_hands() -> list[Problem]:
    """Return the bundled problems on hands."""
    return [problem for problem in map(load_problem, bundled_problems()) if problem.held is not None]


def judged(problem: Problem, seed: int, model: str, knots: int | None = None) -> Judged:
    """Plan a variation of a problem, and execute the plan."""
    task, told = varied(problem, np.random.default_rng([11, seed]))
    title, start = f"seed {seed}: {told}", time.process_time()
    try:
        answer = plan(problem.grasp, task if knots is None else task.replace(knots=knots))
    except SynergripError as error:
        return Judged(title, "refused", time.process_time() - start, str(error))
    seconds = time.process_time() - start
    if not isinstance(answer, Plan):
        return Judged(title, verdict_of(answer), seconds, answer.why)
    document: dict[str, Any] = json.loads(json.dumps(outcome_document(problem.title, problem.grasp, answer)))
    model = document.get("true", {}).get("contact_model", model)
    execution = executed(document, REPOSITORY, model)
    finer = executed(between_knots(document, 2), REPOSITORY, model, parts=1)
    length = document["structure"]["characteristic_length_m"]
    size = float(np.linalg.norm(answer.motion.du * [1, 1, 1, length, length, length], axis=1).max())
    return Judged(title, "feasible", seconds, "", answer.task.margin, size, compared(answer.margins, execution, finer))


def verdict_of(answer: Outcome) -> str:
    """Return the verdict of an answer, with the stage of an unknown one."""
    stage = answer.stage if isinstance(answer, Unknown) else ""
    return f"{answer.verdict}, {stage}" if stage else answer.verdict


def told(results: Iterable[Judged]) -> int:
    """Print the distribution of what was promised and is not true, and return how many plans are wrong."""
    results = list(results)
    for verdict, count in Counter(result.verdict for result in results).most_common():
        seconds = [result.seconds for result in results if result.verdict == verdict]
        print(f"{100 * count / len(results):5.1f} %  {verdict}: {count}, in {np.median(seconds):.1f} s of processor "
              f"time (median), {max(seconds):.1f} s at most")  # fmt: skip
    pairs = [(result, result.found) for result in results if result.found is not None]
    wrong = [result for result, found in pairs if not (found.same and found.keeps(result.asked))]
    print(f"{len(pairs)} plans: {sum(found.ended is not None for _, found in pairs)} end before their last knot, "
          f"{sum(found.same for _, found in pairs)} keep within 0.01 N or 1 % of what they promise, "
          f"{sum(found.keeps(result.asked) for result, found in pairs)} keep what was asked")  # fmt: skip
    for low, high in ((0, 1e-3), (1e-3, 3e-3), (3e-3, 1e-2), (1e-2, np.inf)):
        some = [(result, found) for result, found in pairs if low <= result.moved < high]
        if some:
            lost = [found.promised - found.true for _, found in some if found.ended is None]
            shares = np.percentile(lost, (5, 50, 95)) if lost else np.full(3, np.nan)
            print(f"  moved {1e3 * low:g} to {1e3 * high:g} mm: {len(some)} plans, {len(lost)} executed to their end; "
                  f"promised minus true margin 5 %, 50 %, 95 %: {shares.round(4).tolist()} N")  # fmt: skip
    return len(wrong)


def main(count: int = 100, model: str = "rolling", first: int = 0, knots: int | None = None) -> int:
    """Judge variations of seeds first to first + count - 1, and return how many plans are wrong."""
    problems, results = on_hands(), []
    for seed in range(first, first + count):
        results.append(result := judged(problems[seed % len(problems)], seed, model, knots))
        found = result.found
        figures = result.why if found is None else (
            f"promised {found.promised:.4f}, true {found.true:.4f} N, between {found.between:.4f} N, of "
            f"{found.largest_force:.1f} N; off by {found.difference:.4f} N at most; {found.ended or ''}"
        )  # fmt: skip
        judge = "" if found is None or (found.same and found.keeps(result.asked)) else " WRONG"
        print(f"{result.title}: {result.verdict}{judge} in {result.seconds:.1f} s: {figures}", flush=True)
    return told(results)


if __name__ == "__main__":
    words = sys.argv[1:]
    sys.exit(bool(main(*map(int, words[:1]), *words[1:2], *map(int, words[2:4]))))
