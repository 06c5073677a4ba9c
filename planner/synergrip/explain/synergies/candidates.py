"""Columns that somebody has: what planning a task says with S extended by them."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from synergrip.errors import SynergripError
from synergrip.explain.synergies.brief_judge import Verdict
from synergrip.explain.synergies.further_columns import Further, Subset
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.other_synergies import extended, of_set
from synergrip.hands.hand import SynergySet
from synergrip.hands.synergies.matrix import ALL, JOINTS
from synergrip.hands.synergies.select import select
from synergrip.linalg import Array
from synergrip.planning.outcome import Infeasible, Outcome
from synergrip.tasks.timed_task import TimedTask
from synergrip.values import Value

MOVES_NOT = ("direction", "count")
"""Stages at which a motion is refused before its forces are looked at."""
INTERRUPTED = "interrupted; these candidates are finished"
Judge = Callable[[Grasp, TimedTask], Outcome | Verdict]
"""What judges a task on a grasp: `plan`, or the linear model alone."""


@dataclass(frozen=True, eq=False, repr=False)
class Candidate(Value):
    """Columns that somebody has, and what planning the task with them says."""

    set: str
    """The synergy set that they are of, or "joints": joints that are let move by themselves."""
    names: tuple[str, ...]
    verdict: str
    """"feasible", "infeasible" or "unknown", of the task with S extended by them."""
    stage: str
    """Of a verdict that is not feasible: what is in the way now; else empty."""
    why: str
    """The same in words; else empty."""
    setting: str
    """The KEY=VALUE that chooses them in a problem file; empty where none does."""
    whole: bool = False
    """Whether they are all synergies of a set, in place of those that the grasp has."""


@dataclass(frozen=True, eq=False, repr=False)
class Extending(Value):
    """A task without a plan, to be planned with further synergies."""

    no: Infeasible
    judge: Judge

    def outcome(self, names: Sequence[str], columns: Array) -> Outcome | Verdict | SynergripError:
        """Return what becomes of the task, or the error that it ends in.

        Args:
            names: of the further synergies.
            columns: (n_q, k) of them.
        """
        grasp = extended(self.no.grasp, names, columns)
        origins = [*range(self.no.grasp.n_z), *([None] * len(names))]
        try:
            return self.judge(grasp, self.no.task.for_synergies(origins))
        except SynergripError as error:
            return error

    def verdict(self, names: Sequence[str], columns: Array) -> str:
        """Return the verdict alone; arguments as of `outcome`."""
        return _verdict(self.outcome(names, columns))

    def candidate(self, further: Further, picks: Subset) -> Candidate:
        """Return some of further columns as a candidate with its verdict."""
        names = tuple(further.names[i] for i in picks)
        outcome = self.outcome(names, further.columns[:, list(picks)])
        stage, why = _reason(outcome)
        return Candidate(further.set, names, _verdict(outcome), stage, why, self._setting(further, names))

    def in_place(self, chosen: SynergySet) -> Candidate:
        """Return all synergies of a set of the hand in place of those that there are, with the verdict."""
        grasp, origins = of_set(self.no.grasp, chosen)
        try:
            outcome: Outcome | Verdict | SynergripError = self.judge(grasp, self.no.task.for_synergies(origins))
        except SynergripError as error:
            outcome = error
        setting = f"hand.synergies={json.dumps(ALL if chosen.name == JOINTS else chosen.name, ensure_ascii=False)}"
        stage, why = _reason(outcome)
        return Candidate(chosen.name, chosen.synergies, _verdict(outcome), stage, why, setting, whole=True)

    def _setting(self, further: Further, names: tuple[str, ...]) -> str:
        """Return what to write into a problem file, where names of one set of the hand say it."""
        grasp, held = self.no.grasp, self.no.grasp.held
        if held is None or not further.ours:
            return ""
        every = (*grasp.synergies, *names)
        try:
            again = select(held.hand, every).S
        except SynergripError:
            return ""
        added = further.columns[:, [further.names.index(name) for name in names]]
        listed = ", ".join(json.dumps(name, ensure_ascii=False) for name in every)
        return f"hand.synergies=[{listed}]" if np.array_equal(again, np.hstack([grasp.S, added])) else ""


def in_place_of(extending: Extending) -> Candidate | None:
    """Return the first set of the hand whose synergies, in place of those that there are, have a plan; joints last."""
    grasp = extending.no.grasp
    sets = () if grasp.held is None else grasp.held.hand.synergy_sets.values()
    others = [each for each in sets if len(each.S) == grasp.n_q and not np.array_equal(each.S, grasp.S)]
    for chosen in sorted(others, key=lambda each: each.name == JOINTS):
        found = extending.in_place(chosen)
        if found.verdict == "feasible":
            return found
    return None


def judged(
    extending: Extending, subsets: Iterable[tuple[Further, Subset]], most: int
) -> tuple[tuple[Candidate, ...], tuple[str, ...]]:
    """Return candidates with their verdicts, those with a plan first, and notes where not all were looked at.

    An interrupt keeps those that are finished.

    Args:
        extending: who judges them.
        subsets: the candidates.
        most: how many are planned with.
    """
    found, notes = list[Candidate](), tuple[str, ...]()
    try:
        for further, picks in subsets:
            if len(found) == most:
                notes = (f"there are more candidates than the {most} that were planned with",)
                break
            each = extending.candidate(further, picks)
            if each.stage not in MOVES_NOT:  # a rank that rounding decided
                found.append(each)
    except KeyboardInterrupt:
        notes = (INTERRUPTED,)
    return tuple(sorted(found, key=lambda each: each.verdict != "feasible")), notes


def _reason(outcome: Outcome | Verdict | SynergripError) -> tuple[str, str]:
    """Return the stage of a verdict that is not feasible, and why."""
    why = str(outcome) if isinstance(outcome, SynergripError) else getattr(outcome, "why", "")
    return getattr(outcome, "stage", ""), why


def _verdict(outcome: Outcome | Verdict | SynergripError) -> str:
    return "unknown" if isinstance(outcome, SynergripError) else outcome.verdict
