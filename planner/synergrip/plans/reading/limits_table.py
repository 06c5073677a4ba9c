"""The [limits] table made into limits. A new limit is listed here."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.conic.limits.actuator_effort import ActuatorEffort
from synergrip.conic.limits.joint_torque import JointTorque
from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.limits.synergy_rate import SynergyRate
from synergrip.conic.limits.synergy_reference import SynergyReference
from synergrip.errors import InputError
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, frozen
from synergrip.plans.reading.problem_file import ProblemFile

BOUNDING = ("normal_force", "joint_torque", "actuator_effort", "synergy_reference")
"""Limits each of which alone bounds the largest margin."""


@dataclass(frozen=True)
class HandLimits:
    """What ``"hand"`` stands for; None where no hand is known."""

    torque: Array | None = None  # (n_q,) [N m]
    effort: Array | None = None  # (n_z,)


def limits_of(file: ProblemFile, grasp: Grasp, hand: HandLimits) -> tuple[Limit, ...]:
    """Return the limits of a problem, friction cones excepted.

    Raises:
        InputError: a list of the wrong length, ``"hand"`` without a hand that states the limit, or a goal
            that no limit bounds.
    """
    table = file.limits
    limits: list[Limit] = []
    if table.normal_force is not None:
        limits.append(NormalForce(*table.normal_force))
    if table.joint_torque is not None:
        limits.append(JointTorque(_each(table.joint_torque, grasp.joints, "joint", "joint_torque", hand.torque)))
    if table.actuator_effort is not None:
        names = grasp.synergies
        limits.append(ActuatorEffort(_each(table.actuator_effort, names, "synergy", "actuator_effort", hand.effort)))
    if table.synergy_reference is not None:
        limits.append(SynergyReference(_each(table.synergy_reference, grasp.synergies, "synergy", "synergy_reference")))
    if table.synergy_rate is not None:
        limits.append(SynergyRate(_each(table.synergy_rate, grasp.synergies, "synergy", "synergy_rate")))
    if file.goal.name == "margin" and not any(getattr(table, name) is not None for name in BOUNDING):
        raise unbounded()
    return tuple(limits)


def unbounded() -> InputError:
    """Return the error of a largest margin that nothing bounds."""
    listed = ", ".join(f"limits.{name}" for name in BOUNDING[:-1])
    message = (
        f"nothing bounds the largest margin: squeezing harder always helps; give {listed} or limits.{BOUNDING[-1]}"
    )
    return InputError.at("goal.maximise", message)


def _each(
    value: float | str | tuple[float, ...], names: tuple[str, ...], what: str, key: str, of_hand: Array | None = None
) -> Array:
    """Return one bound for each name."""
    if isinstance(value, str):
        if of_hand is None:
            raise InputError.at(f"limits.{key}", "'hand' needs a [hand]; a grasp file states no limits, write numbers")
        if not np.any(np.isfinite(of_hand)):
            raise InputError.at(f"limits.{key}", "this hand states no such limit; write numbers")
        return frozen(of_hand)
    if isinstance(value, tuple) and len(value) != len(names):
        plural = {"joint": "joints", "synergy": "synergies"}[what]
        message = f"expected {len(names)} numbers, one for each of the {plural} {', '.join(names)}; got {len(value)}"
        raise InputError.at(f"limits.{key}", message)
    return frozen(np.broadcast_to(np.asarray(value, dtype=float), (len(names),)))
