"""The [limits] table made into limits."""

from __future__ import annotations

from collections.abc import Iterator

from synergrip.conic.goals.centred_joints import CentredJoints
from synergrip.conic.goals.registry import GOALS
from synergrip.conic.limits.file_key import limit_of
from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.registry import LIMITS
from synergrip.errors import Issue, raise_issues
from synergrip.grasps.grasp import Grasp
from synergrip.problems.limits_file import GoalTable
from synergrip.problems.problem_file import ProblemFile


def limits_of(file: ProblemFile, grasp: Grasp) -> tuple[Limit, ...]:
    """Return the limits of a problem.

    Raises:
        InputError: a list of the wrong length, ``"hand"`` without a hand that states the limit, units that do
            not suit the joints, or a goal that needs ranges that nobody states.
    """
    given = ((key, getattr(file.limits, key.name)) for key in LIMITS)
    limits = tuple(limit_of(key, value, grasp) for key, value in given if value is not None)
    raise_issues(list(_without_ranges(file.goal, grasp)))
    return limits


def _without_ranges(goal: GoalTable, grasp: Grasp) -> Iterator[Issue]:
    for name in goal.names:
        if isinstance(GOALS[name], CentredJoints) and grasp.held is None:
            message = f"'{name}' needs a [hand]; a grasp file states no joint ranges"
            yield Issue(message, key=f"goal.{goal.key_of(name)}")
