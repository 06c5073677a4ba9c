"""Is the object held at all? The assumption null(G') = 0 of Theorem 1, and the refusal when it fails."""

from __future__ import annotations

import numpy as np

from synergrip.errors import NotRestrainedError
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.scale import Scale
from synergrip.linalg import RANK_TOLERANCE, Array, Decision, canonical, decided, frozen, split
from synergrip.statics.twists import describe_twist


def restraint(grasp: Grasp, scale: Scale, load: Array) -> Decision:
    """Return the rank decision on G' (6 when restrained).

    Args:
        grasp: the grasp.
        scale: its scale.
        load: (T, 6) wrenches that the grasp is to hold, for the refusal to tell about.

    Raises:
        NotRestrainedError: a motion of the object moves no contact; it carries the free twists and
            the largest part of the load that no contact force can balance.
    """
    decision = decided(scale.scaled_grasp(grasp.G)).at(())
    if decision.rank == 6:
        return decision
    free = canonical(split(scale.scaled_grasp(grasp.G)).null_space)
    twists = np.asarray(np.linalg.solve(scale.motion, free), dtype=np.float64)
    parts = scale.wrench(load) @ free
    worst = parts[int(np.argmax(np.linalg.norm(parts, axis=1)))]
    counts = np.linalg.norm(worst) > RANK_TOLERANCE * float(np.linalg.norm(scale.wrench(load), axis=1).max())
    unsupported = scale.motion.T @ free @ worst if counts else np.zeros(6)
    raise NotRestrainedError(_message(grasp, scale, twists, unsupported), frozen(twists), frozen(unsupported))


def _message(grasp: Grasp, scale: Scale, twists: Array, unsupported: Array) -> str:
    described = "; ".join(describe_twist(twist, grasp.contacts, scale.length) for twist in twists.T)
    count = twists.shape[1]
    text = f"the contacts do not restrain the object: {count} free motion{'s' if count > 1 else ''} ({described})"
    if np.any(unsupported):
        force = ", ".join(f"{x:.3g}" for x in np.round(unsupported, 12) + 0.0)
        text += f", and the load has a part that no contact force can balance: ({force}) N, N m"
    return text + "; add a contact, or make one a soft finger"
