"""The formulas of the second formulation: what each limit and goal means, written by hand in CVXPY."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from synergrip.conic.goals.centred_joints import CentredJoints
from synergrip.conic.goals.goal import Goal
from synergrip.conic.goals.kept_scalar import KeptScalar
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.goals.least_holding import LeastHolding
from synergrip.conic.goals.least_motion import LeastMotion
from synergrip.conic.goals.least_peak import LeastPeak
from synergrip.conic.goals.least_reconfiguration import LeastReconfiguration
from synergrip.conic.goals.steady_forces import SteadyForces
from synergrip.conic.goals.weighted_sum import WeightedSum
from synergrip.conic.limits.actuator_effort import ActuatorEffort
from synergrip.conic.limits.elastic_motion import ElasticMotion
from synergrip.conic.limits.friction_cone import FRICTION, FrictionCone
from synergrip.conic.limits.friction_reserve import FrictionReserve
from synergrip.conic.limits.joint_range import JointRange
from synergrip.conic.limits.joint_torque import JointTorque
from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.normal_force import NormalForce, bound_unit
from synergrip.conic.limits.object_error import ObjectError
from synergrip.conic.limits.slip_margin import SlipMargin
from synergrip.conic.limits.sustained_effort import SustainedEffort
from synergrip.conic.limits.sustained_torque import SustainedTorque
from synergrip.conic.limits.synergy_acceleration import SynergyAcceleration
from synergrip.conic.limits.synergy_rate import SynergyRate
from synergrip.conic.limits.synergy_reference import SynergyReference
from synergrip.conic.rows import items_of
from synergrip.linalg import Array
from synergrip.referee.friction import NotWrittenError, contact_cones
from synergrip.referee.model import Cone, Expression, Model, Written
from synergrip.referee.motion_formulas import elastic_motion, joint_range, object_error, synergy_acceleration
from synergrip.referee.motion_goals import (
    centred_joints,
    least_holding,
    least_motion,
    least_reconfiguration,
    steady_forces,
)
from synergrip.referee.sustained import over_time


def write_limit(model: Model, limit: Limit) -> tuple[Cone, ...]:
    """Write one limit down by its physical formula.

    Raises:
        NotWrittenError: there is no formula for this type of limit.
    """
    if type(limit) not in LIMITS:
        raise NotWrittenError.of("limit", limit)
    return LIMITS[type(limit)](model, limit)


def write_goal(model: Model, goal: Goal) -> Written:
    """Write a goal down, in its own units.

    Raises:
        NotWrittenError: there is no formula for this type of goal.
    """
    if type(goal) not in GOALS:
        raise NotWrittenError.of("goal", goal)
    return GOALS[type(goal)](model, goal)


def friction(model: Model, margin: Expression, key: str = FRICTION, ratios: Array | None = None) -> tuple[Cone, ...]:
    """Write ``slip margin >= margin`` of every contact down, margin in force units (docs/theory.md).

    `ratios` (n_c,) are the shares of the friction that may be used.
    """
    grasp = model.response.grasp
    shares = np.ones(grasp.n_c) if ratios is None else ratios
    return tuple(
        cone
        for contact, rows, share in zip(grasp.contacts, grasp.rows, shares, strict=True)
        for cone in contact_cones(contact, model.force[:, rows] / model.force_unit, margin, share, key)
    )


def _friction_reserve(model: Model, limit: FrictionReserve) -> tuple[Cone, ...]:
    """Write the friction cones down with the friction that is left."""
    friction_of = np.array([contact.friction for contact in model.response.grasp.contacts])
    if limit.angle is not None:
        slippery = friction_of > 0
        narrowed = np.tan(np.arctan(friction_of) - limit.angle)
        left = np.where(slippery, narrowed / np.where(slippery, friction_of, 1.0), 1.0)
    else:
        left = np.broadcast_to(limit.ratios if limit.factor is None else 1 / limit.factor, friction_of.shape)
    return friction(model, 0.0, limit.key, 1 - (1 - limit.given_up) * (1 - left))


def _normals(model: Model) -> Expression:
    return model.force[:, [rows.start for rows in model.response.grasp.rows]] / model.force_unit


def _normal_force(model: Model, limit: NormalForce) -> tuple[Cone, ...]:
    names = model.response.grasp.contact_names
    sides, unit = (("lowest", limit.lower, 1.0), ("highest", limit.upper, -1.0)), model.force_unit
    return tuple(
        Cone(
            limit.key,
            items_of(names, side),
            sign * (_normals(model) * (unit / bound_unit(bound, unit)) - bound / bound_unit(bound, unit)),
        )
        for side, bound, sign in sides
        if np.isfinite(bound) and not (side == "lowest" and bound <= 0)  # friction cones say that
    )


def _symmetric(limit: Any, names: tuple[str, ...], value: Expression) -> tuple[Cone, ...]:
    keep = np.flatnonzero(np.isfinite(limit.limit))
    if not len(keep):
        return ()
    share = value[:, keep] @ np.diag(1 / limit.limit[keep])
    low, high = (items_of((names[i] for i in keep), side) for side in ("lowest", "highest"))
    return Cone(limit.key, low, 1 + share), Cone(limit.key, high, 1 - share)


def _synergy_rate(model: Model, limit: SynergyRate) -> tuple[Cone, ...]:
    keep = np.flatnonzero(np.isfinite(limit.limit))
    if len(model.times) < 2 or not len(keep):
        return ()
    allowed = np.diff(model.times)[:, None] * limit.limit[keep]
    unit = allowed.max(axis=0)
    share = (model.dz_r[1:, keep] - model.dz_r[:-1, keep]) @ np.diag(1 / unit)
    names = [model.response.grasp.synergies[i] for i in keep]
    falling, rising = (items_of(names, side) for side in ("falling", "rising"))
    return Cone(limit.key, falling, allowed / unit + share), Cone(limit.key, rising, allowed / unit - share)


def _largest_margin(model: Model, goal: LargestMargin) -> Written:
    margin = model.scalar()
    return Written(-margin, friction(model, margin), margin)


def _least_effort(model: Model, goal: LeastEffort) -> Written:
    import cvxpy as cp

    scale = model.response.scale
    if goal.of == "contact":
        share = model.force @ np.diag(scale.force / model.force_unit)
    elif goal.of == "torque":
        share = model.torque / (model.force_unit * scale.length)
    else:
        share = model.effort / (model.force_unit * scale.length)
    return Written(0.5 * cp.sum_squares(share))


def _least_peak(model: Model, goal: LeastPeak) -> Written:
    peak = model.scalar()
    items = items_of(contact.name for contact in model.response.grasp.contacts)
    return Written(peak, (Cone("goal.minimise", items, peak - _normals(model)),), peak)


def _weighted_sum(model: Model, goal: WeightedSum) -> Written:
    model = replace(model, units=model.stated)
    return Written(sum(weight * write_goal(model, each).cost for each, weight in goal.goals))


def _kept_scalar(model: Model, limit: KeptScalar) -> tuple[Cone, ...]:
    return write_goal(replace(model, units=limit.units, kept=limit.scalar), limit.goal).cones


LIMITS: dict[type, Callable[[Model, Any], tuple[Cone, ...]]] = {
    SlipMargin: lambda model, limit: friction(model, limit.margin / model.force_unit, limit.key),
    FrictionCone: lambda model, limit: friction(model, limit.margin / model.force_unit, limit.key),
    FrictionReserve: _friction_reserve,
    NormalForce: _normal_force,
    JointTorque: lambda model, limit: _symmetric(limit, model.response.grasp.joints, model.torque),
    ActuatorEffort: lambda model, limit: _symmetric(limit, model.response.grasp.synergies, model.effort),
    SustainedTorque: lambda model, limit: over_time(model, limit, model.response.grasp.joints, model.torque),
    SustainedEffort: lambda model, limit: over_time(model, limit, model.response.grasp.synergies, model.effort),
    SynergyReference: lambda model, limit: _symmetric(limit, model.response.grasp.synergies, model.dz_r),
    SynergyRate: _synergy_rate,
    SynergyAcceleration: synergy_acceleration,
    JointRange: joint_range,
    ElasticMotion: elastic_motion,
    ObjectError: object_error,
    KeptScalar: _kept_scalar,
}
GOALS: dict[type, Callable[[Model, Any], Written]] = {
    LargestMargin: _largest_margin,
    LeastEffort: _least_effort,
    LeastPeak: _least_peak,
    LeastReconfiguration: least_reconfiguration,
    LeastMotion: least_motion,
    LeastHolding: least_holding,
    SteadyForces: steady_forces,
    CentredJoints: centred_joints,
    WeightedSum: _weighted_sum,
}
