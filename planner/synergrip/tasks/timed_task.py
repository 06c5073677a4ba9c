"""What is asked of a grasp: loads and a wanted motion at knots, limits, a goal. Plain values, no file in sight."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal, Protocol, get_args

import numpy as np

from synergrip.conic.limits.friction_cone import FrictionCone
from synergrip.conic.limits.joint_range import JointRange
from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.object_error import AXES, AxisName, ObjectError
from synergrip.errors import InputError, Issue, one_of, raise_issues
from synergrip.grasps.grasp_judging import Judge
from synergrip.linalg import Array
from synergrip.tasks.marks import Marks
from synergrip.tasks.task_judging import limit_issues, order_issues, size_issues, times_of, word_issues, wrench_of

GoalName = Literal[
    "margin",
    "effort",
    "torque",
    "actuator",
    "peak_force",
    "steady",
    "references",
    "travel",
    "smooth",
    "centred",
    "weighted",
]
"""Maximise the worst margin, or minimise: contact effort, torque effort, actuator effort, the peak normal force, the
change of the contact forces over time, the synergy references, their rates, their accelerations, the joints' distances
from the middle of their ranges; or a weighted sum of those that are sums of squares."""
FORCE_GOALS: frozenset[GoalName] = frozenset({"margin", "peak_force", "effort", "torque", "actuator", "steady"})
"""Those that speak of forces only."""
SUMS = tuple(name for name in get_args(GoalName) if name not in ("margin", "peak_force", "weighted"))
"""Those that are sums of squares, and so can be weighted."""
EFFORTS: frozenset[GoalName] = frozenset({"effort", "torque", "actuator"})
"""Those that leave no force open."""

BOUNDING = ("normal_force", "joint_torque", "actuator_effort", "synergy_reference", "joint_range")
"""Limits each of which alone bounds the largest margin, also where squeezing harder always helps."""
MAXIMISED = "goal.maximise"
"""The key under which the largest margin is asked for, unless it is one of several goals."""


class Course(Protocol):
    """Load and wish at any time of a task, not only at its knots."""

    def load_at(self, times: Array) -> Array | None:
        """Return the external wrench (T, 6) at any times (T,) [s]; None when it is w_0 throughout."""

    def target_at(self, times: Array) -> Array:
        """Return the wanted motion (T, m) at any times (T,), with the columns of `Target.values`."""

    @property
    def marks(self) -> Marks:
        """Where load or wish have corners, where the load jumps, and where one of them is curved."""


@dataclass(frozen=True)
class Target:
    """The wanted object motion from the start of the task."""

    kind: Literal["hold", "motion", "modes", "mode moves"]
    values: Array
    """(T, 6) displacement about B [m, rad] for "motion"; (T, dim Gamma_ucs) beta [m] for "modes"; the same for
    "mode moves", where columns that are not there stand for zero; (T, 0) to hold."""
    key: str = ""
    """Key in the problem file."""


@dataclass(frozen=True)
class TimedTask:
    """A task at T knots."""

    times: Array  # (T,) [s]
    wrench: Array  # (T, 6), or (6,) for one that stays, external wrench on the object about B, axes of N
    target: Target
    margin: float
    """Slip margin that every contact keeps [N]."""
    limits: tuple[Limit, ...]
    """All limits but the friction cones."""
    order: tuple[GoalName, ...]
    """The goals, the first one first; each chooses among the plans that are best by those before it."""
    tolerance: float = 0.0
    """Rigid tracking: how far the wanted motion may leave Gamma_ucs before it is refused; compliant tracking: how
    far the object may be from where it is wanted [m, rotations times length]."""
    tracking: Literal["rigid", "compliant"] = "rigid"
    """What follows the wanted motion: the rigid motion Gamma_ucs beta, or the object with its elastic motion."""
    axes: tuple[AxisName, ...] = AXES
    """On which of the six axes about B the wanted motion is asked for."""
    drift: float | None = None
    """How far the object may move on the other axes [m, rotations times length]; None when as far as it likes."""

    weights: Mapping[GoalName, float] = field(default_factory=dict)
    """The goals in "weighted", each with its weight."""
    course: Course | None = None
    """Load and wish at any time; straight lines between the knots when None."""
    between: Literal["report", "hold"] = "report"
    """Whether what happens between the knots is reported, or also kept within all limits."""
    ranges: JointRange | None = None
    """Joint ranges of the hand and its posture; None when not known."""

    def __post_init__(self) -> None:
        """Judge the values as those of a problem file; a wrench of 6 numbers is the same at all knots.

        Raises:
            InputError: everything that is wrong, each with the argument, what came and what was expected.
        """
        judge = Judge("Task")
        times = times_of(judge, self.times)
        raise_issues(judge.issues)  # all that follows goes by the knots
        wrench = wrench_of(judge, self.wrench, len(times))
        if np.ndim(self.target.values) != 2 or len(self.target.values) != len(times):
            judge.refuse("target", f"expected a row at each of {len(times)} knots, got {np.shape(self.target.values)}")
        axes = [name for name in self.axes if name not in AXES]
        raise_issues([
            *judge.issues,
            *size_issues(self.margin, self.tolerance, self.drift, compliant=self.tracking == "compliant"),
            *order_issues(self.order, self.weights, get_args(GoalName), SUMS),
            *word_issues(tracking=(self.tracking, ("rigid", "compliant")), between=(self.between, ("report", "hold"))),
            *([Issue(one_of(axes[0], AXES), "Task.axes")] if axes else []),
            *limit_issues(self.limits),
        ])  # fmt: skip
        object.__setattr__(self, "times", times)
        object.__setattr__(self, "wrench", wrench)

    @property
    def goal(self) -> GoalName:
        """The first goal."""
        return self.order[0]

    @property
    def watches_references(self) -> bool:
        """True when some limit looks at more than the forces, so that redundancy matters."""
        goals = {*self.order, *self.weights} - {"weighted"}
        return any(limit.watches == "references" for limit in self.limits) or not goals <= FORCE_GOALS

    @property
    def all_limits(self) -> tuple[Limit, ...]:
        """All limits, friction cones first."""
        return (FrictionCone(self.margin), *self.kept)

    @property
    def kept(self) -> tuple[Limit, ...]:
        """All limits but the friction cones: those stated, and those that tracking adds."""
        part: Literal["rigid", "whole"] = "rigid" if self.tracking == "rigid" else "whole"
        rest = tuple(axis for axis in AXES if axis not in self.axes)
        limits = list(self.limits)
        if self.tracking == "compliant":
            limits.append(ObjectError(self.tolerance, self.axes, part, "task.tolerance", "tracking error"))
        if rest and self.drift is not None:
            limits.append(ObjectError(self.drift, rest, part, "task.drift", "drift on free axes"))
        return tuple(limits)


def still(times: Array) -> Target:
    """Return the wish to hold the object."""
    return Target("hold", np.zeros((len(times), 0)))


def unbounded() -> InputError:
    """Return the error of a largest margin that nothing bounds."""
    listed = ", ".join(f"limits.{name}" for name in BOUNDING[:-1])
    message = (
        f"nothing bounds the largest margin: squeezing harder always helps; give {listed} or limits.{BOUNDING[-1]}"
    )
    return InputError.at(MAXIMISED, message)
