"""The goals of a task by their names in the problem file. A new goal is listed here."""

from __future__ import annotations

from dataclasses import replace

from synergrip.conic.goals.centred_joints import CentredJoints
from synergrip.conic.goals.goal import Goal
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.goals.least_motion import LeastMotion
from synergrip.conic.goals.least_peak import LeastPeak
from synergrip.conic.goals.least_reconfiguration import LeastReconfiguration
from synergrip.conic.goals.steady_forces import SteadyForces
from synergrip.conic.goals.weighted_sum import WeightedSum
from synergrip.errors import InputError
from synergrip.tasks.timed_task import EFFORTS, GoalName, TimedTask

SIMPLE: dict[GoalName, Goal] = {
    "margin": LargestMargin(),
    "peak_force": LeastPeak(),
    "effort": LeastEffort(),
    "torque": LeastEffort("torque"),
    "actuator": LeastEffort("actuator"),
    "steady": SteadyForces(),
    "references": LeastMotion(),
    "travel": LeastMotion("rates"),
    "smooth": LeastMotion("accelerations"),
}


def goals_of(task: TimedTask) -> tuple[Goal, ...]:
    """Return the goals of a task in their order.

    Raises:
        InputError: joints are to be centred and their ranges are not known.
    """
    return tuple(_goal(name, task) for name in task.order)


def unasked_goals(task: TimedTask) -> tuple[Goal, ...]:
    """Return the goals that settle what those of a task leave open: forces, then redundancy and rigid motion."""
    effort = () if EFFORTS & {*task.order, *task.weights} else (LeastEffort(),)
    return (*effort, LeastReconfiguration())


def _goal(name: GoalName, task: TimedTask) -> Goal:
    if name == "weighted":
        return WeightedSum(tuple((_exact(_goal(each, task)), weight) for each, weight in task.weights.items()))
    if name != "centred":
        return SIMPLE[name]
    if task.ranges is None:
        raise InputError.at("goal.order", "'centred' needs a hand with joint ranges; a grasp file states none")
    return CentredJoints(task.ranges.start, task.ranges.lower, task.ranges.upper)


def _exact(goal: Goal) -> Goal:
    """Return the goal with the factor that its definition gives it."""
    return replace(goal, exact=True) if isinstance(goal, LeastMotion | SteadyForces) else goal
