"""Synergies that are missing: the fewest columns of S that make a task possible, and who has such columns."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from synergrip.documents.judging import Arguments
from synergrip.documents.naming import made_by, naming_arguments
from synergrip.explain.synergies.brief_judge import briefly
from synergrip.explain.synergies.candidates import INTERRUPTED, Candidate, Extending, Judge, in_place_of, judged
from synergrip.explain.synergies.further_columns import Further, Subset, further_columns, repairing
from synergrip.explain.synergies.lacking import Lacking, lacking
from synergrip.explain.synergies.lacking_forces import columns_of, helping, plan_of_all_joints
from synergrip.hands.hand import SynergySet
from synergrip.linalg import Array, canonical, frozen
from synergrip.planning.outcome import Infeasible
from synergrip.planning.planning import plan, plan_of_start_posture
from synergrip.tasks.tracking import in_motions
from synergrip.values import Value

Notes = tuple[str, ...]
MOST = 12
"""Candidates that are planned with."""
NAME = "missing"
"""Columns that no file names are called missing1, missing2, ..."""


@made_by("missing_synergies(no)")
@dataclass(frozen=True, eq=False, repr=False)
class MissingSynergies(Value):
    """What must be added to S at least, for a task that has no plan.

    Example:
        >>> missing = missing_synergies(no)  # doctest: +SKIP
        >>> missing.count, missing.columns.shape, [each.names for each in missing.candidates]  # doctest: +SKIP
        (1, (8, 1), [('spread',)])
    """

    count: int | None
    """The fewest columns; 0 when synergies are not what is missing, None when none help or none were found."""
    proven: bool
    """Whether it is certain that fewer do not do, or, where the count is None, that none do."""
    columns: Array
    """(n_q, count) joint motions [rad or m], an orthonormal basis of those of least norm that, appended to S, do."""
    verdict: str
    """Of planning the task with these columns; empty when there are none, and in the short form of an explanation."""
    joints: tuple[str, ...]
    """Names of the rows."""
    candidates: tuple[Candidate, ...]
    """Columns of the hand's synergy sets, and joints by themselves, of each set the fewest that will do."""
    why: str
    """All of it in a sentence."""
    notes: tuple[str, ...] = ()
    """Where not everything was looked at."""


@naming_arguments
def missing_synergies(
    no: Infeasible, *, forces: Array | None = None, most: int = MOST, sets: Sequence[SynergySet] = (),
    judge: Judge = plan,
) -> MissingSynergies:  # fmt: skip
    """Return the fewest joint-space columns that, appended to S, make a task possible that has no plan.

    Where the wanted motion is outside Gamma_ucs (stages "direction" and "count"), the number is a rank: that of what
    the motion takes modulo the range of J S. Where limits are in the way (stage "magnitude") a program of all joints
    tells whether synergies can help at all, and columns are tried. An interrupt while candidates are planned with keeps
    those that are judged, with a note.

    Args:
        no: the proof that there is no plan.
        forces: (n_l, k) directions of internal force that are to be controlled, too.
        most: candidates that are planned with, at most.
        sets: synergy sets that the hand does not name, such as those of files, to be looked at as well.
        judge: what plans the task with S extended.

    Raises:
        InputError: no proof that there is no plan, or forces that do not fit the contacts.

    Example:
        >>> missing_synergies(no).count  # doctest: +SKIP
        1
    """
    asked = Arguments("")
    asked.one("no", no, Infeasible, "what plan(grasp, task) returns where there is no plan")
    asked.finish()
    if forces is not None:
        count = np.shape(forces)[1] if np.ndim(forces) == 2 else 1
        forces = asked.array("forces", forces, (no.grasp.n_l, count), ": a column for each direction")
        asked.finish()
    return _looked_for(no, forces, most, sets, judge)


def missing_briefly(no: Infeasible, most: int) -> MissingSynergies:
    """Return the same, candidates judged by one program of the start posture each, and the least columns not at all."""
    return _looked_for(no, None, most, (), briefly, columns_too=False)


def another_set(no: Infeasible) -> MissingSynergies | None:
    """Return the set of the hand with whose synergies, in place of those that there are, a task has a plan, if any."""
    found = in_place_of(Extending(no, plan))
    if found is None:
        return None
    nothing, why = frozen(np.zeros((no.grasp.n_q, 0))), "the synergies of another set control what is asked for"
    return MissingSynergies(None, False, nothing, "", no.grasp.joints, (found,), why)


def _looked_for(
    no: Infeasible, forces: Array | None, most: int, sets: Sequence[SynergySet], judge: Judge, *,
    columns_too: bool = True,
) -> MissingSynergies:  # fmt: skip
    """Return what is missing; `columns_too`: whether those of least norm are judged as well."""
    analysis = no.analysis
    if analysis is None:
        return _none(no, 0, "the object is not held, whatever the synergies are")
    no = replace(no, task=in_motions(analysis, no.task))
    lack = lacking(analysis, no.task, forces)
    if lack.beyond:
        text = f"no synergies help: the motion is {lack.beyond:.3g} m outside what all {no.grasp.n_q} joints can follow"
        return _none(no, None, text)
    if lack.forces_beyond:
        return _none(no, None, f"no synergies help: not even all {no.grasp.n_q} joints control these forces")
    if lack.count:
        return _by_rank(no, lack, judge, most, sets, columns_too=columns_too)
    if no.stage != "magnitude":
        return _none(no, 0, "the synergies can follow the motion")
    return _by_planning(no, judge, most, sets)


def _by_rank(
    no: Infeasible, lack: Lacking, judge: Judge, most: int, sets: Sequence[SynergySet], *, columns_too: bool
) -> MissingSynergies:
    """Return the columns of least norm, and those of the hand's own that do."""
    extending, notes = Extending(no, judge), list[str]()
    columns = canonical(np.hstack([each.least_columns(_weights(no)) for each in lack.lacks]))

    def subsets() -> Iterator[tuple[Further, Subset]]:
        for further in further_columns(no.grasp, sets):
            found = repairing(further, lack.lacks)
            if not found.smallest:
                notes.append(f"of '{further.set}' fewer may do than the {len(found.picks[0])} that are named")
            yield from ((further, picks) for picks in found.picks)

    verdict = extending.verdict(_names(columns), columns) if columns_too else ""
    candidates, more = judged(extending, subsets(), most)
    candidates, more = _with_whole_set(extending, candidates, more) if columns_too else (candidates, more)
    why = f"{_synergies(lack.count)} missing: what is asked for takes {lack.count} more than J S reaches"
    told = (*notes, *more)
    return MissingSynergies(lack.count, lack.proven, columns, verdict, no.grasp.joints, candidates, why, told)


def _by_planning(no: Infeasible, judge: Judge, most: int, sets: Sequence[SynergySet]) -> MissingSynergies:
    """Return columns with which the limits can be kept."""
    every = plan_of_all_joints(no)
    if isinstance(every, Infeasible):
        return _none(
            no, None, f"no synergies help: with all {no.grasp.n_q} joints, each by itself, there is no plan either"
        )
    extending = Extending(no, judge)
    columns, verdict = frozen(np.zeros((no.grasp.n_q, 0))), ""
    for tried in columns_of(every, no, _weights(no)) if every is not None else ():
        if Extending(no, plan_of_start_posture).verdict(_names(tried), tried) == "feasible":
            columns, verdict = tried, extending.verdict(_names(tried), tried)
            break
    candidates, notes = judged(extending, helping(no, further_columns(no.grasp, sets)), most)
    sizes = [*(len(each.names) for each in candidates), *([columns.shape[1]] if verdict else [])]
    count = min(sizes, default=None)
    will = f"{_synergies(count)} more will do in the linear model" if count else "none were found that will do"
    why = f"the limits can be kept when all joints move by themselves; {will}"
    candidates, notes = _with_whole_set(extending, candidates, notes)
    return MissingSynergies(count, count == 1, columns, verdict, no.grasp.joints, candidates, why, notes)


def _with_whole_set(
    extending: Extending, found: tuple[Candidate, ...], notes: Notes
) -> tuple[tuple[Candidate, ...], Notes]:
    """Return candidates, and where none with a plan can be chosen in a problem file a set of the hand that has one."""
    if INTERRUPTED in notes or any(each.verdict == "feasible" and each.setting for each in found):
        return found, notes
    try:
        whole = in_place_of(extending)
    except KeyboardInterrupt:
        return found, (*notes, INTERRUPTED)
    return (found if whole is None else (*found, whole)), notes


def _none(no: Infeasible, count: int | None, why: str) -> MissingSynergies:
    return MissingSynergies(count, True, frozen(np.zeros((no.grasp.n_q, 0))), "", no.grasp.joints, (), why)


def _names(columns: Array) -> list[str]:
    return [f"{NAME}{i + 1}" for i in range(columns.shape[1])]


def _synergies(count: int) -> str:
    return "1 synergy" if count == 1 else f"{count} synergies"


def _weights(no: Infeasible) -> Array:
    """Return (n_q,) by what joint motions are measured: slides over the length of the grasp, as radians."""
    held, analysis = no.grasp.held, no.analysis
    if held is None or analysis is None:
        return np.ones(no.grasp.n_q)
    length = analysis.response.scale.length
    return np.array([1 / length if joint.kind == "slide" else 1.0 for joint in held.hand.joints])
