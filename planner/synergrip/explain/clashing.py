"""A set of limits of which none can be left out: together they leave no plan, without any one there may be one."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from synergrip.changes.asked import Asked
from synergrip.changes.at_a_value import no_plan
from synergrip.conic.limits.joint_range import JointRange
from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.slip_margin import SlipMargin
from synergrip.explain.irreducible import irreducible


def clashing(asked: Asked) -> tuple[str, ...] | None:
    """Return the keys of limits that cannot hold together, with physics (friction, load, motion) as it is.

    Limits are left out one after the other; each that stays is needed for the certificate. Without a slip margin its
    friction cones stay. Empty, physics alone leaves no plan.

    Args:
        asked: a task without a plan.

    Returns:
        The keys; None when that all limits together leave no plan is not certified here.
    """
    let_go = (JointRange(lower=-np.inf, upper=np.inf),) if asked.grasp.held is not None else ()
    stated = [limit for limit in asked.limits if not isinstance(limit, SlipMargin) or limit.margin]

    def clash(limits: Sequence[Limit]) -> bool:
        cones = () if any(isinstance(limit, SlipMargin) for limit in limits) else (SlipMargin(0.0),)
        free = () if any(isinstance(limit, JointRange) for limit in limits) else let_go
        return no_plan(asked.with_limits((*cones, *free, *limits)).posed(every=True))

    return tuple(limit.key for limit in irreducible(stated[::-1], clash)[::-1]) if clash(stated) else None
