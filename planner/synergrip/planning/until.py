"""What holds as long as a motion is followed: the true figures of the knots until then."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from synergrip.conic.formulation import Formulation
from synergrip.linalg import frozen
from synergrip.planning.figures import Figures, figures
from synergrip.planning.walk import Walker
from synergrip.planning.walk_so_far import Walk


def figures_until(walk: Walk, walker: Walker, formulation: Formulation, until: float = np.inf) -> Figures | None:
    """Return the figures of a walk that does not get through all knots, at those that it gets to.

    Args:
        walk: references and their execution.
        walker: whose task it is.
        formulation: of the task, for names and units.
        until: until when the motion is followed [s]; the knots after that are none of it.

    Returns:
        None where not even the first knot is reached, and where figures are not looked at (`Effort.brief`).
    """
    got = min(len(walk.executed.states), int(np.searchsorted(walker.task.times, until, side="right")))
    if not got or walker.effort.brief:
        return None
    part = replace(walker, task=walker.task.first(got), aim=frozen(walker.wanted[:got]))
    begun = replace(walk, references=frozen(walk.references[:got]), executed=walk.executed.first(got), way=None)
    return figures(begun, part, formulation, None)


def kept_until(found: Figures | None, walker: Walker) -> Iterator[str]:
    """Yield whether limits hold at the knots that a motion is followed to, and what is missed there."""
    if found is None:
        return
    until = f"{'until' if len(found.motion.times) > 1 else 'at'} t = {found.motion.times[-1]:.3g} s"
    failed = [check for check in found.checks if not check.passed]
    if failed:
        missed = found.missed or tuple(f"{check.name}, by {check.error:.3g}" for check in failed)
        yield f"{until} limits are missed: {'; '.join(missed)}"
        return
    beside = "" if walker.task.between == "report" or len(found.motion.times) < 2 else " and between them"
    yield f"{until} all limits hold, at the knots{beside}"
