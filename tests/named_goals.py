"""Goals by the names that problem files give them, for tests that draw them."""

from __future__ import annotations

from collections.abc import Mapping

from synergrip.conic.goals.centred_joints import CentredJoints
from synergrip.conic.goals.goal import Goal
from synergrip.conic.goals.registry import GOALS
from synergrip.conic.goals.weighted_sum import WeightedSum
from synergrip.conic.limits.joint_range import JointRange


def goals(
    *names: str, weights: Mapping[str, float] | None = None, ranges: JointRange | None = None
) -> tuple[Goal, ...]:
    """Return the goals of some names; "weighted" is the sum with `weights`, "centred" is about `ranges`."""

    def one(name: str) -> Goal:
        if name == "weighted":
            return WeightedSum(tuple((one(each), weight) for each, weight in (weights or {}).items()))
        if name == "centred" and ranges is not None:
            return CentredJoints(ranges.start, ranges.lower, ranges.upper)
        return GOALS[name]

    return tuple(one(name) for name in names)


def name_of(goal: Goal) -> str:
    """Return the name of a goal."""
    if isinstance(goal, WeightedSum):
        return "weighted"
    if isinstance(goal, CentredJoints):
        return "centred"
    return next(name for name, each in GOALS.items() if each == goal)


def names_of(given: tuple[Goal, ...]) -> tuple[str, ...]:
    """Return the names of goals."""
    return tuple(name_of(goal) for goal in given)


def weights_of(given: tuple[Goal, ...]) -> dict[str, float]:
    """Return the weights of the first weighted sum, by names."""
    return {name_of(goal): weight for each in given if isinstance(each, WeightedSum) for goal, weight in each.goals}


def ranges_of(given: tuple[Goal, ...]) -> CentredJoints:
    """Return the goal that holds the ranges of the joints."""
    parts = [goal for each in given if isinstance(each, WeightedSum) for goal, _ in each.goals]
    return next(goal for goal in (*given, *parts) if isinstance(goal, CentredJoints))
