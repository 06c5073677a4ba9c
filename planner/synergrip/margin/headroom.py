"""How much joints and actuators have left of their limits at every instant."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import numpy as np

from synergrip.conic.limits.actuator_effort import ActuatorEffort
from synergrip.conic.limits.joint_torque import JointTorque
from synergrip.conic.limits.limit import Limit
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, frozen
from synergrip.margin.measures import Measure
from synergrip.statics.motion import Motion

FORMULAS: tuple[tuple[type[JointTorque | ActuatorEffort], str, str, Literal["joint", "actuator"]], ...] = (
    (JointTorque, "torque headroom", "1 - |tau| / tau_max", "joint"),
    (ActuatorEffort, "effort headroom", "1 - |sigma| / sigma_max", "actuator"),
)
"""Kind of limit, name and formula of the measure, and what it is of."""


def headrooms(grasp: Grasp, limits: Sequence[Limit], motion: Motion) -> dict[str, Measure]:
    """Return torque and effort headroom by name, of the joints and actuators that have a limit; not those without any.

    A limit is what the task sets, the least where it sets several; where it sets none, what the hand states.

    Args:
        grasp: says which joints and actuators there are.
        limits: of the task.
        motion: whose torques and efforts these are.
    """
    found = {}
    for kind, name, formula, of in FORMULAS:
        of_hand = kind("hand")
        most, names = _most(grasp, limits, of_hand), of_hand.names(grasp)
        there = np.flatnonzero(np.isfinite(most))
        if not len(there):
            continue
        left = 1 - np.abs(of_hand.reached(motion)[:, there]) / most[there]
        found[name] = Measure(name, "", formula, frozen(left), tuple(names[i] for i in there), motion.times, of=of)
    return found


def _most(grasp: Grasp, limits: Sequence[Limit], of_hand: JointTorque | ActuatorEffort) -> Array:
    """Return the largest torque or effort of each joint or synergy; infinity where neither task nor hand has one."""
    none = np.full(len(of_hand.names(grasp)), np.inf)
    stated = none if grasp.held is None else of_hand.of_hand(grasp.held)
    own = [np.asarray(limit.on(grasp).limit) for limit in limits if isinstance(limit, type(of_hand))]
    asked = np.min(own, axis=0) if own else none
    return np.where(np.isfinite(asked), asked, stated)
