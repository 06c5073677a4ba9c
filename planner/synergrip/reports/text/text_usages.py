"""What references use of every limit, as rows of a table."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from synergrip.conic.limits.limit import Usage, first_largest
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.limits.synergy_reference import SynergyReference
from synergrip.documents.quantities import both_apart, plain
from synergrip.grasps.grasp import Grasp
from synergrip.planning.between import LIMIT
from synergrip.statics.motion import Motion
from synergrip.tasks.timed_task import TimedTask


def used_rows(usages: Sequence[Usage], motion: Motion, task: TimedTask, grasp: Grasp) -> list[tuple[str, ...]]:
    """Return the rows of all limits, of the normal forces, and of the references, too, where no limit is on them."""
    rows = [row for usage in usages for row in usage_rows(usage)]
    if not any(isinstance(limit, NormalForce) and np.isfinite(limit.upper) for limit in task.limits):
        rows.insert(1, _largest_normal(grasp, motion))
    if not any(isinstance(limit, SynergyReference) for limit in task.limits):
        rows.append(_largest("synergy reference", motion.dz_r, "", grasp.synergies, motion.times))
    return rows


def _largest_normal(grasp: Grasp, motion: Motion) -> tuple[str, ...]:
    normal = motion.forces[:, grasp.normal_rows]
    names = tuple(contact.name for contact in grasp.contacts)
    return _largest("largest normal force", normal, "N", names, motion.times)


def _largest(title: str, values: np.ndarray, unit: str, names: Sequence[str], times: np.ndarray) -> tuple[str, ...]:
    size = np.abs(values)
    k, i = first_largest(size, 1e-6 * float(size.max()))
    return title, f"{plain(values[k, i])} {unit}".rstrip(), f"{names[i]}, t = {times[k]:.2f} s", ""


def on_bound(usage: Usage, k: int, i: int, bound: float) -> float:
    """Return the value of item i at knot k; the bound when it is on it, as far as the check can tell."""
    value = float(usage.value[k, i])
    return bound if abs(value - bound) <= LIMIT * float(usage.size[k, i]) else value


def usage_rows(usage: Usage) -> Iterator[tuple[str, ...]]:
    """Yield title, worst value, where and when, and its bound; one row for each side that is bounded by itself."""
    two_sided = np.all(usage.lower == -usage.upper)
    bounds = {"largest ": usage.upper, "smallest ": usage.lower}
    sides = [""] if two_sided else [side for side, bound in bounds.items() if np.any(np.isfinite(bound))]
    for side in sides:
        excess = {"largest ": usage.value - usage.upper, "smallest ": usage.lower - usage.value}.get(side, usage.excess)
        k, i = first_largest(excess / usage.scale)
        value, lower, upper = float(usage.value[k, i]), float(usage.lower[i]), float(usage.upper[i])
        bound = upper if side == "largest " or (two_sided and value > 0) else lower
        value = on_bound(usage, k, i, bound)
        shown, limit = both_apart(value, bound, usage.unit)
        sign = "±" if two_sided else "≤ " if side == "largest " else "≥ "
        where = f"{usage.items[i]}, t = {usage.times[k]:.2f} s"
        limit = limit.lstrip("-") if two_sided else limit
        title = f"{side if len(sides) > 1 else ''}{usage.title}"
        yield title, shown, where, f"{sign}{limit}"
