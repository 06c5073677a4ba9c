"""What is asked of a grasp: loads and a wanted motion at knots, limits, a goal. Plain values, no file in sight."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, Protocol

import numpy as np

from synergrip.conic.goals.goal import Goal
from synergrip.conic.limits.joint_range import JointRange
from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.object_error import AXES, AxisName, ObjectError
from synergrip.conic.limits.slip_margin import SlipMargin
from synergrip.documents.judging import as_numbers, described, is_list, is_word
from synergrip.documents.naming import naming_arguments
from synergrip.errors import Issue, one_of, raise_issues
from synergrip.grasps.grasp_judging import Judge
from synergrip.linalg import Array, Places, frozen
from synergrip.tasks.control import Control
from synergrip.tasks.marks import Marks
from synergrip.tasks.task_judging import goal_issues, limit_issues, size_issues, times_of, word_issues, wrench_of
from synergrip.values import Value

if TYPE_CHECKING:
    from synergrip.conic.allowed import Allowed
    from synergrip.grasps.grasp import Grasp


class Course(Protocol):
    """Load and wish at any time of a task, not only at its knots."""

    def load_at(self, times: Array) -> Array | None:
        """Return the external wrench (T, 6) at any times (T,) [s]; None when it is w_0 throughout."""

    def target_at(self, times: Array) -> Array:
        """Return the wanted motion (T, m) at any times (T,), with the columns of `Target.values`."""

    @property
    def marks(self) -> Marks:
        """Where load or wish have corners, where the load jumps, and where one of them is curved."""


@dataclass(frozen=True, eq=False, repr=False)
class Target(Value):
    """The wanted object motion from the start of the task."""

    kind: Literal["hold", "motion", "modes", "mode moves"]
    values: Array
    """(T, 6) displacement about B [m, rad] for "motion"; (T, dim Gamma_ucs) beta [m] for "modes"; the same for
    "mode moves", where columns that are not there stand for zero; (T, 0) to hold."""
    key: str = ""
    """The argument that states it, for errors."""


@naming_arguments
@dataclass(frozen=True, eq=False, repr=False)
class TimedTask(Value):
    """A task at T knots.

    Example:
        >>> timed = Task(duration=1.0, knots=5, loads=[Gravity((0, 0, -9.81))]).timed(grasp)
        >>> timed.times.tolist(), timed.wrench.shape
        ([0.0, 0.25, 0.5, 0.75, 1.0], (5, 6))
    """

    times: Array  # (T,) [s]
    wrench: Array  # (T, 6), or (6,) for one that stays, external wrench on the object about B, axes of N
    target: Target
    margin: float
    """Slip margin that every contact keeps [N]; at least that of a `SlipMargin` among the limits."""
    limits: tuple[Limit, ...]
    """All limits but the friction cones; a `SlipMargin` that is given among them is kept as `margin`."""
    goals: tuple[Goal, ...]
    """The first one first; each chooses among the plans that are best by those before it."""
    tolerance: float = 0.0
    """Rigid tracking: how far the wanted motion may leave Gamma_ucs before it is refused; compliant tracking: how
    far the object may be from where it is wanted [m, rotations times length]."""
    tracking: Literal["rigid", "compliant"] = "rigid"
    """What follows the wanted motion: the rigid motion Gamma_ucs beta, or the object with its elastic motion."""
    axes: tuple[AxisName, ...] = AXES
    """On which of the six axes about B the wanted motion is asked for."""
    drift: float | None = None
    """How far the object may move on the other axes [m, rotations times length]; None when as far as it likes."""
    course: Course | None = None
    """Load and wish at any time; straight lines between the knots when None."""
    between: Literal["report", "hold"] | None = None
    """Whether what happens between the knots is reported, or also kept within all limits; None: reported in the linear
    model, kept by the hand that moves."""
    control: Control | None = None
    """What is to be controlled independently."""
    linearise: Literal["once", "along"] = "along"
    """Whether the statics are those of the start posture, or those of the true equilibria along the motion."""
    allowed: Allowed | None = None
    """What the plan is to hold for beside what is stated, on the grasp that the task is for."""
    tie_break: bool = True
    """Whether what the goals leave open is settled by goals that nobody asks for."""

    def __post_init__(self) -> None:
        """Judge the values as those of a problem file; a wrench of 6 numbers is the same at all knots.

        Raises:
            InputError: everything that is wrong, each with the argument, what came and what was expected.
        """
        judge = Judge("Task")
        times = times_of(judge, self.times)
        raise_issues(judge.issues)  # all that follows goes by the knots
        wrench = wrench_of(judge, self.wrench, len(times))
        if not isinstance(self.target, Target):
            judge.refuse("target", f"expected a Target, got {described(self.target)}; a Task takes Hold(), Move(...)")
            judge.finish()
        _judge_rows(judge, self.target, len(times))
        axes = [name for name in (self.axes if is_list(self.axes) else [self.axes]) if not is_word(name, AXES)]
        raise_issues([
            *judge.issues,
            *size_issues(self.margin, self.tolerance, self.drift, compliant=is_word(self.tracking, ("compliant",))),
            *goal_issues(self.goals),
            *word_issues(self.tracking, self.linearise, self.between, self.tie_break),
            *([Issue(one_of(axes[0], AXES), "Task.axes")] if axes else []),
            *limit_issues(self.limits),
        ])  # fmt: skip
        object.__setattr__(self, "times", times)
        object.__setattr__(self, "wrench", wrench)
        margin, limits = _margin_apart(float(self.margin), self.limits)
        object.__setattr__(self, "margin", margin)
        object.__setattr__(self, "limits", limits)
        object.__setattr__(self, "goals", tuple(self.goals))

    @classmethod
    def of_task(
        cls,
        times: Array,
        wrench: Array,
        target: Target,
        limits: Sequence[Limit],
        goals: tuple[Goal, ...],
        **others: Any,
    ) -> TimedTask:
        """Return a task at its knots, of which is judged only what loads, target, limits and goals made of it.

        Raises:
            InputError: everything that is wrong with these.
        """
        judge = Judge("Task")
        wrench = wrench_of(judge, wrench, len(times))
        _judge_rows(judge, target, len(times))
        raise_issues([*judge.issues, *goal_issues(goals), *limit_issues(limits)])
        margin, kept = _margin_apart(0.0, limits)
        return cls.of_known(
            times=times, wrench=wrench, target=target, margin=margin, limits=kept, goals=goals, **others
        )  # fmt: skip

    @property
    def goal(self) -> Goal:
        """The first goal."""
        return self.goals[0]

    def on(self, grasp: Grasp) -> TimedTask:
        """Return the task for one grasp: limits and goals with one number for each joint, synergy or contact.

        On a hand its joint ranges are a limit, unless a `JointRange` says otherwise.

        Raises:
            InputError: a limit or goal does not fit the grasp, or needs what its hand does not state.
        """
        limits, goals = on_grasp(self.limits, self.goals, grasp)
        return replace(self, limits=limits, goals=goals)

    def for_synergies(self, origins: Sequence[int | None]) -> TimedTask:
        """Return the task for a grasp with other synergies.

        Args:
            origins: for each of these its place among those of the grasp that the task is for; None for a new one.
        """
        return replace(self, limits=tuple(limit.for_synergies(origins) for limit in self.limits))

    def first(self, count: int) -> TimedTask:
        """Return the task at the first of its knots."""
        return self.at(slice(count))

    def at(self, knots: Places | slice) -> TimedTask:
        """Return the task at some of its knots, in order."""
        target = replace(self.target, values=frozen(self.target.values[knots]))
        return replace(self, times=frozen(self.times[knots]), wrench=frozen(self.wrench[knots]), target=target)

    @cached_property
    def binding(self) -> tuple[Limit, ...]:
        """The limits that are stated, without joint ranges where all of them are let go."""
        return tuple(limit for limit in self.limits if not (isinstance(limit, JointRange) and limit.lets_go))

    @property
    def watches_references(self) -> bool:
        """True when some limit looks at more than the forces, so that redundancy matters."""
        return "references" in {*(limit.watches for limit in self.binding), *(goal.watches for goal in self.goals)}

    @cached_property
    def all_limits(self) -> tuple[Limit, ...]:
        """All limits, friction cones first."""
        return (SlipMargin(self.margin), *self.kept)

    @cached_property
    def of_instants(self) -> tuple[Limit, ...]:
        """The limits that speak of an instant, not of changes over time; friction cones first."""
        return tuple(limit for limit in self.all_limits if not limit.couples_knots)

    @cached_property
    def kept(self) -> tuple[Limit, ...]:
        """All limits but the friction cones: those stated, and those that tracking adds."""
        part: Literal["rigid", "whole"] = "rigid" if self.tracking == "rigid" else "whole"
        rest = tuple(axis for axis in AXES if axis not in self.axes)
        limits = [*self.binding]
        if self.tracking == "compliant":
            limits.append(ObjectError(self.tolerance, self.axes, part, "task.tolerance", "tracking error"))
        if rest and self.drift is not None:
            limits.append(ObjectError(self.drift, rest, part, "task.drift", "drift on free axes"))
        return tuple(limits)


def _judge_rows(judge: Judge, target: Target, knots: int) -> None:
    """Note that a target has no row of numbers at each knot, as what a motion of one's own makes may not have."""
    values = as_numbers(target.values)
    if values is None or values.ndim != 2 or len(values) != knots:
        judge.refuse("target", f"expected a row at each of {knots} knots, got {np.shape(target.values)}")
    elif target.kind == "motion" and values.shape[1] != 6:
        judge.refuse("target", f"expected shifts and rotations in rows of 6 numbers, got {values.shape[1]}")
    elif not np.isfinite(values).all():
        judge.refuse("target", "expected finite numbers, got some that are not")


def _margin_apart(margin: float, limits: Sequence[Limit]) -> tuple[float, tuple[Limit, ...]]:
    """Return the largest of a margin [N] and those among limits, and the limits without these."""
    margins = [limit.margin for limit in limits if isinstance(limit, SlipMargin)]
    return max([margin, *margins]), tuple([each for each in limits if not isinstance(each, SlipMargin)])


def on_grasp(
    limits: Sequence[Limit], goals: Sequence[Goal], grasp: Grasp
) -> tuple[tuple[Limit, ...], tuple[Goal, ...]]:
    """Return limits and goals for one grasp, as `TimedTask.on` says."""
    each = tuple(limit.on(grasp) for limit in limits)
    if grasp.held is not None and not any(isinstance(limit, JointRange) for limit in each):
        each = (*each, JointRange().on(grasp))
    return each, tuple(goal.on(grasp) for goal in goals)


def still(times: Array) -> Target:
    """Return the wish to hold the object."""
    return Target("hold", np.zeros((len(times), 0)))
