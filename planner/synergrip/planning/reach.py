"""How far a walk got: what counts as followed, until when it was, and what keeps the hand from going on."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from synergrip.linalg import frozen
from synergrip.planning.outcome import Reached
from synergrip.planning.walk import FOLLOWED, Walk, Walker

REACHED = 0.01
"""How far the rigid motion may be behind the wanted one when the task states no tolerance, as a share of the length of
the grasp."""
AT_END = 1e-3
"""[rad], [m] from the end of its range within which a joint is at its limit."""


def allowed(walker: Walker) -> float:
    """Return how far the rigid motion may be behind the wanted one [m]."""
    return walker.task.tolerance or REACHED * walker.start.response.scale.length


def _not_reached(walk: Walk, walker: Walker) -> str:
    """Return from when on a motion is not reached, and how far it gets."""
    times, executed = walker.task.times, walk.executed
    if walk.way is None:
        k = len(executed.states)
        return f"not reached from t = {times[k]:.3g} s: {executed.why or 'no equilibrium was found there'}"
    k = int(np.argmax(walk.way.behind > allowed(walker)))
    stuck = _stuck(walk, walker, k)
    return (
        f"not reached from t = {times[k]:.3g} s: there the object is {1e3 * walk.way.behind[k]:.3g} mm behind, and by "
        f"{1e3 * walk.behind:.3g} mm at most{stuck}"
    )


def _stuck(walk: Walk, walker: Walker, k: int) -> str:
    """Return what keeps the hand from going on at a knot: joints at the ends of their ranges, or straight fingers."""
    held = walker.start.grasp.held
    if held is None:
        return ""
    q = held.q + walk.executed.joint[k]
    ends = [
        f"joint '{joint.name}' is at its {end} limit"
        for joint, value in zip(held.hand.joints, q, strict=True)
        for end, off in (("lower", value - joint.lower), ("upper", joint.upper - value))
        if off < AT_END
    ]
    return f", because {', '.join(ends)}" if ends else ", because the fingers are near a straight posture"


def reached_by(walk: Walk, walker: Walker) -> Reached:
    """Return until when the motion was followed, and the pose of the object there."""
    k = len(walk.executed.states) if walk.way is None else int(np.argmax(walk.way.behind > allowed(walker)))
    pose = walk.executed.du[max(k - 1, 0)] if len(walk.executed.states) else np.zeros(6)
    return Reached(float(walker.task.times[max(k - 1, 0)]), frozen(pose), _not_reached(walk, walker))


def notes(walk: Walk, walker: Walker) -> Iterator[str]:
    """Yield how far the plan is from what was wanted, where that is more than elastic motion."""
    if walk.behind > FOLLOWED:
        yield (
            f"near a singular posture the object stays up to {1e3 * walk.behind:.2g} mm behind the wanted motion, "
            f"within the {1e3 * allowed(walker):.2g} mm that count as followed"
        )
