"""Many tasks of one knot planned at once; each answer verified, and what does not verify planned one by one."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from synergrip.batch.asked import Asked, asked
from synergrip.batch.chunks import keep_memory, on_threads, threads_asked
from synergrip.batch.decided import Decided, Solver, decided
from synergrip.batch.kernel import QuickStatics, chosen, quick_statics
from synergrip.batch.many_plans import FEASIBLE, INFEASIBLE, ManyPlans, Unfinished
from synergrip.batch.stated import Stated, each_of, stated_each, stated_on
from synergrip.documents.naming import naming_arguments
from synergrip.errors import InputError, Refusal, RigidContactError, SelfCheckError
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.stack import GraspStack
from synergrip.linalg import Array
from synergrip.log import LOG
from synergrip.planning.accuracy import SHOWN
from synergrip.planning.outcome import Infeasible, Plan
from synergrip.planning.planning import plan_of_start_posture
from synergrip.statics.analyses import AnalysisGroup, analyses_for_plans
from synergrip.statics.analysis import Analysis, analyse
from synergrip.statics.each import Each
from synergrip.statics.response import shares
from synergrip.tasks.task import Task
from synergrip.tasks.timed_task import TimedTask

Answers = tuple[NDArray[np.intp], Decided, NDArray[np.bool_]]
"""Where among the places of a chunk tasks stand, what verified of them, and whose maps are known well enough."""
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
        masses: (N,) of the object [kg], for loads that go by it; for a grasp of an object with a mass.
        kernel: what solves the programs: "numba", compiled, of the extra ``synergrip[fast]``; "numpy"; None for the
            first where it is installed and there are tasks enough to repay it: 200,000 to compile it, once on a
            machine (a million grasps for what it does of their statics); from then on 20,000 to load it, and any
            number when it is loaded.
        threads: how many chunks of 2,048 tasks are worked out at a time, on threads of their own; the answers are the
            same to the last digit. One if not told: who plans in several processes at once has no cores left.
        progress: told what is under way and which share of it is done, after every 2,048 tasks.

    Returns:
        arrays with a row for each task. An interrupt (Ctrl-C) keeps the rows that are finished.

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
    question = asked(grasp, task, wrenches, friction_factors, masses)
    like, found = question.like, Unfinished(question.count, question.like.n_c, question.like.n_l, question.like.n_z)
    whole = question.grasp if isinstance(question.grasp, Analysis | GraspStack) else analysed(question.grasp)
    solver, many_at_a_time = chosen(question.count, kernel), threads_asked(threads)
    quick = quick_statics(question.count, kernel) if isinstance(whole, GraspStack) else None
    LOG.info("planning %d tasks of one knot on %d contacts with %d synergies", question.count, like.n_c, like.n_z)
    chunks = np.split(np.arange(question.count), range(CHUNK, question.count, CHUNK))
    if question.beyond:
        LOG.warning("%d tasks are planned one by one: %s is not for many at once", question.count, question.beyond)
    keep_memory()
    work = partial(_answers, question, whole, solver=solver, quick=quick)
    try:
        for places, answers in on_threads(chunks, work, many_at_a_time):  # in order, whatever is ready first
            _keep(question, places, answers, found)
            if progress is not None:
                progress("planning", (int(places[-1]) + 1) / question.count)
    except KeyboardInterrupt:
        LOG.info("interrupted after %d tasks", int(found.flags["finished"].sum()))
    many = replace(found.told(), notes=question.notes)
    LOG.info("%r", many)
    return many


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


def _keep(question: Asked, places: NDArray[np.intp], answers: list[Answers], found: Unfinished) -> None:
    """Fill in the answers of a chunk, and plan one by one what has none."""
    open_ = np.ones(len(places), dtype=bool)
    for within, each, known in answers:
        _fill(found, places[within], each, known)
        open_[within] = ~(known & (each.feasible | each.infeasible))
    alone = not open_.all()  # what is wrong with every task is raised
    for place in places[open_].tolist():
        _one_by_one(question, place, found, refusing=alone)
        alone |= place in found.refusals or bool(found.flags["verified"][place])
    found.flags["finished"][places] = True


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


def _fill(found: Unfinished, places: NDArray[np.intp], answers: Decided, known: NDArray[np.bool_]) -> None:
    feasible, infeasible = answers.feasible & known, answers.infeasible & known
    found.verdicts[places[feasible]], found.verdicts[places[infeasible]] = FEASIBLE, INFEASIBLE
    right = feasible | infeasible
    found.flags["verified"][places] = right
    for name, values in found.numbers.items():
        values[places[right]] = getattr(answers, name)[right]


def _one_by_one(question: Asked, place: int, found: Unfinished, *, refusing: bool) -> None:
    """Let `plan` answer a task: the same model, one program at a time; `refusing`, what it raises is kept."""
    found.flags["one_by_one"][place] = True
    try:
        outcome: Any = plan_of_start_posture(question.grasp_at(place), question.task_at(place))
    except InputError as error:
        rigid = isinstance(error, RigidContactError) and isinstance(question.grasp, GraspStack)
        if not (refusing or rigid):
            raise
        found.refusals[place] = error
        return
    except SelfCheckError as error:  # of one task: the others keep their answers
        LOG.warning("task %d: %s", place, error)
        found.refusals[place] = error
        return
    found.verdicts[place] = outcome.verdict
    found.flags["verified"][place] = not isinstance(outcome, Plan) or outcome.decisions[-1].optimal
    found.flags["verified"][place] &= isinstance(outcome, Plan | Infeasible)
    if isinstance(outcome, Plan | Infeasible) and outcome.largest_margin is not None:
        found.numbers["largest_margin"][place] = outcome.largest_margin
    if isinstance(outcome, Plan):
        for name in ("margins", "forces", "dz_r"):
            found.numbers[name][place] = getattr(outcome, name)[0]
