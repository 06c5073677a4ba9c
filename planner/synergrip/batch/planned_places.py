"""Which of some places of an object is the first at which the plan that is asked for holds."""

from __future__ import annotations

import re
import time
from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from synergrip.errors import SelfCheckError, SynergripError
from synergrip.grasps.grasp import Grasp
from synergrip.planning.outcome import Infeasible, Outcome, Plan, Unknown
from synergrip.planning.planning import plan
from synergrip.tasks.task import Task

LONG = 60.0
"""[s] after which it is planned at no further place."""
LONG_WHY = 200
"""Letters of a reason beyond which no further clause of it is shown."""
PLANNING = "planning at the best places of the object"
MEANT = {
    "restraint": "the object is not held", "count": "too many motions for the synergies",
    "direction": "the motion is out of reach of the synergies", "magnitude": "limits are too tight",
    "reach": "the hand does not follow the motion", "execution": "the hand that moves does not do what is planned",
    "solver": "nothing that was solved verifies",
}  # fmt: skip
"""Stage of a no -> what it means."""


@dataclass(frozen=True)
class Candidate:
    """A place at which all contacts touch."""

    grasp: Grasp
    task: Task
    margin: float
    """[N] The largest slip margin in the linear model of the posture there; -inf where a load is not held."""


@dataclass(frozen=True)
class PlannedPlace:
    """A place, and what came of planning there and at better ones."""

    grasp: Grasp
    margin: float  # [N], as of a `Candidate`
    outcome: Outcome | None
    """What `plan` says there; None where it refuses the task."""
    planned: int
    """How many places were planned at."""
    note: str = ""
    """Which places were set aside, and why."""


def first_that_holds(candidates: Iterable[Candidate], most: int, tell: Callable[[str, float], None]) -> PlannedPlace:
    """Return the first of some places, best first, at which the task has a plan; else the first one.

    Each is judged by `plan` itself, so that what is chosen is what a user is told of afterwards. After a minute no
    further one is planned at.

    Args:
        candidates: at least one; each is made when it is its turn.
        most: how many they may be, for telling how far it is.
        tell: told what is under way and which share of it is done.

    Raises:
        KeyboardInterrupt: somebody interrupted a plan.
        SelfCheckError: a defect of synergrip.
    """
    tried, begun = list[tuple[Candidate, Outcome | None]](), time.monotonic()
    for candidate in candidates:
        tell(PLANNING, len(tried) / most)
        tried.append((candidate, _planned(candidate)))
        if isinstance(tried[-1][1], Plan) or time.monotonic() - begun > LONG:
            break
    tell(PLANNING, 1.0)
    last, outcome = tried[-1]
    if isinstance(outcome, Plan):
        aside = [no for _, no in tried[:-1]]
        return PlannedPlace(last.grasp, last.margin, outcome, len(tried), _set_aside(aside))
    best, outcome = tried[0]
    late = len(tried) < most and time.monotonic() - begun > LONG
    return PlannedPlace(best.grasp, best.margin, outcome, len(tried), _nowhere([no for _, no in tried], late=late))


def _planned(candidate: Candidate) -> Outcome | None:
    try:
        outcome = plan(candidate.grasp, candidate.task)
    except SelfCheckError:
        raise
    except SynergripError:  # what is wrong with the task is told by whoever plans
        return None
    if isinstance(outcome, Plan) and outcome.interrupted:
        raise KeyboardInterrupt
    return outcome


def _set_aside(nos: list[Outcome | None]) -> str:
    """Return how many better places were set aside, and why."""
    if not nos:
        return ""
    were = "1 place was" if len(nos) == 1 else f"{len(nos)} places were"
    return (
        f"{were} set aside that would be better by the start posture, because no plan holds there: {_why(nos)}"
        f"{_of_the_best(nos)}"
    )


def _nowhere(nos: list[Outcome | None], *, late: bool) -> str:
    """Return that no plan holds at any place, and why."""
    if late:
        ends = "; after a minute of that no other place was planned at, and this is the best one by the start posture"
    elif len(nos) == 1:
        ends = "; no other place that was found is far from it and holds the load"
    else:
        ends = "; this is the best one by the start posture"
    where = "there" if len(nos) == 1 else f"at any of the {len(nos)} best places that are far from each other"
    return f"no plan holds {where}: {_why(nos)}{ends}{_of_the_best(nos)}"


def _why(nos: list[Outcome | None]) -> str:
    """Return what came of planning at some places, in words, the most frequent first."""
    counted = Counter(_words(no) for no in nos).most_common()
    return "; ".join(f"{words} (at {count})" if len(nos) > 1 else words for words, count in counted)


def _of_the_best(nos: list[Outcome | None]) -> str:
    """Return what `plan` says at the first of some places."""
    no = nos[0]
    return f". At the best one: {first_clauses(no.why)}" if isinstance(no, Infeasible | Unknown) else ""


def first_clauses(text: str) -> str:
    """Return the first clauses of a text, each whole: at least one, and no more than are short together."""
    told = ""
    for clause in re.split(r"(?<=[;.]) ", text):
        if told and len(told) + len(clause) > LONG_WHY:
            break
        told = f"{told} {clause}".lstrip()
    return told.rstrip(";.")


def _words(no: Outcome | None) -> str:
    if no is None:
        return "the task is refused"
    assert isinstance(no, Infeasible | Unknown)
    return f"{no.verdict}, {MEANT.get(no.stage, no.stage)}"
