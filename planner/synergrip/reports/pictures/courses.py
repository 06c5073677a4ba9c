"""What a plan does over time, as charts to be drawn: where the object goes, and every limit with what it bounds."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from synergrip.conic.limits.limit import Usage
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.limits.synergy_reference import SynergyReference
from synergrip.documents.quantities import SHOWN_IN
from synergrip.linalg import Array
from synergrip.planning.outcome import Plan


@dataclass(frozen=True)
class Chart:
    """Lines over the time of a plan, in the unit in which people read them."""

    title: str
    unit: str
    names: tuple[str, ...]
    """Of the lines, those that come nearest to a bound first."""
    values: Array
    """(T, m)."""
    bounds: tuple[float, ...] = ()
    """Levels that no line passes; none where every line has its own."""
    target: Array | None = None
    """(T, m) where the lines are wanted."""

    @property
    def label(self) -> str:
        """Title with its unit."""
        return f"{self.title} [{self.unit}]" if self.unit else self.title


def charts(plan: Plan) -> tuple[Chart, ...]:
    """Return the charts of a plan: the object's motion, each limit, and the references."""
    return tuple([*_motion(plan), *(usage_chart(usage) for usage in plan.usages), *_unlimited(plan)])


def _motion(plan: Plan) -> Iterator[Chart]:
    """Yield translation and rotation of the object about B, as far as it moves or is to move."""
    wanted, reached = plan.formulation.target, plan.motion.du
    for title, unit, part in (("object displacement", "m", slice(0, 3)), ("object rotation", "rad", slice(3, 6))):
        factor, shown = SHOWN_IN[unit]
        yield Chart(title, shown, ("x", "y", "z"), factor * reached[:, part], target=factor * wanted[:, part])


def usage_chart(usage: Usage) -> Chart:
    """Return the chart of a limit."""
    factor, unit = SHOWN_IN.get(usage.unit, (1.0, usage.unit))
    order = np.argsort(-(usage.excess / usage.scale).max(axis=0), kind="stable")
    levels = [bound for side in (usage.lower, usage.upper) if len(bound := np.unique(side)) == 1]
    bounds = tuple(float(factor * level[0]) for level in levels if np.isfinite(level[0]))
    names = tuple(usage.items[i] for i in order)
    return Chart(usage.title, unit, names, factor * usage.value[:, order], bounds)


def _unlimited(plan: Plan) -> Iterator[Chart]:
    """Yield forces and references when no limit speaks of them."""
    grasp, kinds = plan.analysis.grasp, {type(limit) for limit in plan.task.limits}
    if NormalForce not in kinds:
        names = tuple(contact.name for contact in grasp.contacts)
        yield _by_size("normal force", "N", names, plan.motion.forces[:, grasp.normal_rows])
    if SynergyReference not in kinds:
        yield _by_size("synergy reference", "", grasp.synergies, plan.motion.dz_r)


def _by_size(title: str, unit: str, names: tuple[str, ...], values: Array) -> Chart:
    order = np.argsort(-np.abs(values).max(axis=0), kind="stable")
    return Chart(title, unit, tuple(names[i] for i in order), values[:, order])
