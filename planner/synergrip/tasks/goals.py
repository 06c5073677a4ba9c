"""The goals that nobody asks for: they settle what those of a task leave open."""

from __future__ import annotations

from synergrip.conic.goals.goal import Goal
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.goals.least_reconfiguration import LeastReconfiguration
from synergrip.tasks.timed_task import TimedTask


def unasked_goals(task: TimedTask) -> tuple[Goal, ...]:
    """Return the goals that settle what those of a task leave open: forces, then redundancy and rigid motion.

    None where nobody wants to know which of the best plans it is.
    """
    if not task.tie_break:
        return ()
    effort = () if any(goal.settles_forces for goal in task.goals) else (LeastEffort(),)
    return (*effort, LeastReconfiguration())
