"""How far many tasks are from their end at once: how slippery, how heavy, how much load, each by verified answers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from synergrip.batch.asked import Asked, asked, object_masses
from synergrip.batch.many_margins import ManyMargins
from synergrip.batch.margin_search import Search, Tried, Turned
from synergrip.batch.plan_many import analysed, tell_beyond
from synergrip.batch.telling import Telling
from synergrip.documents.judging import is_word
from synergrip.documents.naming import naming_arguments
from synergrip.errors import InputError, one_of
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.stack import GraspStack
from synergrip.linalg import Array
from synergrip.log import LOG
from synergrip.statics.analysis import Analysis
from synergrip.tasks.task import Task
from synergrip.tasks.timed_task import TimedTask

Number = Literal["critical_friction_scale", "heaviest_kg", "load_factor"]
NUMBERS: tuple[str, ...] = get_args(Number)


@naming_arguments
def margins_many(
    grasp: Grasp | Analysis | GraspStack | list[Grasp],
    task: Task | TimedTask,
    *,
    of: Number,
    wrenches: Array | None = None,
    friction_factors: Array | None = None,
    masses: Array | None = None,
    kernel: Literal["numpy", "numba"] | None = None,
    threads: int = 1,
    progress: Callable[[str, float], None] | None = None,
) -> ManyMargins:
    """Return how far N tasks of one knot may go, each between a verified plan and a proof that there is none.

    It is the number that ``margins`` calls by the same name, of the linear model at the start posture. Values are tried
    as by `plan_many` for all tasks that are open at once; where the next one is tried, the largest margins tell.
    Of a task that has no plan as it is the number is looked for on the easier side: a load factor below 1, a friction
    scale above 1.

    Args:
        grasp: as of `plan_many`.
        task: as of `plan_many`; its goal is of no account.
        of: "critical_friction_scale": the least factor of all friction with a plan; "load_factor": the largest factor
            of the whole load; "heaviest_kg": the largest mass of the object [kg], for loads that go by it.
        wrenches: (N, 6) load of each [N, N m].
        friction_factors: (N,) by which friction is multiplied beside the number that is looked for.
        masses: (N,) of the object [kg]; for "heaviest_kg" where to begin, which makes no difference to what is found
            but for those that are too light for a load that pushes up.
        kernel: as of `plan_many`.
        threads: as of `plan_many`.
        progress: told what is under way and which share of it is done; how many values will be tried is guessed.

    Returns:
        arrays with a row for each task (`ManyMargins`), and what nan stands for. An interrupt (Ctrl-C) keeps what is
        found.

    Raises:
        InputError: arguments that do not fit each other, or what `plan_many` does not cover.

    Example:
        >>> from synergrip import NormalForce, Task, load_problem
        >>> grasp = load_problem("tripod").grasp
        >>> pull = np.eye(6)[:3] * 5.0
        >>> task = Task(knots=1, limits=[NormalForce(upper=20.0)])
        >>> found = margins_many(grasp, task, of="load_factor", wrenches=pull)
        >>> found.proven.tolist()
        [True, True, True]
    """
    if not is_word(of, NUMBERS):
        raise InputError.at("of", one_of(of, NUMBERS))
    told = Telling(progress)
    question = asked(grasp, task, wrenches, friction_factors, masses)
    begun, twice = np.ones(question.count), question.wrench
    if of == "heaviest_kg":
        begun = _masses(question, task, masses)
        question = asked(question.grasp, task, wrenches, friction_factors, begun)
        twice = asked(question.grasp, task, wrenches, friction_factors, 2 * begun).wrench
    if isinstance(question.grasp, Grasp):
        question = replace(question, grasp=analysed(question.grasp) or question.grasp)
    tell_beyond(question)
    LOG.info("finding %s of %d tasks of one knot", of, question.count)
    search = Search(of, begun, told)
    tried = Tried(question, _turned(of, twice), Telling(search.heard), {"kernel": kernel, "threads": threads})
    found = search.run(tried)
    LOG.info("%r", found)
    return found


def _masses(question: Asked, task: Any, masses: Array | None) -> Array:
    """Return (N,) masses to begin with [kg]."""
    own = object_masses(question.grasp) if masses is None else np.asarray(masses, dtype=float)
    if not isinstance(task, Task) or own is None or not np.all(own > 0):
        needs = "'heaviest_kg' needs grasps on an object that has a mass, and a Task whose loads go by it"
        raise InputError.at("of", f'{needs}; of="load_factor" asks how much of any load they hold')
    return np.broadcast_to(own, question.count).copy()


def _turned(of: str, twice: Array) -> Turned:
    """Return what turns the number.

    Args:
        of: which.
        twice: (N, 6) loads with twice the mass.
    """

    def slippery(own: Asked, places: NDArray[np.intp], factors: Array) -> Asked:
        return replace(own, friction=factors if own.friction is None else own.friction * factors)

    def loaded(own: Asked, places: NDArray[np.intp], factors: Array) -> Asked:
        return replace(own, wrench=own.wrench * factors[:, None])

    def heavy(own: Asked, places: NDArray[np.intp], factors: Array) -> Asked:
        return replace(own, wrench=own.wrench + (factors[:, None] - 1.0) * (twice[places] - own.wrench))

    return {"critical_friction_scale": slippery, "load_factor": loaded, "heaviest_kg": heavy}[of]
