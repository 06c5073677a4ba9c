"""A no in words of a grasping engineer: what is to blame, from what value to which."""

from __future__ import annotations

from synergrip.documents.quantities import SHOWN_IN, apart
from synergrip.explain.repairs import Repair
from synergrip.planning.outcome import Infeasible, Plan
from synergrip.tasks.tracking import undone, wish_size

TOO: dict[str, str] = {
    "friction": "friction is too low", "load": "the load is too heavy",
    "force_cap": "the normal forces are capped too low",
    "torque": "the joint torques are limited too tightly", "effort": "the actuators are limited too tightly",
    "margin": "the slip margin asked for is too large", "tolerance": "the tolerance is too tight",
    "drift": "the object may move too little", "rate": "the synergies may change too slowly",
    "acceleration": "the synergies may speed up too slowly", "duration": "the task is too short",
    "synergy_range": "the synergies may not go far enough", "joint_range": "the joint ranges are too narrow",
    "amplitude": "the motion is too large", "stiffness": "the contacts are not as stiff as would do",
    "limit": "a limit is too tight",
}  # fmt: skip
"""Cause -> what is wrong with it, while another value of the same would do."""
LEAST_FORCE = "the normal forces must not be that large everywhere"
FACTORS = {
    "task.load_factor": "times the load", "task.motion_factor": "times the motion",
    "limits.joint_range": "times the ranges",
}  # fmt: skip
"""Key -> what its number is a multiple of."""
INTERRUPTED = "interrupted: changes were not looked for to the end"
SAME = 1e-3
"""Relative difference of values that are told as one."""


def blamed(repair: Repair) -> str:
    """Return what is wrong, and what would do."""
    was, to = values(repair)
    if repair.key.startswith("allow."):
        return f"too much is allowed for: {was} ({repair.key}), and {to} would do"
    what = LEAST_FORCE if repair.cause == "force_cap" and repair.to < repair.was else TOO[repair.cause]
    key = "" if repair.cause == "friction" else f" ({repair.key})"
    return f"{what}: {was}{key}, and {to} would do"


def changed(repair: Repair) -> str:
    """Return what is changed, in words where its key is that of a factor and its value is not."""
    return "friction" if repair.cause == "friction" and not repair.key.startswith("allow.") else repair.key


def most_margin(no: Infeasible) -> str:
    """Return how large a slip margin the other limits leave, beside the one that is asked for."""
    most, asked = apart(no.largest_margin or 0.0, no.task.margin)
    return f"; as it is the largest slip margin is {most} N, {asked} N are asked for"


def values(repair: Repair) -> tuple[str, str]:
    """Return the value and the one that would do, in units that people read."""
    factor, unit = _unit(repair)
    was, to = apart(factor * repair.was, factor * repair.to)
    return f"{was} {unit}".strip(), f"{_digits(factor * repair.to, to)} {unit}".strip()


def nearer(repair: Repair) -> str:
    """Return what the start posture takes at least, and what was tried in vain; nothing where that is what is told."""
    if repair.least is None or abs(repair.to - repair.least) <= SAME * abs(repair.to):
        return ""
    factor, unit = _unit(repair)
    vain = (
        "" if repair.in_vain is None else f" (with {factor * repair.in_vain:.5g} {unit}".rstrip() + " none was found)"
    )
    return f"{changed(repair)} {factor * repair.least:.5g} {unit}".rstrip() + vain


def undone_share(repair: Repair) -> float:
    """Return which share of the wanted motion a change leaves undone where there is a plan with it."""
    plan = repair.outcome
    if not isinstance(plan, Plan) or repair.cause != "tolerance":
        return 0.0
    left = undone(plan.analysis, plan.task)
    return left / wish_size(plan.analysis, plan.task) if left else 0.0


def _unit(repair: Repair) -> tuple[float, str]:
    """Return the unit in which people read a number, and by what its values are multiplied."""
    if repair.unit == "kg" and max(repair.was, repair.to) < 1:
        return 1e3, "g"
    factor, unit = SHOWN_IN.get(repair.unit, (1.0, repair.unit))
    return factor, unit or FACTORS.get(repair.key, "")


def _digits(value: float, short: str) -> str:
    """Return a value in as many digits as it holds with; what is printed can be typed in."""
    return f"{value:.5g}" if float(short) != value else short
