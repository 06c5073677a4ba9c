"""What is asked of a grasp, as one value: time, loads, a target, limits, goals. It knows no grasp yet."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields, replace
from typing import Any, Literal

from synergrip.conic.goals.goal import Goal
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.object_error import AXES, AxisName
from synergrip.documents.judging import described, is_list, is_whole, unfinished
from synergrip.documents.naming import naming_arguments
from synergrip.errors import InputError, Issue, one_of, repeated
from synergrip.grasps.grasp import Grasp
from synergrip.tasks.allowances import Allowances
from synergrip.tasks.arguments import TaskArguments, keep
from synergrip.tasks.control import Control
from synergrip.tasks.gravity import Gravity
from synergrip.tasks.hold import Hold
from synergrip.tasks.knots import MOST_KNOTS
from synergrip.tasks.marks import SAME_TIME
from synergrip.tasks.palm_motion import Palm
from synergrip.tasks.palm_path import PalmPath
from synergrip.tasks.profiles import SHORTEST
from synergrip.tasks.stated import Load, Motion, Stated
from synergrip.tasks.task_judging import goal_issues, limit_issues, size_issues, word_issues
from synergrip.tasks.timed_task import TimedTask
from synergrip.values import ByContent

HOLD = Hold()


@naming_arguments
@dataclass(frozen=True, eq=False, kw_only=True)
class Task(ByContent):
    """What is to happen, within which limits, to which end. `plan` makes a plan of it on any grasp.

    Args:
        duration: [s]; None for the end of its tables and waypoints, or 1 s.
        knots: number of evenly spaced instants at which the plan is made; None for those where something begins, ends
            or bends (41 for a task that moves, 1 for one that does not).
        target: where the object is wanted: `Hold`, `Move`, `ModeMove` (which add up with +), `Waypoints`,
            `MotionTable` or `ModesTable`.
        loads: what acts on the object, which adds up: `Gravity`, `Wrench`, `WrenchTable`, `Push`; and how the palm
            moves, with which gravity turns: `Palm` or `PalmPath`. Without any the load is the grasp's w_0.
        limits: what the plan keeps.
        goals: which plan is chosen, the first goal first.
        tracking: what follows the target: the "rigid" motion, or the object with its elastic one, "compliant".
        tolerance: rigid: how far the target may leave Gamma_ucs; compliant: how far the object may be from it [m].
        axes: on which of x, y, z, rx, ry, rz about B the target is asked for.
        drift: how far the object may move on the other axes [m]; None when as far as it likes.
        between: what happens between the knots: "report" it, or "hold" the limits there too, in the linear model as
            well; None: the limits hold there on the hand that moves, and are reported for a grasp given as matrices.
        control: how many directions of force, motion and reconfiguration are to be controlled independently; the task
            is refused where the synergies do not.
        load_factor: by which the whole load is multiplied.
        motion_factor: by which the wanted motion is multiplied.
        tie_break: whether what the goals leave open is settled by least effort, then least reconfiguration; False: any
            of the best plans will do, which saves a program where the largest margin or a peak is the goal.
        allow: what the plan is to hold for beside what is stated: less friction, other masses and loads, contacts that
            are off; None for nothing.
        time_factor: by which the time of the whole task is multiplied: its duration, and the times of waypoints, of
            tables of the wanted motion and of the path of the palm. Velocities are divided by it, accelerations, and
            with them the load by inertia, by its square. A load with times of its own is refused with another than 1.
        linearise: on a hand: "along" the motion, again and again at the true equilibria, until what is promised is what
            the hand does; or "once", at the start posture, as the paper does.

    Raises:
        InputError: everything that is wrong, each with the argument, what came and what was expected.

    Example:
        >>> task = Task(duration=2.0, knots=41, loads=[Gravity((0, 0, -9.81))])
        >>> task.replace(load_factor=1.5).load_factor
        1.5
    """

    duration: float | None = None
    knots: int | None = None
    target: Motion = HOLD
    loads: tuple[Load, ...] | list[Load] = ()
    limits: tuple[Limit, ...] | list[Limit] = ()
    goals: tuple[Goal, ...] | list[Goal] = (LeastEffort(),)
    tracking: Literal["rigid", "compliant"] = "rigid"
    tolerance: float = 0.0
    axes: tuple[AxisName, ...] = AXES
    drift: float | None = None
    between: Literal["report", "hold"] | None = None
    control: Control | None = None
    load_factor: float = 1.0
    motion_factor: float = 1.0
    time_factor: float = 1.0
    linearise: Literal["once", "along"] = "along"
    allow: Allowances | None = None
    tie_break: bool = True

    def __post_init__(self) -> None:
        """Judge the arguments, alone and together."""
        judge = TaskArguments("Task")
        duration = None if self.duration is None else judge.real("duration", self.duration, at_least=SHORTEST, unit="s")
        knots = None if self.knots is None else _whole(judge, self.knots)
        if not isinstance(self.target, Motion):
            expected = "where the object is wanted, such as Hold(), Move(...) + Move(...) or Waypoints(...)"
            judge.refuse("target", f"expected {expected}, got {described(self.target)}")
        elif lacking := unfinished(self.target):
            judge.refuse("target", lacking)
        loads = _listed(judge, "loads", self.loads, Load, "loads such as Gravity(...), Wrench(...), Push(...)")
        limits = _listed(judge, "limits", self.limits, object, "limits such as NormalForce(upper=20.0)")
        goals = _listed(judge, "goals", self.goals, object, "goals such as LeastEffort()")
        axes = _listed(judge, "axes", self.axes, str, f"names of axes, of {', '.join(AXES)}")
        factors = {name: judge.real(name, getattr(self, name), at_least=0) for name in ("load_factor", "motion_factor")}
        factors["time_factor"] = judge.real("time_factor", self.time_factor, above=0)
        compliant = isinstance(self.tracking, str) and self.tracking == "compliant"
        judge.issues += [
            *limit_issues(limits), *(goal_issues(goals) if is_list(self.goals) else ()),
            *(_axis_issues(axes, self.drift) if is_list(self.axes) else ()),
            *size_issues(0.0, self.tolerance, self.drift, compliant=compliant),
            *word_issues(self.tracking, self.linearise, self.between, self.tie_break),
        ]  # fmt: skip
        if self.control is not None:
            judge.one("control", self.control, Control, 'Control(forces=1, motions=("z",))')
        if self.allow is not None:
            judge.one("allow", self.allow, Allowances, "Allowances(friction=(0.4, 0.8))")
        if not judge.issues:
            judge.issues += _together(loads, self.target, duration, knots)
        keep(self, judge, duration=duration, knots=knots, loads=loads, limits=limits, goals=goals, axes=axes,
             **factors)  # fmt: skip

    @property
    def parts(self) -> dict[str, Stated]:
        """Loads and target by the argument that states them: ``loads[0]``, ``target``."""
        return {**{f"loads[{i}]": load for i, load in enumerate(self.loads)}, "target": self.target}

    @naming_arguments
    def replace(self, **changes: Any) -> Task:
        """Return the task with other arguments: ``task.replace(duration=3.0, load_factor=1.2)``.

        Raises:
            InputError: no such argument, or a value that is wrong.
        """
        names = [field.name for field in fields(self)]
        wrong = [Issue(one_of(name, names), key=f"Task.{name}") for name in changes if name not in names]
        if wrong:
            raise InputError(wrong)
        return replace(self, **changes)

    def timed(self, grasp: Grasp) -> TimedTask:
        """Return the task at its knots, on a grasp.

        Raises:
            InputError: loads or target do not fit into its time, or need to know more of the object.
        """
        from synergrip.tasks.timing import timed

        return timed(self, grasp)


def _whole(judge: TaskArguments, value: Any) -> int:
    whole = is_whole(value)
    if not whole or not 1 <= value <= MOST_KNOTS:
        judge.refuse("knots", f"expected a whole number from 1 to {MOST_KNOTS}, got {described(value)}")
    return int(value) if whole else 1


def _listed(judge: TaskArguments, name: str, values: Any, of: type, what: str) -> tuple[Any, ...]:
    """Return a list of values of a type as a tuple; an empty one after noting what is wrong."""
    if not isinstance(values, list | tuple):
        alone = isinstance(values, (Limit, Goal) if of is object else of)
        hint = f"; write {name}=[...] around it" if alone else ""
        judge.refuse(name, f"expected a list of {what}; got {described(values)}{hint}")
        return ()
    for index, value in enumerate(values):
        if not isinstance(value, of):
            judge.refuse(f"{name}[{index}]", f"expected one of {what}; got {described(value)}")
        elif of is not object and (lacking := unfinished(value)):  # of limits and goals that is told elsewhere
            judge.refuse(f"{name}[{index}]", lacking)
    return tuple(values)


def _axis_issues(axes: tuple[Any, ...], drift: float | None) -> Iterator[Issue]:
    if not axes:
        yield Issue(f"expected one or more of {', '.join(AXES)}, got none", key="Task.axes")
    for index, axis in enumerate(axes):
        if isinstance(axis, str) and axis not in AXES:
            yield Issue(one_of(axis, AXES), key=f"Task.axes[{index}]")
    for index in repeated(map(str, axes)):
        yield Issue(f"'{axes[index]}' is listed twice", key=f"Task.axes[{index}]")
    if drift is not None and len(axes) >= len(AXES):
        yield Issue("'drift' is for the axes that 'axes' leaves out, and it leaves none", key="Task.drift")


def _together(loads: tuple[Load, ...], target: Motion, duration: float | None, knots: int | None) -> Iterator[Issue]:
    """Yield what is wrong between arguments that are right by themselves."""
    for kinds, what in (((Palm, PalmPath), "a motion of the palm"), ((Gravity,), "gravity")):
        found = [i for i, load in enumerate(loads) if isinstance(load, kinds)]
        for i in found[1:]:
            yield Issue(f"{what} is given already by loads[{found[0]}]; keep one", key=f"Task.loads[{i}]")
    weighs = any(isinstance(load, Gravity) for load in loads)
    for i, load in enumerate(loads):
        if isinstance(load, Palm | PalmPath) and not load.inertia and not weighs:
            message = "turning the palm changes nothing without Gravity in the loads, or inertia=True"
            yield Issue(message, key=f"Task.loads[{i}]")
    if knots == 1 and any(part.moving or part.curved for part in (*loads, target)):
        yield Issue("a task in which something moves, comes or goes needs at least 2 knots", key="Task.knots")
    last = None if target.lines is not None else target.last
    if duration is not None and last is not None and last > duration * (1 + SAME_TIME):
        message = f"{last:g} s is after the end of the task at {duration:g} s; change it or the duration"
        yield Issue(message, key="Task.target.times")
