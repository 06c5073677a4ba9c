"""The fewest synergies for a task: what it comes to with the first k of a set, and with the best k."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from synergrip.documents.judging import Arguments, described, is_whole, is_word
from synergrip.documents.naming import made_by, naming_arguments
from synergrip.errors import InputError, one_of
from synergrip.explain.synergies.best_subsets import Best, Search, Told
from synergrip.explain.synergies.needed_points import NeededPoint, Pointed
from synergrip.explain.synergies.subset_values import GOALS, Looking
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.other_synergies import of_whole_set
from synergrip.statics.analysis import analyse
from synergrip.tasks.task import Task
from synergrip.tasks.timed_task import TimedTask
from synergrip.tasks.timing import at_start
from synergrip.tasks.tracking import in_motions
from synergrip.values import Value

MOST = 500
"""Subsets of a size up to which all of them are looked at."""
LARGEST = 1_000_000
"""What that may be at most: days."""


@made_by("synergies_needed(grasp, task)")
@dataclass(frozen=True, eq=False, repr=False)
class SynergiesNeeded(Value):
    """How many synergies a task takes, and which.

    Example:
        >>> needed.fewest, needed.minimal  # doctest: +SKIP
        (5, (('pc1', 'pc2', 'pc3', 'pc4', 'pc6'),))
    """

    set: str
    """Name of the synergy set; empty for a grasp given as matrices."""
    synergies: tuple[str, ...]
    first: tuple[NeededPoint, ...]
    """With the first 1, 2, ... synergies of the set."""
    best: tuple[NeededPoint, ...]
    """With the best 1, 2, ... of them."""
    by: str
    """What the best is best by: the largest margin, the least effort or the least peak force."""
    fewest: int | None
    """The fewest with which there is a plan; None where none was found."""
    proven: bool
    """Whether it is certified that fewer have none: of all subsets of each size below."""
    minimal: tuple[tuple[str, ...], ...]
    """Subsets of that size with a plan, none of whose synergies can be left out."""
    all_minimal: bool
    """Whether these are all of that size."""
    refuted: tuple[tuple[int, int], ...]
    """For each size below: how many subsets were looked at, and of how many it is certified that there is no plan."""
    model: str
    """"start": the linear model of the start posture; "along": the hand that moves, for verdicts and figures."""
    interrupted: bool


@naming_arguments
def synergies_needed(
    grasp: Grasp, task: Task | TimedTask, *, by: str = "peak_force", most: int = MOST, up_to: int | None = None,
    along: bool = False, told: Told = lambda size, done, of: None,
) -> SynergiesNeeded:  # fmt: skip
    """Return what a task comes to with 1, 2, ... synergies: the first k of the set that the grasp's are of, the best k.

    An interrupt keeps what is found.

    Args:
        grasp: the grasp; of a hand the whole named set is looked at, of which it may have a part.
        task: what is asked; a wish in modes is that of the grasp as it is.
        by: what makes a subset better than another with a plan: "margin", "effort" or "peak_force". Of those without
            one, that whose largest margin, or whose rigid motions, fall short by least.
        most: all subsets of a size are looked at when they are no more than this; else the best is looked for by adding
            one synergy to the best of one less, and exchanging one at a time.
        up_to: the largest k; all when None.
        along: whether verdicts and figures are those of the hand that moves; subsets are compared in the linear model
            of the start posture all the same.
        told: hears how many subsets of which size were looked at.

    Raises:
        InputError: a task that does not fit the grasp, or an argument that is none.
        NotRestrainedError: the contacts leave the object a free motion, whatever the synergies are.

    Example:
        >>> synergies_needed(grasp, task).first[0].verdict  # doctest: +SKIP
        'infeasible'
    """
    _judge(grasp, task, by, most, up_to, along, told)
    timed = task.timed(grasp) if isinstance(task, Task) else task.on(grasp)
    own = at_start(grasp, timed.wrench[0])
    timed = in_motions(analyse(own, timed.wrench), timed)
    whole, origins = of_whole_set(own)
    if up_to is not None and not 1 <= up_to <= whole.n_z:
        raise InputError.at("up_to", f"expected 1 to {whole.n_z}, the number of synergies, got {up_to}")
    timed = replace(timed.for_synergies(origins), linearise="along" if along else "once")
    pointed = Pointed(whole, timed, along)
    search = Search(Looking(whole, timed, by), most, told)
    first, best, sizes, interrupted = list[NeededPoint](), list[NeededPoint](), list[Best](), False
    minimal: tuple[tuple[int, ...], ...] = ()
    try:
        for size in range(1, (up_to or whole.n_z) + 1):
            first.append(pointed.at(tuple(range(size))))
            found = search.best(size, sizes[-1].tried if sizes else None)
            sizes.append(found)
            best.append(pointed.at(found.tried.picks, every=found.every))
        minimal = _minimal(search, sizes)
    except KeyboardInterrupt:
        interrupted = True
        minimal = minimal or _with_plan(sizes)
    return _needed(whole, timed, by, along, (first, best), sizes, minimal, interrupted)


def _judge(grasp: object, task: object, by: object, most: object, up_to: object, along: object, told: object) -> None:
    judge = Arguments("")
    judge.one("grasp", grasp, Grasp, "make_grasp(...)")
    if not isinstance(task, Task | TimedTask):
        judge.refuse("task", f"expected a Task, got {described(task)}")
    if not is_word(by, GOALS):
        judge.refuse("by", one_of(by, GOALS))
    for name, number in (("most", most), *([] if up_to is None else [("up_to", up_to)])):
        if not is_whole(number) or not 1 <= number <= LARGEST:
            judge.refuse(name, f"expected a whole number from 1 to {LARGEST}, got {described(number)}")
    if not isinstance(along, bool):
        judge.refuse("along", f"expected True or False, got {described(along)}")
    if not callable(told):
        judge.refuse("told", f"expected a function of three numbers, got {described(told)}")
    judge.finish()


def _minimal(search: Search, sizes: Sequence[Best]) -> tuple[tuple[int, ...], ...]:
    """Return the smallest subsets with a plan, after leaving out what can be where not all subsets were looked at."""
    found = _with_plan(sizes)
    if not found:
        return ()
    size = len(found[0])
    if size == 1 or sizes[size - 2].none_has_a_plan:
        return found
    fewer = search.reduced(search.at(found[0]))
    return found if len(fewer.picks) == size else (fewer.picks,)


def _with_plan(sizes: Sequence[Best]) -> tuple[tuple[int, ...], ...]:
    return next((size.with_plan for size in sizes if size.with_plan), ())


def _needed(
    grasp: Grasp, task: TimedTask, by: str, along: bool, points: tuple[list[NeededPoint], list[NeededPoint]],
    sizes: Sequence[Best], minimal: Sequence[tuple[int, ...]], interrupted: bool,
) -> SynergiesNeeded:  # fmt: skip
    fewest = len(minimal[0]) if minimal else None
    below = sizes[: fewest - 1] if fewest else sizes
    # where no synergy yields, more never take a plan away: what has none has none with fewer either
    decisive = below if np.any(grasp.C_z) else below[-1:]
    named = tuple(tuple(grasp.synergies[i] for i in picks) for picks in minimal)
    known = fewest is not None and fewest <= len(sizes) and sizes[fewest - 1].every
    return SynergiesNeeded(
        grasp.held.synergies.name if grasp.held is not None else "", grasp.synergies, tuple(points[0]),
        tuple(points[1]), by, fewest, all(size.none_has_a_plan for size in decisive), named, known,
        tuple((size.looked_at, size.refuted) for size in below), "along" if along else "start", interrupted,
    )  # fmt: skip
