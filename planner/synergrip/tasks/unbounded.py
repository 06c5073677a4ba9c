"""Goals that nothing bounds, and what would."""

from __future__ import annotations

from synergrip.conic.goals.goal import Goal
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.errors import InputError

BOUNDING = (
    "normal_force", "joint_torque", "actuator_effort", "sustained_torque", "sustained_effort", "synergy_reference",
    "joint_range",
)  # fmt: skip
"""Limits each of which alone bounds the largest margin, also where squeezing harder always helps."""
MAXIMISED = "goal.maximise"
"""The key under which the largest margin is asked for, unless it is one of several goals."""


def unbounded(goal: Goal) -> InputError:
    """Return the error of a goal that nothing bounds."""
    if not isinstance(goal, LargestMargin):
        return InputError.at("Task.goals", f"nothing bounds '{goal.name}': give a limit that does")
    listed = ", ".join(f"limits.{name}" for name in BOUNDING[:-1])
    message = (
        f"nothing bounds the largest margin: squeezing harder always helps; give {listed} or limits.{BOUNDING[-1]} "
        "(in code such as NormalForce(upper=20.0))"
    )
    return InputError.at(MAXIMISED, message)
