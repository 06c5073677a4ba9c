"""The wanted motion by rigid motions alone: a place to begin at, where the plan of the start posture is none.

At all knots at once the references that hold the object are taken along what is left of the way, each by the rigid
motion of its knot, and by the change of internal force that keeps the forces of the hold, both as the derivatives of
the equilibrium have them. No limit is looked at and no program is solved: the passes that begin here do that.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from synergrip.linalg import Array
from synergrip.planning.walk import Walker
from synergrip.planning.walk_so_far import Walk
from synergrip.tasks.tracking_along import joints_of

MOST = 4
"""Steps that it takes at most."""
FARTHEST = 1.0
"""How far joints together move in a step at most [rad, or m]."""
DEAR = 0.2
"""A step that goes less than this share of what is left is none: fingers are nearly straight there."""


def brought(walker: Walker, hold: Array) -> Walk | None:
    """Return a walk of all knots whose object is about where it is wanted; None where it does not come there.

    Args:
        walker: whose task it is.
        hold: (T, n_z) references that hold the object where it is, under the loads of the task.
    """
    start, share = walker.executor.setting.start, 0.0
    here = walker.executed(hold, None, start.taken(np.zeros(len(hold), dtype=int)), fewer=True)
    held = here.executed.states.forces
    for count in range(1, MOST + 1):
        if here.way is None or share == 1.0:
            break
        references, share = _taken(here, held)
        if share < DEAR:
            return None
        here = replace(walker.executed(references, None, here.executed, fewer=True), passes=count)
    return here if here.way is not None and share == 1.0 else None


def _taken(walk: Walk, held: Array) -> tuple[Array, float]:
    """Return references (T, n_z) that go a share of what is left, and the share; forces (T, n_l) are to be as held."""
    assert walk.way is not None
    way, each = walk.way, walk.way.each
    n_alpha, n_beta, _ = each.coordinates.dimensions
    moved = np.linalg.norm((joints_of(each) @ way.beta[:, :, None])[:, :, 0], axis=1).max(initial=0.0)
    share = min(1.0, FARTHEST / max(moved, 1e-300))
    beta = share * way.beta
    motions = each.coordinates.inverse[:, :, : n_alpha + n_beta]
    of_alpha, of_beta = np.split(each.response.dlambda_dzr @ motions, [n_alpha], axis=2)
    lack = (held - walk.executed.states.forces)[:, :, None] - of_beta @ beta[:, :, None]
    alpha = (np.linalg.pinv(of_alpha) @ lack)[:, :, 0]
    change = (motions @ np.hstack([alpha, beta])[:, :, None])[:, :, 0]
    return walk.references + change, share
