"""The factor of a load that is nothing but the object's weight: what is known of the mass is known of it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from synergrip.changes.asked import Asked
from synergrip.changes.turning import load_dial, mass_dial
from synergrip.conic.limits.dial import Dial
from synergrip.margin.direct_number import DirectNumber
from synergrip.tasks.gravity import Gravity
from synergrip.tasks.palm_motion import Palm
from synergrip.tasks.palm_path import PalmPath
from synergrip.tasks.task import Task
from synergrip.tasks.timed_task import TimedTask

TWICE, SAME = 2.0, 1e-12
"""Times the mass at which it is looked whether the load is weight alone, and to which share of the load it then is."""


def is_weight(asked: Asked, timed: TimedTask) -> bool:
    """Return whether the whole load is the object's weight and inertia: a factor of it is then one of the mass.

    It is looked at for another mass at the knots; between them the loads that may be there are in proportion as well.

    Args:
        asked: what is asked.
        timed: the same at its knots.
    """
    task, mass, factor = asked.task, mass_dial(asked), load_dial(asked, timed)
    if mass is None or factor is None or not isinstance(task, Task) or task.allow is not None:
        return False
    if not all(isinstance(load, Gravity | Palm | PalmPath) for load in task.loads):
        return False
    heavier, more = (dial.turned(TWICE * dial.value).timed.wrench for dial in (mass, factor))
    return bool(np.allclose(heavier, more, rtol=0.0, atol=SAME * float(np.abs(timed.wrench).max())))


def as_weight(name: str, dial: Dial[Asked], mass: Dial[Asked], found: DirectNumber) -> DirectNumber:
    """Return the factor of the load that a mass is, as a share of the one that is asked.

    Args:
        name: of the number.
        dial: of the load.
        mass: the dial of the mass.
        found: how far the latter may go.
    """
    if found.value is None:
        return DirectNumber.none(name, "", found.why)

    def factor(kg: float | None) -> float | None:
        return None if kg is None else float(f"{kg / mass.value:.10g}")

    value, lower, upper = (factor(kg) for kg in (found.value, found.lower, found.upper))
    why = f"the whole load is the object's weight: {found.value:.5g} kg is {found.why}"
    setting = dial.set(found.value / mass.value * dial.value)
    return replace(found, name=name, unit="", value=value, lower=lower, upper=upper, why=why, setting=setting)
