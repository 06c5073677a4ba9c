"""The [goal] table made into goals."""

from __future__ import annotations

from dataclasses import replace

from synergrip.conic.goals.centred_joints import CentredJoints
from synergrip.conic.goals.goal import Goal
from synergrip.conic.goals.least_motion import LeastMotion
from synergrip.conic.goals.weighted_sum import WeightedSum
from synergrip.conic.limits.joint_range import JointRange
from synergrip.errors import InputError
from synergrip.problems.limits_file import GoalTable
from synergrip.tasks.goals import SIMPLE
from synergrip.tasks.timed_task import GoalName


def goals_of(table: GoalTable, ranges: JointRange | None) -> tuple[Goal, ...]:
    """Return the goals that a table states, the first one first.

    Args:
        table: the [goal] table.
        ranges: joint ranges of the hand and its posture; None where no hand is known.

    Raises:
        InputError: joints are to be centred and their ranges are not known.
    """

    def goal(name: GoalName) -> Goal:
        if name == "weighted":
            return WeightedSum(tuple((_exact(goal(each)), weight) for each, weight in table.weights.items()))
        if name != "centred":
            return SIMPLE[name]
        if ranges is None:
            message = "'centred' needs a [hand]; a grasp file states no joint ranges"
            raise InputError.at(f"goal.{table.key_of('centred')}", message)
        return CentredJoints(ranges.start, ranges.lower, ranges.upper)

    return tuple(map(goal, table.names))


def _exact(goal: Goal) -> Goal:
    """Return the goal with the factor that its definition gives it."""
    return replace(goal, exact=True) if isinstance(goal, LeastMotion) else goal
