"""How far many tasks are from their end at once: how slippery, how heavy, how much load, each by verified answers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from synergrip.batch.asked import Asked, asked
from synergrip.batch.many_plans import FEASIBLE, INFEASIBLE, ManyPlans
from synergrip.batch.plan_many import analysed, plan_many
from synergrip.conic.goals.goal import Goal
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.documents.judging import is_word
from synergrip.documents.naming import made_by, naming_arguments
from synergrip.errors import InputError, one_of
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.stack import GraspStack
from synergrip.linalg import Array
from synergrip.statics.analysis import Analysis
from synergrip.tasks.task import Task
from synergrip.tasks.timed_task import TimedTask
from synergrip.values import Value

Number = Literal["critical_friction_scale", "heaviest_kg", "load_factor"]
NUMBERS: tuple[str, ...] = get_args(Number)
CLOSE = 4e-7
"""Share of a number that may be left between a value with a plan and one that is proven to have none."""
FAR = 2.0**24
"""How many times what it is a number is looked for."""
STEP = 4.0
MOST = 60
"""Times that values are tried; nearly all numbers are found in 12."""


@made_by("margins_many(grasp, task, of='load_factor')")
@dataclass(frozen=True, eq=False, repr=False)
class ManyMargins(Value):
    """A number of N tasks in the linear model at the start posture, in the order they were asked.

    Example:
        >>> loads, limits = [Gravity((0, 0, -9.81))], [NormalForce(upper=20.0)]
        >>> still = task.replace(knots=1, loads=loads, limits=limits, linearise="once")
        >>> found = margins_many(grasp, still, of="load_factor")
        >>> bool(found.proven.all()), bool((found.upper - found.lower <= 1e-6 * found.value).all())
        (True, True)
    """

    of: str
    """Which number it is."""
    value: Array
    """(N,) the last value with a verified plan; nan where the task as it is has none, or no end was found."""
    lower: Array  # (N,)
    upper: Array
    """(N,) the number is between `lower` and `upper`: one of them is `value`, the other is proven to have no plan."""
    proven: NDArray[np.bool_]
    """(N,) whether both ends are verified and no more than 1e-6 of the value apart."""

    def __len__(self) -> int:
        """Return N."""
        return len(self.value)

    def __repr__(self) -> str:
        """Return what there is, and its range."""
        found = self.value[np.isfinite(self.value)]
        span = f", from {found.min():.6g} to {found.max():.6g}" if found.size else ""
        return f"ManyMargins({self.of} of {len(self)} tasks: {int(self.proven.sum())} proven{span})"


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
) -> ManyMargins:
    """Return how far N tasks of one knot may go, each between a verified plan and a proof that there is none.

    It is the number that ``margins`` calls by the same name, of the linear model at the start posture. Values are tried
    by `plan_many` for all tasks that are still open at once; where the next one is tried, the largest margins tell.

    Args:
        grasp: as of `plan_many`.
        task: as of `plan_many`; its goal is of no account.
        of: "critical_friction_scale": the least factor of all friction with a plan; "load_factor": the largest factor
            of the whole load; "heaviest_kg": the largest mass of the object [kg], for loads that go by it.
        wrenches: (N, 6) load of each [N, N m].
        friction_factors: (N,) by which friction is multiplied beside the number that is looked for.
        masses: (N,) of the object [kg]; for "heaviest_kg" where to begin.
        kernel: as of `plan_many`.
        threads: as of `plan_many`.

    Returns:
        arrays with a row for each task.

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
    question = asked(grasp, task, wrenches, friction_factors, masses)
    whole = (analysed(question.grasp) or question.grasp) if isinstance(question.grasp, Grasp) else question.grasp
    begun = _masses(question, task, masses) if of == "heaviest_kg" else np.ones(question.count)
    tried = _Tried(question, task, whole, of, begun, {"kernel": kernel, "threads": threads})
    return _searched(tried, of, begun, harder=1 / STEP if of == "critical_friction_scale" else STEP)


def _masses(question: Asked, task: Task | TimedTask, masses: Array | None) -> Array:
    held, stack = question.like.held, isinstance(question.grasp, GraspStack)
    if not isinstance(task, Task) or stack or held is None or not held.body.mass:
        raise InputError.at("of", "'heaviest_kg' needs one grasp on an object that has a mass, and a Task")
    return np.full(question.count, held.body.mass) if masses is None else np.asarray(masses, dtype=float)


@dataclass
class _Tried:
    """What becomes of tasks at other values of the number."""

    question: Asked
    task: Task | TimedTask
    whole: Grasp | Analysis | GraspStack
    of: str
    begun: Array
    options: dict[str, Any]
    goal: Goal | None = None
    """The largest margin, whose value tells how far the end is; the least effort where nothing bounds that."""

    def __call__(self, places: NDArray[np.intp], factors: Array) -> tuple[NDArray[np.int8], Array]:
        """Return 1, -1 or 0 for a plan, a proof or neither, and by how much margins exceed what is asked, or nan."""
        question = self.question
        own: dict[str, Any] = {"wrenches": question.wrench[places]}
        if self.of == "load_factor":
            own["wrenches"] = own["wrenches"] * factors[:, None]
        elif self.of == "heaviest_kg":
            own = {"masses": self.begun[places] * factors}
        friction = None if question.friction is None else question.friction[places]
        if self.of == "critical_friction_scale":
            friction = factors * (1.0 if friction is None else friction)
        whose = self.whole.taken(places) if isinstance(self.whole, GraspStack) else self.whole
        many = self._planned(lambda goal: plan_many(
            whose, replace(self.task, goals=(goal,)), friction_factors=friction, **own, **self.options
        ))  # fmt: skip
        signs = (many.verdicts == FEASIBLE).astype(np.int8) - (many.verdicts == INFEASIBLE)
        return np.where(many.verified, signs, 0), many.largest_margin - question.task.margin

    def _planned(self, with_goal: Callable[[Goal], ManyPlans]) -> ManyPlans:
        if self.goal is None:
            try:
                found = with_goal(LargestMargin())
            except InputError as error:
                if error.issues[0].key != "goal.maximise":
                    raise
                self.goal = LeastEffort()
            else:
                self.goal = LargestMargin()
                return found
        return with_goal(self.goal)


def _searched(tried: _Tried, of: str, begun: Array, *, harder: float) -> ManyMargins:
    """Return the ends that are found from a factor of 1 on, in steps of `harder`, and then between."""
    N = len(begun)
    good, bad = np.full(N, np.nan), np.full(N, np.nan)
    at_good, at_bad = np.full(N, np.nan), np.full(N, np.nan)
    open_, factor = np.arange(N), 1.0
    while len(open_) and 1 / FAR <= factor <= FAR:
        signs, beyond = tried(open_, np.full(len(open_), factor))
        with_plan, without = signs > 0, (signs < 0) & (factor != 1)
        good[open_[with_plan]], at_good[open_[with_plan]] = factor, beyond[with_plan]
        bad[open_[without]], at_bad[open_[without]] = factor, beyond[without]
        open_, factor = open_[with_plan], factor * harder
    open_ = np.flatnonzero(np.isfinite(good) & np.isfinite(bad))
    for turn in range(MOST):
        open_ = open_[np.abs(bad - good)[open_] > CLOSE * good[open_]]
        if not len(open_):
            break
        factors = _between(good[open_], bad[open_], at_good[open_], at_bad[open_], halve=turn % 4 == 3)
        signs, beyond = tried(open_, factors)
        for sign, end, at in ((1, good, at_good), (-1, bad, at_bad)):
            end[open_[signs == sign]], at[open_[signs == sign]] = factors[signs == sign], beyond[signs == sign]
        open_ = open_[signs != 0]
    value, other = good * begun, bad * begun
    value[~np.isfinite(other)] = np.nan
    proven = np.abs(other - value) <= 1e-6 * value
    return ManyMargins(of, value, np.fmin(value, other), np.fmax(value, other), proven)


def _between(good: Array, bad: Array, at_good: Array, at_bad: Array, *, halve: bool) -> Array:
    """Return factors to try next: where the margin ends on a straight line, a little on toward the end farther off."""
    middle = np.sqrt(good * bad)
    if halve:
        return middle
    with np.errstate(all="ignore"):
        zero = good + (bad - good) * at_good / (at_good - at_bad)
    far = np.where(np.abs(zero - good) > np.abs(zero - bad), good, bad)
    zero = zero + np.sign(far - zero) * 0.4 * CLOSE * good
    inside = (zero - good) * (bad - zero) > 0
    return np.where(inside, zero, middle)
