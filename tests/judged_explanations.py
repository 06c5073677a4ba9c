"""Explanations judged by a second model: what is named first, least changes, and what repairs bring.

    python tests/judged_explanations.py 200 [first seed] [cause ...] [--names]

For every cause, tasks with a plan of which one number is then altered until there is none. `least_changes.py` finds the
least change of every number by itself; where that of the altered number is the smallest, the planner must name it
first. Every certificate and repair is looked at, and every least change compared. With --names only what is named is
looked at, of the tasks that count for it, which takes a third of the time.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))

from altered_numbers import CAUSES, DOWN, size, turned
from least_changes import LeastChanges
from refused_tasks import REFUSED
from too_much import HANDS, Question, altered

from synergrip.changes.asked import Asked
from synergrip.changes.least_change import LeastChange, least_change
from synergrip.changes.turning import dials
from synergrip.explain.explanation import Explanation
from synergrip.explain.repairs import Repair
from synergrip.planning.outcome import Infeasible, Plan
from synergrip.planning.planning import plan

NUMBERS = (
    "friction", "force_cap", "torque", "effort", "synergy_range", "rate", "acceleration", "joint_range", "drift",
    "load", "margin", "amplitude", "tolerance", "elastic",
)  # fmt: skip
SAME = 1e-4
"""Relative difference of least changes."""
TIE = 0.01
LATER = {"friction": 1, "load": 2, "amplitude": 2}
"""What is named after the limits of the user, among changes that tie."""
ON_HANDS = 0.15
MOST_DRAWS = 12
"""Draws for each task that is wanted, at most."""
FARTHEST = 90.0
"""Times its value as far as which both look for a number."""


@dataclass
class Count:
    """What is known of the tasks of one cause."""

    tasks: int = 0
    smallest: int = 0
    first: int = 0
    among_two: int = 0
    compared: int = 0
    worst: float = 0.0
    not_found: int = 0
    """Repairs without a verified plan: only on hands, whose true states break what the linear model promises."""
    wrong: list[str] = field(default_factory=list)

    def row(self, name: str) -> str:
        """Return a line of the table."""
        return (
            f"{name:14} {self.tasks:6} {self.smallest:9} {self.first:6} {self.among_two:10} {self.compared:9} "
            f"{self.worst:9.1e} {len(self.wrong):6} {self.not_found:9}"
        )


HEAD = ("altered", "tasks", "smallest", "first", "among two", "compared", "worst", "wrong", "not found")


def order(factors: dict[str, float]) -> list[str]:
    """Return the numbers that help, the smallest change first; of such as tie a limit before friction and load."""
    left = {name: size(factor) for name, factor in factors.items() if np.isfinite(size(factor))}
    found: list[str] = []
    while left:
        least = min(left.values())
        tied = [name for name, value in left.items() if value <= least * (1 + TIE)]
        found.append(min(tied, key=lambda name: (LATER.get(name, 0), left[name])))
        del left[found[-1]]
    return found


def number_of(cause: str, key: str, eased: str) -> str:
    """Return the number that a change of the planner's is about."""
    if cause == "drift":
        return "elastic" if key == "limits.elastic_motion" else "drift"
    return "floor" if cause == "force_cap" and eased == "down" else cause


def least_of(no: Infeasible) -> Iterator[tuple[str, LeastChange]]:
    """Yield the planner's least change of every number, before it is rounded."""
    asked = Asked.of(no.grasp, no.task, no.task)
    posed = asked.posed(no.analysis)
    assert posed is not None
    program = posed.program()
    for dial in dials(asked, no.task, posed.analysis):
        yield number_of(dial.cause, dial.key, dial.eased), least_change(dial, posed, program)


def brackets(model: LeastChanges, name: str, factor: float) -> bool:
    """Return whether the second model has a plan a little beyond a factor, and none a little short of it."""
    near = (factor * (1 - SAME), factor * (1 + SAME))
    short, beyond = (model.shortfall(name, each) for each in (near[::-1] if name in DOWN else near))
    return bool(short > 0 >= beyond)


def compare(no: Infeasible, factors: dict[str, float], model: LeastChanges, count: Count) -> Iterator[str]:
    """Yield what is wrong with least changes.

    Where the least change that the second model finds by itself is another one, both sides of the planner's decide: its
    solver ends early where the rows change little with the number.
    """
    for name, change in least_of(no):
        if name not in factors:
            continue
        mine = factors[name]
        if np.isnan(mine) or (name not in DOWN and FARTHEST < mine < np.inf):
            continue
        helps = np.isfinite(mine) if name not in DOWN else mine > 1e-6
        if not helps:
            if change.value is not None and change.value > 1e-6 * change.dial.value:
                yield f"{name}: {change.value / change.dial.value:.6g} is said to do, nothing does"
            continue
        if change.value is None and model.shortfall(name, mine * (1 - SAME if name in DOWN else 1 + SAME)) > 0:
            continue  # nor does the second model have a plan there
        if change.value is None:
            yield f"{name}: a factor of {mine:.6g} does, nothing is found"
            continue
        apart = abs(np.log(change.value / change.dial.value / mine))
        if apart > SAME and brackets(model, name, change.value / change.dial.value):
            apart = SAME
        count.worst, count.compared = max(count.worst, apart), count.compared + 1
        if apart > SAME:
            yield f"{name}: {change.value / change.dial.value:.6g} is not {mine:.6g}"


def repaired(repair: Repair, model: LeastChanges, *, on_hand: bool) -> Iterator[str]:
    """Yield what is wrong with a repair, which the second model must find to do, and less not to do."""
    name = number_of(repair.cause, repair.key, "down" if repair.to < repair.was else "up")
    if name not in (*model.names, "friction"):
        return
    factor = repair.to / repair.was
    if not on_hand and not (repair.verified and isinstance(repair.outcome, Plan)):
        yield f"{name}: {repair.set} is not verified"
    if model.shortfall(name, factor) > 1e-7:
        yield f"{name}: {repair.set} leaves no plan"
    if on_hand:
        return  # the hand that moves may need more than the linear model
    if not repair.proven:
        yield f"{name}: nothing is proven short of {repair.set}"
    before = factor * (1.001 if factor < 1 else 0.999)
    if (before - 1) * (factor - 1) > 0 and model.shortfall(name, before) <= 0:
        yield f"{name}: less than {repair.set} does, too"


def named(explanation: Explanation, cause: str) -> tuple[bool, bool]:
    """Return whether a cause is named first, and whether it is among the first two."""
    causes = [repair.cause for repair in explanation.repairs]
    first = explanation.cause == cause and (not causes or causes[0] == cause)
    return first, first or cause in causes[:2]


def judge(question: Question, number: str, count: Count, *, names: bool = False) -> Iterator[str]:
    """Yield what is wrong with the explanation of one task."""
    no = plan(*question)
    model = LeastChanges(*question)
    on_hand = question[0].held is not None
    if not isinstance(no, Infeasible):
        if model.shortfall() > 1e-6 and not on_hand:
            yield f"the verdict is {no.verdict}, and all rows must be wider by {model.shortfall():.1e}"
        return
    factors = model.all_factors()
    if on_hand and not isinstance(plan(*turned(*question, number, _beyond(factors[number]))), Plan):
        return  # the hand that moves has no plan with the number as it was
    count.tasks += 1
    if not no.certificate.verified:
        yield "the certificate does not verify"
    if not names:
        yield from _judged_long(no, factors, model, count, on_hand=on_hand)
    if order(factors)[:1] != [number]:
        return
    count.smallest += 1
    first, among = named(no.explanation, CAUSES.get(number, number))
    count.first, count.among_two = count.first + first, count.among_two + among
    if not among:
        sizes = {name: round(size(factor), 4) for name, factor in factors.items()}
        yield f"{no.explanation.cause} is blamed, {[repair.cause for repair in no.repairs]} repair it; sizes {sizes}"


def _judged_long(
    no: Infeasible, factors: dict[str, float], model: LeastChanges, count: Count, *, on_hand: bool
) -> Iterator[str]:
    """Yield what is wrong with least changes and repairs, and with what the long form blames."""
    yield from compare(no, factors, model, count)
    long = no.explain()
    for repair in long.repairs:
        count.not_found += not repair.verified
        yield from repaired(repair, model, on_hand=on_hand)
    if [no.explanation.cause, *(r.key for r in no.repairs[:1])] != [long.cause, *(r.key for r in long.repairs[:1])]:
        yield f"the short form blames {no.explanation.cause}, the long one {long.cause}"


def _beyond(factor: float) -> float:
    return factor * (1 + 1e-4) if factor > 1 else factor * (1 - 1e-4)


def judge_refused(cause: str, rng: np.random.Generator, count: Count) -> Iterator[str]:
    """Yield what is wrong with the answer to a task that is refused before there is a program."""
    asked = REFUSED[cause](rng)
    if not isinstance(plan(*asked.before), Plan):
        return
    no = plan(*asked.after)
    count.tasks, count.smallest = count.tasks + 1, count.smallest + 1
    if not isinstance(no, Infeasible):
        yield f"the verdict is {no.verdict}"
        return
    if not no.certificate.verified:
        yield "the certificate does not verify"
    first = no.explanation.cause == cause
    count.first, count.among_two = count.first + first, count.among_two + first
    if not first:
        yield f"{no.explanation.cause} is blamed"
    for repair in no.repairs:
        count.compared += 1
        if asked.tolerance is not None:
            apart = repair.to / asked.tolerance - 1
            count.worst = max(count.worst, abs(apart))
            if not 0 <= apart <= 2e-4:
                yield f"a tolerance of {repair.to:.6g} m is not {asked.tolerance:.6g} m"
        if not isinstance(repair.outcome, Plan):
            yield f"{repair.set} leaves no plan"


def judged(cause: str, wanted: int, seed: int, *, names: bool = False) -> Count:
    """Judge tasks of one cause until as many as are wanted have the altered number as the smallest change."""
    count = Count()
    for draw in range(MOST_DRAWS * wanted):
        if count.smallest >= wanted:
            break
        rng = np.random.default_rng([seed, draw, *cause.encode()])
        if cause in REFUSED:
            found = judge_refused(cause, rng, count)
        else:
            hand = str(rng.choice(HANDS)) if rng.uniform() < ON_HANDS else None
            question = altered(rng, cause, hand)
            found = iter(()) if question is None else judge(question, cause, count, names=names)
        for wrong in found:
            count.wrong.append(wrong)
            print(f"  {cause}, draw {draw}: {wrong}", file=sys.stderr, flush=True)
    return count


def main(wanted: int, seed: int, causes: list[str], *, names: bool) -> None:
    """Print the table."""
    print("{:14} {:>6} {:>9} {:>6} {:>10} {:>9} {:>9} {:>6} {:>9}".format(*HEAD), flush=True)
    for cause in causes or [*NUMBERS, *REFUSED]:
        print(judged(cause, wanted, seed, names=names).row(cause), flush=True)


if __name__ == "__main__":
    given = [each for each in sys.argv[1:] if each != "--names"]
    main(int(given[0]), int(given[1]) if len(given) > 1 else 0, given[2:], names="--names" in sys.argv)
