"""The formulas of the second formulation that speak of motion: joints, accelerations, where the object is."""

from __future__ import annotations

import numpy as np

from synergrip.conic.limits.elastic_motion import ElasticMotion
from synergrip.conic.limits.joint_range import JointRange
from synergrip.conic.limits.object_error import ObjectError
from synergrip.conic.limits.synergy_acceleration import SynergyAcceleration
from synergrip.conic.rows import Item, items_of
from synergrip.linalg import Array
from synergrip.referee.model import Cone, Expression, Model
from synergrip.referee.targets import COLUMNS


def synergy_acceleration(model: Model, limit: SynergyAcceleration) -> tuple[Cone, ...]:
    """Write the second differences of the references down, over steps of any length."""
    keep = np.flatnonzero(np.isfinite(limit.limit))
    if len(model.times) < 3 or not len(keep):
        return ()
    h = np.diff(model.times)[:, None]
    z = model.dz_r[:, keep]
    # in the units of the direct rows: the bound times the steps' product, of the longest steps
    weight = h[1:] * (h[1:] + h[:-1]) / 2
    unit = (weight * limit.limit[keep]).max(axis=0)
    rates = times_rows(1 / h, z[1:] - z[:-1])
    share = times_rows(2 * weight / (h[1:] + h[:-1]), rates[1:] - rates[:-1]) @ np.diag(1 / unit)
    allowed = weight * limit.limit[keep] / unit
    names = [model.response.grasp.synergies[i] for i in keep]
    falling, rising = (items_of(names, side) for side in ("falling", "rising"))
    return Cone(limit.key, falling, allowed + share), Cone(limit.key, rising, allowed - share)


def times_rows(weights: Array, value: Expression) -> Expression:
    """Return weights (T, 1) times the rows of value (T, m)."""
    import cvxpy as cp

    return cp.multiply(np.broadcast_to(weights, value.shape), value)


def joint_range(model: Model, limit: JointRange) -> tuple[Cone, ...]:
    """Write every joint within its range down."""
    names, q = model.response.grasp.joints, model.joints + limit.start[None, :]
    half = (limit.upper - limit.lower) / 2
    unit = np.where(np.isfinite(half) & (half > 0), half, 1.0)
    cones = []
    for side, bound, sign in (("lowest", limit.lower, 1.0), ("highest", limit.upper, -1.0)):
        keep = np.flatnonzero(np.isfinite(bound))
        if len(keep):
            room = sign * (q[:, keep] - np.tile(bound[keep], (len(model.times), 1))) @ np.diag(1 / unit[keep])
            cones.append(Cone(limit.key, items_of((names[i] for i in keep), side), room))
    return tuple(cones)


def elastic_motion(model: Model, limit: ElasticMotion) -> tuple[Cone, ...]:
    """Write the motion beyond the rigid one within its bound down."""
    value = (model.moved - model.rigid) @ model.response.scale.motion.T / limit.limit
    return (Cone(limit.key, (Item("object", "norm"),), np.ones(len(model.times)), value),)


def object_error(model: Model, limit: ObjectError) -> tuple[Cone, ...]:
    """Write the object near where it is wanted down."""
    reached = model.moved + model.sag if limit.part == "whole" else model.rigid
    sizes = np.array([1.0, 1.0, 1.0, *[model.response.scale.length] * 3])
    columns = [COLUMNS[axis] for axis in limit.axes]
    error = (reached - model.target)[:, columns] @ np.diag(sizes[columns] / limit.limit)
    return (Cone(limit.key, (Item("object", "norm"),), np.ones(len(model.times)), error),)
