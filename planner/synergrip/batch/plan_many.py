"""Many tasks of one knot planned at once; each answer verified, and what does not verify planned one by one."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterator
from functools import partial
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from synergrip.batch.asked import Asked, asked
from synergrip.batch.chunks import keep_memory, on_threads, threads_asked
from synergrip.batch.decided import Solver, decided
from synergrip.batch.keeping import Answers, Unfinished
from synergrip.batch.kernel import QuickStatics, chosen, name_of, quick_statics, ready, reason
from synergrip.batch.many_plans import ManyPlans
from synergrip.batch.stated import Stated, each_of, stated_each, stated_on
from synergrip.batch.telling import Telling
from synergrip.documents.naming import naming_arguments
from synergrip.errors import Refusal
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.stack import GraspStack
from synergrip.linalg import Array
from synergrip.log import LOG
from synergrip.planning.accuracy import SHOWN
from synergrip.statics.accuracy import shares
from synergrip.statics.analyses import AnalysisGroup, analyses_for_plans
from synergrip.statics.analysis import Analysis, analyse
from synergrip.statics.each import Each
from synergrip.tasks.task import Task
from synergrip.tasks.timed_task import TimedTask

Part = tuple[NDArray[np.intp], Stated, NDArray[np.bool_]]
"""Where among the places of a chunk tasks stand, the tasks, and whose maps are known well enough."""
CHUNK = 2048
"""Tasks that are worked out together: enough to make calls cheap, few enough for memory and for an interrupt."""


@naming_arguments
def plan_many(
    grasp: Grasp | Analysis | GraspStack | list[Grasp],
    task: Task | TimedTask,
    *,
    wrenches: Array | None = None,
    friction_factors: Array | None = None,
    masses: Array | None = None,
    kernel: Literal["numpy", "numba"] | None = None,
    threads: int = 1,
    progress: Callable[[str, float], None] | None = None,
) -> ManyPlans:
    """Plan N tasks of one knot at once, which differ in load, friction, mass of the object, or grasp.

    It answers what ``plan`` does of the linear model at the start posture (`Task(linearise="once")` on a hand), to 1e-6
    of the load: verdicts, the largest margin or the least effort, forces and references. Among plans of the same
    largest margin it takes any, and `plan` the one of least effort. What it does not verify is planned one by one.

    Args:
        grasp: one grasp for all tasks, or its `Analysis`; or a `GraspStack`, or a list, with a grasp for each.
        task: what the tasks have in common: one knot, the object held, ``LargestMargin()``, ``LeastEffort()`` or
            ``LeastPeak()`` as its goal, limits of slip margin, normal force, joint torque, actuator effort, synergy
            reference and joint range. With other limits or goals all are planned one by one, which is told.
        wrenches: (N, 6) load of each, in place of the task's own: force [N] and moment about B [N m] on the object.
        friction_factors: (N,) by which the friction of all contacts is multiplied.
        masses: (N,) of the object [kg], for loads that go by it; for grasps of objects with a mass.
        kernel: what solves the programs: "numba", compiled, of the extra ``synergrip[fast]``; "numpy"; None for the
            first where it is installed and there are tasks enough to repay it: 100,000 to compile it, once on a
            machine (a million grasps for what it does of their statics); from then on 20,000 to load it, and any
            number when it is loaded.
        threads: how many chunks of 2,048 tasks are worked out at a time, on threads of their own; the answers are the
            same to the last digit. One if not told: who plans in several processes at once has no cores left.
        progress: told what is under way and which share of it is done: that a kernel is compiled or loaded, then after
            every 2,048 tasks, and every half second of what is planned one by one.

    Returns:
        arrays with a row for each task (`ManyPlans`). An interrupt (Ctrl-C) keeps the rows that are finished.

    Raises:
        InputError: arguments that do not fit each other, or a task with what is not covered; nothing bounds the goal
            of any task. What is wrong with some tasks alone stands in `refusals`.

    Example:
        >>> import numpy as np
        >>> from synergrip import LargestMargin, NormalForce, Task, load_problem
        >>> grasp = load_problem("tripod").grasp
        >>> task = Task(knots=1, limits=[NormalForce(upper=20.0)], goals=[LargestMargin()])
        >>> many = plan_many(grasp, task, wrenches=np.eye(6)[:3] * 5.0)
        >>> many.verdicts.tolist()
        ['feasible', 'feasible', 'feasible']
    """
    tell = Telling(progress)
    question = asked(grasp, task, wrenches, friction_factors, masses)
    tell_beyond(question)
    return answered(question, kernel=kernel, threads=threads, tell=tell)[0]


def tell_beyond(question: Asked) -> None:
    """Tell the logger what is planned one by one, and why."""
    if question.beyond:
        LOG.warning("%d tasks are planned one by one: %s is not for many at once", question.count, question.beyond)


def answered(
    question: Asked, *, kernel: str | None, threads: int, tell: Telling, level: int = logging.INFO
) -> tuple[ManyPlans, bool]:
    """Return the answers to N tasks, and whether somebody interrupted; arguments as of `plan_many`.

    Args:
        question: the tasks.
        kernel: which one.
        threads: how many.
        tell: how far it is.
        level: at which the logger is told.

    Raises:
        InputError: as of `plan_many`.
    """
    like, found = question.like, Unfinished(question)
    whole = question.grasp if isinstance(question.grasp, Analysis | GraspStack) else analysed(question.grasp)
    solver, many_at_a_time = chosen(question.count, kernel), threads_asked(threads)
    quick = quick_statics(whole, question.count, kernel) if isinstance(whole, GraspStack) else None
    LOG.log(level, "planning %d tasks of one knot on %d contacts with %d synergies by kernel '%s': %s",
            question.count, like.n_c, like.n_z, name_of(solver), reason(question.count, kernel))  # fmt: skip
    chunks = np.split(np.arange(question.count), range(CHUNK, question.count, CHUNK))
    keep_memory()
    interrupted = False
    work = partial(_answers, question, whole, solver=solver, quick=quick)
    try:
        if not question.beyond:
            ready(solver, quick, whole, tell)
        for places, answers in on_threads(chunks, work, many_at_a_time):  # in order, whatever is ready first
            found.keep(places, answers, lambda: tell.seldom("planning", found.finished / question.count))
            tell("planning", (int(places[-1]) + 1) / question.count)
    except KeyboardInterrupt:
        interrupted = True
        LOG.log(level, "interrupted after %d tasks", found.finished)
    many = found.told(name_of(solver))
    LOG.log(level, "%r", many)
    return many, interrupted


def analysed(grasp: Grasp) -> Analysis | None:
    """Return the analysis of a grasp; None where `plan` has to say why there is none."""
    try:
        return analyse(grasp)
    except Refusal:
        return None


def _answers(
    question: Asked,
    whole: Analysis | GraspStack | None,
    places: NDArray[np.intp],
    *,
    solver: Solver,
    quick: QuickStatics | None,
) -> list[Answers]:
    """Return what verifies of the tasks at some places, those of like dimensions together."""
    if question.beyond:
        return []
    stacked = _on_stack(question, whole, places, quick) if isinstance(whole, GraspStack) else _on_one(
        question, whole, places
    )  # fmt: skip
    return [(within, decided(stated, question.wrench[places[within]], solver), known)
            for within, stated, known in stacked]  # fmt: skip


def _on_one(question: Asked, whole: Analysis | None, places: NDArray[np.intp]) -> Iterator[Part]:
    """Yield the tasks at some places on one grasp, if it holds its object and its maps are known well enough."""
    if whole is None or not whole.response.restrained:
        return
    if max(each.doubt for each in whole.response.accuracy.values()) <= SHOWN:
        friction = None if question.friction is None else question.friction[places]
        stated = stated_on(whole, question.task, question.wrench[places], friction)
        yield np.arange(len(places)), stated, np.ones(len(places), dtype=bool)


def _on_stack(
    question: Asked, stack: GraspStack, places: NDArray[np.intp], quick: QuickStatics | None
) -> Iterator[Part]:
    """Yield tasks on grasps of like dimensions: first what is clear by the compiled lanes, if there are any."""
    part, left = stack.taken(slice(int(places[0]), int(places[-1]) + 1)), np.arange(len(places))

    def stated(like: Analysis, each: Each, whose: GraspStack, within: NDArray[np.intp]) -> Stated:
        own = None if question.friction is None else question.friction[places[within]]
        return stated_each(like, each, whose, question.task, question.wrench[places[within]], own)

    if quick is not None and (found := quick(part)) is not None:
        yield found.places, stated(found.like, found.each, found.grasps, found.places), np.ones(len(found.places), bool)
        if len(found.places) == len(left):
            return
        left = np.setdiff1d(left, found.places)
        part = part.taken(left)
    for group in analyses_for_plans(part):
        known, within = _known(group), left[group.places]
        if known.any():
            yield within, stated(group.at(0), each_of(group), group.response.grasps, within), known


def _known(group: AnalysisGroup) -> NDArray[np.bool_]:
    """Return (N,) which grasps hold the object, with maps that are known well enough to be relied on without a word."""
    figures = group.response.figures
    clear = np.all(shares(figures[..., 2:].max(axis=-1), figures) <= SHOWN, axis=-1)
    return np.asarray(clear & (group.response.restraint.ranks == 6))
