"""The [limits] table made into limits. A new limit is listed here."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from synergrip.conic.limits.actuator_effort import ActuatorEffort
from synergrip.conic.limits.elastic_motion import ElasticMotion
from synergrip.conic.limits.friction_reserve import FrictionReserve
from synergrip.conic.limits.joint_range import JointRange
from synergrip.conic.limits.joint_torque import JointTorque
from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.limits.object_error import ObjectError
from synergrip.conic.limits.synergy_acceleration import SynergyAcceleration
from synergrip.conic.limits.synergy_rate import SynergyRate
from synergrip.conic.limits.synergy_reference import SynergyReference
from synergrip.errors import InputError, Issue, raise_issues
from synergrip.grasps.grasp import Grasp
from synergrip.hands.units import list_misfits, torque_unit
from synergrip.linalg import Array, frozen
from synergrip.problems.limits_file import GoalTable
from synergrip.problems.problem_file import ProblemFile

Given = float | str | tuple[float, ...]


@dataclass(frozen=True)
class HandLimits:
    """What ``"hand"`` stands for; None where no hand is known."""

    torque: Array | None = None  # (n_q,) [N m or N]
    effort: Array | None = None  # (n_z,)
    ranges: JointRange | None = None
    joint_kinds: Mapping[str, str] = field(default_factory=dict)
    """"hinge" or "slide" by joint; empty where no hand is known."""
    synergy_kinds: Mapping[str, str] = field(default_factory=dict)
    """The same by synergy."""


def limits_of(file: ProblemFile, grasp: Grasp, hand: HandLimits) -> tuple[Limit, ...]:
    """Return the limits of a problem, friction cones excepted.

    Raises:
        InputError: a list of the wrong length, ``"hand"`` without a hand that states the limit, units that do
            not suit the joints, or a goal that needs ranges that nobody states.
    """
    table, each = file.limits, _Bounds(grasp)
    readers: dict[str, Callable[[Any], Limit]] = {
        "margin_angle": lambda value: _angle_reserve(grasp, value),
        "safety_factor": lambda value: FrictionReserve(frozen(np.full(grasp.n_c, 1 / value))),
        "normal_force": lambda value: NormalForce(*value),
        "joint_torque": lambda value: _torques(each, value, hand),
        "actuator_effort": lambda value: _efforts(each, value, hand),
        "synergy_reference": lambda value: SynergyReference(each.synergy(value, "synergy_reference")),
        "synergy_rate": lambda value: SynergyRate(each.synergy(value, "synergy_rate")),
        "synergy_acceleration": lambda value: SynergyAcceleration(each.synergy(value, "synergy_acceleration")),
        "joint_range": lambda _: _ranges(hand),
        "elastic_motion": ElasticMotion,
        "drift": ObjectError,
    }
    given = {key: getattr(table, key) for key in readers}
    limits = tuple(readers[key](value) for key, value in given.items() if value is not None)
    raise_issues(list(_without_ranges(file.goal, hand)))
    return limits


def _without_ranges(goal: GoalTable, hand: HandLimits) -> Iterator[Issue]:
    if "centred" in {*goal.names, *goal.weights} and hand.ranges is None:
        message = "'centred' needs a [hand]; a grasp file states no joint ranges"
        yield Issue(message, key=f"goal.{goal.key_of('centred')}")


def _angle_reserve(grasp: Grasp, angle: float) -> FrictionReserve:
    """Return the friction that is left when every contact force stays `angle` [rad] away from its cone."""
    left = np.arctan([contact.friction for contact in grasp.contacts]) - angle
    issues = [
        Issue(f"the friction cone of '{contact.name}' is only {np.degrees(angle + rest):.4g} deg wide; ask for less",
              key="limits.margin_angle")
        for contact, rest in zip(grasp.contacts, left, strict=True)
        if contact.friction and rest <= 0
    ]  # fmt: skip
    raise_issues(issues)
    ratios = [np.tan(rest) / contact.friction if contact.friction else 1.0
              for contact, rest in zip(grasp.contacts, left, strict=True)]  # fmt: skip
    return FrictionReserve(frozen(ratios), "limits.margin_angle", "slip margin with angle")


def _torques(each: _Bounds, value: Given, hand: HandLimits) -> JointTorque:
    limit = each.joint(value, "joint_torque", hand.torque)
    _judge_units("limits.joint_torque", value, hand.joint_kinds, "joint")
    return JointTorque(limit, unit=torque_unit(hand.joint_kinds.values()))


def _efforts(each: _Bounds, value: Given, hand: HandLimits) -> ActuatorEffort:
    limit = each.synergy(value, "actuator_effort", hand.effort)
    _judge_units("limits.actuator_effort", value, hand.synergy_kinds, "synergy")
    return ActuatorEffort(limit)


def _judge_units(key: str, value: Given, kinds: Mapping[str, str], what: str) -> None:
    if kinds and not isinstance(value, str):
        raise_issues(list_misfits(key, value, kinds, what))


def _ranges(hand: HandLimits) -> JointRange:
    if hand.ranges is None:
        raise InputError.at("limits.joint_range", "needs a [hand]; a grasp file states no joint ranges")
    return hand.ranges


@dataclass(frozen=True)
class _Bounds:
    """One bound for each joint or synergy of a grasp."""

    grasp: Grasp

    def joint(self, value: Given, key: str, of_hand: Array | None = None) -> Array:
        return _each(value, self.grasp.joints, "joint", key, of_hand)

    def synergy(self, value: Given, key: str, of_hand: Array | None = None) -> Array:
        return _each(value, self.grasp.synergies, "synergy", key, of_hand)


def _each(value: Given, names: tuple[str, ...], what: str, key: str, of_hand: Array | None = None) -> Array:
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
