"""What references use of every limit, as rows of a table."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from synergrip.conic.limits.actuator_effort import ActuatorEffort
from synergrip.conic.limits.limit import Limit, Usage
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.limits.object_error import AXES, ObjectError
from synergrip.conic.limits.sustained_effort import SustainedEffort
from synergrip.conic.limits.synergy_acceleration import SynergyAcceleration
from synergrip.conic.limits.synergy_rate import SynergyRate
from synergrip.conic.limits.synergy_reference import SynergyReference
from synergrip.conic.limits.ties import first_worst
from synergrip.documents.quantities import SHOWN_IN, both_apart, plain, read_as
from synergrip.grasps.grasp import Grasp
from synergrip.hands.units import SI_UNITS, joint_kinds, synergy_kinds
from synergrip.planning.between import LIMIT
from synergrip.statics.analysis import Analysis
from synergrip.statics.motion import Motion
from synergrip.tasks.timed_task import TimedTask
from synergrip.tasks.tracking import off_target

OF_SYNERGIES: dict[type[Limit], dict[str, str]] = {
    SynergyReference: SI_UNITS, SynergyRate: {"hinge": "rad/s", "slide": "m/s"},
    SynergyAcceleration: {"hinge": "rad/s^2", "slide": "m/s^2"},
    ActuatorEffort: {"hinge": "N m", "slide": "N"}, SustainedEffort: {"hinge": "N m", "slide": "N"},
}  # fmt: skip
"""What limits on synergies bound, in the units of synergies whose columns of S move joints that turn or slide."""
OF_ITEMS = {"joint value": "joint"}
"""Title of a limit whose items have ends of their own -> what one of them is called."""
WITHIN = ", within tolerance"
"""Behind a bound that a value is beyond by no more than counts as kept."""
STAR = " *"
"""The same where there is little room; `text_between.tolerated` says below what it means."""


def used_rows(
    usages: Sequence[Usage], motion: Motion, task: TimedTask, analysis: Analysis, mark: str = ""
) -> list[tuple[str, ...]]:
    """Return the rows of all limits; of normal forces, errors of a motion and references where no limit is on them.

    Args:
        usages: of the limits of the task.
        motion: what is told of.
        task: its limits and what is wanted.
        analysis: of the grasp.
        mark: behind bounds that values are beyond.
    """
    grasp, rows = analysis.grasp, limit_rows(usages, task, analysis.grasp, mark)
    if not any(isinstance(limit, NormalForce) and np.isfinite(limit.upper) for limit in task.limits):
        rows.insert(1, _largest_normal(grasp, motion))
    rows += error_rows(motion, task, analysis)
    if not any(isinstance(limit, SynergyReference) for limit in task.limits):
        units = synergy_units(SynergyReference(np.inf), grasp)
        rows.append(_largest("synergy reference", motion.dz_r, units, grasp.synergies, motion.times))
    return rows


def limit_rows(usages: Sequence[Usage], task: TimedTask, grasp: Grasp, mark: str = "") -> list[tuple[str, ...]]:
    """Return the rows of the limits of a task; what is of synergies has the unit of the joints that they move."""
    of_each = zip(task.all_limits, usages, strict=True)
    return [row for limit, usage in of_each for row in _usage_rows(usage, synergy_units(limit, grasp), mark)]


def synergy_units(limit: Limit, grasp: Grasp) -> dict[str, str]:
    """Return the unit of what a limit bounds of each synergy; none for other limits, and where nobody knows."""
    units = next((units for kind, units in OF_SYNERGIES.items() if isinstance(limit, kind)), None)
    if units is None or grasp.held is None:
        return {}
    kinds = synergy_kinds(grasp.held.synergies, joint_kinds(grasp.held.hand.joints).values())
    return {name: units[kind] for name, kind in kinds.items()}


def error_rows(motion: Motion, task: TimedTask, analysis: Analysis) -> list[tuple[str, ...]]:
    """Return how far the object is from where it is to be moved to, at most; none where a limit on that has a row."""
    limits = [limit for limit in task.all_limits if isinstance(limit, ObjectError) and limit.part == "whole"]
    if any({*task.axes} <= {*limit.axes} for limit in limits) or task.target.kind == "hold":
        return []
    off, rows = off_target(analysis, task, motion.du), list[tuple[str, ...]]()
    for title, part, unit in (("position error", slice(3), "m"), ("rotation error", slice(3, 6), "rad")):
        if any(axis in task.axes for axis in AXES[part]):
            size = np.linalg.norm(off[:, part], axis=1)
            k, _ = first_worst(size[:, None], size[:, None])
            rows.append((title, read_as(float(size[k]), unit), f"object, t = {motion.times[k]:.2f} s", ""))
    return rows


def _largest_normal(grasp: Grasp, motion: Motion) -> tuple[str, ...]:
    normal = motion.forces[:, grasp.normal_rows]
    names = grasp.contact_names
    return _largest("largest normal force", normal, dict.fromkeys(names, "N"), names, motion.times)


def _largest(
    title: str, values: np.ndarray, units: Mapping[str, str], names: Sequence[str], times: np.ndarray
) -> tuple[str, ...]:
    size = np.abs(values)
    k, i = first_worst(size, values)
    shown = f"{plain(values[k, i])} {units.get(names[i], '')}".rstrip()
    return title, shown, f"{names[i]}, t = {times[k]:.2f} s", ""


def on_bound(usage: Usage, k: int, i: int, bound: float) -> float:
    """Return the value of item i at knot k; the bound when it is on it, as far as the check can tell."""
    value = float(usage.value[k, i])
    return bound if abs(value - bound) <= LIMIT * float(usage.size[k, i]) else value


def worst_of(
    usage: Usage, units: Mapping[str, str] | None = None, *, mark: str = ""
) -> Iterator[tuple[str, str, str, float, str]]:
    """Yield title, worst value, item, time [s] and bound; one for each side that is bounded by itself.

    Args:
        usage: of a limit.
        units: of some items, where that of the limit says less.
        mark: behind a bound that the value is beyond, such as `WITHIN` where the limit counts as kept.
    """
    two_sided = np.all(usage.lower == -usage.upper)
    bounds = {1: usage.upper, -1: usage.lower}
    sides = [0] if two_sided else [side for side, bound in bounds.items() if np.any(np.isfinite(bound))]
    for side in sides:
        k, i = usage.worst(side)
        value, lower, upper = float(usage.value[k, i]), float(usage.lower[i]), float(usage.upper[i])
        bound = upper if side == 1 or (two_sided and value > 0) else lower
        value = on_bound(usage, k, i, bound)
        beyond = value > bound if bound == upper else value < bound
        unit = "" if usage.unit in SHOWN_IN else (units or {}).get(usage.items[i], "")
        shown, limit = (f"{told} {unit}".rstrip() for told in both_apart(value, bound, usage.unit))
        sign = "±" if two_sided else "≤ " if side == 1 else "≥ "
        limit = f"{limit.lstrip('-') if two_sided else limit}{mark * beyond}"
        title = side_title(usage, side) if len(sides) > 1 else usage.title
        yield title, shown, str(usage.items[i]), float(usage.times[k]), f"{sign}{limit}"


def as_little(margins: np.ndarray) -> str:
    """Return at how many contacts more the slip margins (T, n_c) get as small as the smallest, to the digits shown."""
    least = [plain(value) for value in margins.min(axis=0)]
    others = least.count(plain(margins.min())) - 1
    return f", and as little at {others} other contact{'s' * (others > 1)}" if others else ""


def side_title(usage: Usage, side: int) -> str:
    """Return what the worst value of the upper side, 1, or of the lower side, -1, of a limit is.

    It is the one nearest to its bound, which is the largest, or smallest, only where all items have the same bound.
    """
    bound = usage.upper if side == 1 else usage.lower
    if np.all(bound == bound[0]) and np.all(usage.scale == usage.scale[0]):
        return f"{'largest' if side == 1 else 'smallest'} {usage.title}"
    return f"{OF_ITEMS.get(usage.title, usage.title)} nearest {'upper' if side == 1 else 'lower'} end"


def _usage_rows(usage: Usage, units: Mapping[str, str], mark: str) -> Iterator[tuple[str, ...]]:
    """Yield title, worst value, where and when, and its bound."""
    for title, shown, item, time, limit in worst_of(usage, units, mark=mark):
        yield title, shown, f"{item}, t = {time:.2f} s", limit
