"""What is asked of `plan_many`: N tasks as arrays, judged before anything is worked out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.goals.least_peak import LeastPeak
from synergrip.conic.limits.actuator_effort import ActuatorEffort
from synergrip.conic.limits.joint_range import JointRange
from synergrip.conic.limits.joint_torque import JointTorque
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.limits.object_error import AXES
from synergrip.conic.limits.synergy_reference import SynergyReference
from synergrip.documents.judging import as_numbers, described, is_list
from synergrip.documents.validation import LARGEST_NUMBER
from synergrip.errors import InputError, kind_of
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.plausible import mass_doubt
from synergrip.grasps.stack import GraspStack
from synergrip.linalg import Array, frozen
from synergrip.statics.analysis import Analysis
from synergrip.tasks.task import Task
from synergrip.tasks.timed_task import TimedTask
from synergrip.values import Value

LIMITS = (NormalForce, JointTorque, ActuatorEffort, SynergyReference, JointRange)
GOALS = (LargestMargin, LeastEffort, LeastPeak)


@dataclass(frozen=True, eq=False, repr=False)
class Asked(Value):
    """N tasks of one knot."""

    grasp: Grasp | Analysis | GraspStack
    """One for all, or N."""
    task: TimedTask
    """What they have in common."""
    wrench: Array  # (N, 6) [N, N m]
    friction: Array | None  # (N,) factors
    notes: tuple[str, ...] = ()
    """What of it can hardly be meant."""

    @property
    def count(self) -> int:
        """N."""
        return len(self.wrench)

    @property
    def beyond(self) -> str:
        """What of the task is for `plan` alone: limits or goals by name; empty where the batch answers all of it."""
        others = [type(limit).__name__ for limit in self.task.limits if type(limit) not in LIMITS]
        goals = [type(goal).__name__ for goal in self.task.goals]
        if len(goals) > 1 or type(self.task.goals[0]) not in GOALS:
            others.append("goals " + ", ".join(goals))
        return "; ".join(others)

    @property
    def like(self) -> Grasp:
        """A grasp of the form of all."""
        return _like(self.grasp)

    def task_at(self, place: int) -> TimedTask:
        """Return one of the tasks by itself."""
        return replace(self.task, wrench=self.wrench[place : place + 1], course=None)

    def grasp_at(self, place: int) -> Grasp | Analysis:
        """Return the grasp of one of the tasks."""
        if self.friction is None and not isinstance(self.grasp, GraspStack):
            return self.grasp
        grasp: Grasp = self.grasp[place] if isinstance(self.grasp, GraspStack) else _like(self.grasp)
        if self.friction is None or self.friction[place] == 1:
            return grasp
        factor = float(self.friction[place])
        contacts = tuple(replace(contact, kind=contact.kind.slippery(factor)) for contact in grasp.contacts)
        return replace(grasp, contacts=contacts)


def _like(grasp: Grasp | Analysis | GraspStack) -> Grasp:
    if isinstance(grasp, GraspStack):
        return grasp.like
    return grasp.grasp if isinstance(grasp, Analysis) else grasp


def asked(grasp: Any, task: Any, wrenches: Any, friction_factors: Any, masses: Any) -> Asked:
    """Return what is asked, or refuse it; arguments as of `plan_many`."""
    whose = grasps_asked(grasp)
    timed = _task(task, _like(whose))
    factors = (
        None
        if friction_factors is None
        else _numbers("friction_factors", friction_factors, (), "factors greater than 0", above=True)
    )
    loads = _loads(whose, task, timed, wrenches, masses)
    counts = {"wrenches" if masses is None else "masses": len(loads)} if loads is not None else {}
    counts |= {} if factors is None else {"friction_factors": len(factors)}
    counts |= {"grasps": len(whose)} if isinstance(whose, GraspStack) else {}
    if len(set(counts.values())) > 1:
        told = ", ".join(f"{count} {name}" for name, count in counts.items())
        raise InputError.at(next(iter(counts)), f"expected as many of each, got {told}")
    count = next(iter(counts.values()), 1)
    if loads is None:
        loads = _own_loads(whose, task) if isinstance(whose, GraspStack) and isinstance(task, Task) else None
        loads = np.broadcast_to(timed.wrench, (count, 6)) if loads is None else loads
    doubts = _doubts(whose, masses)
    if isinstance(whose, GraspStack):
        timed = _from_each_posture(timed, task)
    return Asked(whose, timed, frozen(loads), None if factors is None else frozen(factors), doubts)


def _doubts(whose: Grasp | Analysis | GraspStack, masses: Any) -> tuple[str, ...]:
    """Return what of some masses can hardly be meant: of the least and the largest of them."""
    if masses is None:
        return ()
    held = [each.held for each in (whose.given if isinstance(whose, GraspStack) else ()) if each.held is not None]
    bodies = {each.body.mass if each.body.shape is None else id(each.body.shape) for each in held}  # what tells of them
    like = None if len(bodies) > 1 else _like(whose).held
    ends = [] if like is None else [float(np.min(masses)), float(np.max(masses))]
    return tuple(dict.fromkeys(f"masses: {said}" for each in ends if like and (said := mass_doubt(like.body, each))))


def grasps_asked(grasp: Any) -> Grasp | Analysis | GraspStack:
    """Return the grasp, or the stack of grasps; or refuse what is neither."""
    if isinstance(grasp, Grasp | Analysis):
        return grasp
    if not isinstance(grasp, GraspStack) and (not is_list(grasp) or not isinstance(grasp, Sequence)):
        raise InputError.at("grasp", f"expected a Grasp, an Analysis, a GraspStack or a list, got {kind_of(grasp)}")
    stack = GraspStack.of(grasp)
    if stack.stranger is not None:
        message = "is not on the hand of grasp[0]; plan grasps of one hand at once, made with one load_hand(...)"
        raise InputError.at(f"grasp[{stack.stranger}]", message)
    return stack


def _task(task: Any, grasp: Grasp) -> TimedTask:
    """Return the task at its one knot, or say what of it is not covered."""
    if not isinstance(task, Task | TimedTask):
        raise InputError.at("task", f"expected a Task, got {kind_of(task)}")
    timed = task.timed(grasp) if isinstance(task, Task) else task.on(grasp)
    hint = "; plan such tasks one by one with plan(...)"
    wrong = {
        "Task.knots": len(timed.times) != 1 and f"expected 1 knot, got {len(timed.times)}",
        "Task.target": np.any(timed.target.values) and "expected Hold(): nothing moves in a task of one knot",
        "Task.tracking": timed.tracking != "rigid" and "expected 'rigid'",
        "Task.axes": len(timed.axes) < len(AXES) and "expected all six axes",
        "Task.control": timed.control is not None and "is not covered",
        "Task.allow": timed.allowed is not None and "is not covered",
    }
    for key, message in wrong.items():
        if message:
            raise InputError.at(key, f"{message}{hint}")
    if grasp.held is not None and timed.linearise != "once":
        message = "plan_many answers the linear model at the start posture: write Task(..., linearise='once'); along "
        raise InputError.at("Task.linearise", f"{message}the motion, or the hand that really moves, is for plan(...)")
    return timed


def _from_each_posture(timed: TimedTask, task: Task | TimedTask) -> TimedTask:
    """Return the task with joint ranges that begin at the posture of each grasp, unless the task states where."""
    stated = [limit for limit in task.limits if isinstance(limit, JointRange)]
    begins = iter(stated or [JointRange()])
    limits = (
        replace(limit, start=None) if isinstance(limit, JointRange) and next(begins).start is None else limit
        for limit in timed.limits
    )
    return replace(timed, limits=tuple(limits))


def _loads(whose: Any, task: Any, timed: TimedTask, wrenches: Any, masses: Any) -> Array | None:
    """Return the loads (N, 6) that are given, those of masses, or None."""
    if masses is None:
        return None if wrenches is None else _numbers("wrenches", wrenches, (6,), "3 forces [N] and 3 moments [N m]")
    if wrenches is not None:
        raise InputError.at("masses", "wrenches say the whole load already; give one of the two")
    found = _numbers("masses", masses, (), "masses [kg] greater than 0", above=True)
    if not isinstance(task, Task) or object_masses(whose) is None:
        raise InputError.at("masses", "needs grasps on an object that has a mass, and a Task; give wrenches instead")
    if isinstance(whose, GraspStack) and len(whose) == len(found):
        if not task.loads:
            return _own_loads(whose, task)
        bodies = {id(each.held.body): _by_mass(task, each) for each in whose.given if each.held is not None}
        if len(bodies) > 1:
            ends = np.array([bodies[id(each.held.body)] for each in whose.given if each.held is not None])
            return np.asarray(ends[:, 0] + (found[:, None] - 1.0) * (ends[:, 1] - ends[:, 0]))
    one, two = _by_mass(task, _like(whose))
    return np.asarray(one + (found[:, None] - 1.0) * (two - one))


def object_masses(whose: Grasp | Analysis | GraspStack) -> Array | None:
    """Return (N,), or (1,), the mass of the object of every grasp [kg]; None where some are given as matrices."""
    given = (whose.given if isinstance(whose, GraspStack) else ()) or (_like(whose),)
    found = [each.held.body.mass for each in given if each.held is not None]
    return np.array(found) if len(found) == len(given) else None


def _by_mass(task: Task, grasp: Grasp) -> Array:
    """Return (2, 6) the loads of a task with an object of 1 kg and of 2 kg: they are affine in the mass."""
    return np.array([task.timed(grasp.replace(mass=mass)).wrench[0] for mass in (1.0, 2.0)])


def _own_loads(whose: GraspStack, task: Task) -> Array | None:
    """Return the loads (N, 6) of a task on each grasp of a stack; None where they are the same on all.

    What a grasp holds at the start goes by the grasp, weight and inertia by its object.
    """
    if not task.loads:
        return np.asarray(task.load_factor * whose.w_0)
    bodies = {id(each.held.body): each for each in whose.given if each.held is not None}
    if len(bodies) < 2:
        return None
    own = {body: task.timed(each).wrench[0] for body, each in bodies.items()}
    return np.array([own[id(each.held.body)] for each in whose.given if each.held is not None])


def _numbers(name: str, value: Any, shape: tuple[int, ...], what: str, *, above: bool = False) -> Array:
    found = as_numbers(value)
    wanted = f"expected {what} for at least one task, shape ({', '.join(map(str, ('N', *shape)))}{',' * (not shape)})"
    if found is None or found.ndim != 1 + len(shape) or found.shape[1:] != shape or not len(found):
        raise InputError.at(name, f"{wanted}; got {described(value)}")
    with np.errstate(invalid="ignore"):
        wrong = ~(np.abs(found) <= LARGEST_NUMBER) | (found <= 0 if above else False)
    if np.any(wrong):
        place = int(np.flatnonzero(wrong.reshape(len(found), -1).any(axis=1))[0])
        worst = float(found[wrong].ravel()[0])
        too_large = LARGEST_NUMBER < abs(worst) < np.inf
        raise InputError.at(
            f"{name}[{place}]", f"{worst:g} is too large" if too_large else f"{wanted}; got {worst:g}"
        )  # fmt: skip
    return found
