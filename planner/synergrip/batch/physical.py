"""Answers judged as physics: forces made anew from references and load by the response of the grasp, and no program."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from synergrip.batch.assembly import Assembled, columns
from synergrip.batch.stated import Stated
from synergrip.conic.affine import times
from synergrip.conic.limits.actuator_effort import ActuatorEffort
from synergrip.conic.limits.joint_range import JointRange
from synergrip.conic.limits.joint_torque import JointTorque
from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.limits.synergy_reference import SynergyReference
from synergrip.grasps.friction_cones import slip_margins
from synergrip.linalg import Array
from synergrip.planning.between import LIMIT
from synergrip.planning.verified import EXACT
from synergrip.values import Value


@dataclass(frozen=True, eq=False, repr=False)
class Physical(Value):
    """What references do, for N problems."""

    dz_r: Array  # (N, n_z)
    forces: Array  # (N, n_l) [N, N m]
    margins: Array  # (N, n_c) [N]
    holds: NDArray[np.bool_]
    """(N,) whether the object is in equilibrium and all limits are kept."""


def judged(assembled: Assembled, v: Array, margin: Array, wrench: Array) -> Physical:
    """Return what the unknowns v (N, n) of programs do.

    Args:
        assembled: the programs, for what they mean.
        v: their unknowns.
        margin: (N,) [N] that the contacts are to keep.
        wrench: (N, 6) load about B [N, N m].
    """
    stated, formulation = assembled.stated, assembled.stated.formulation
    parts = formulation.parts(v * columns(stated, assembled.unit))
    dz_r = times(formulation.map_of(lambda at: at.coordinates.inverse), np.concatenate(parts, axis=1))
    made = times(formulation.map_of(lambda at: at.response.dlambda_dzr), dz_r)
    forces = stated.at_rest + made
    normal = forces[:, stated.grasps[0].normal_rows]
    margins = slip_margins(assembled.cones, normal, forces)
    sizes = np.abs(forces * stated.metric.force)
    carried = np.stack([sizes[:, rows].max(axis=1) for rows in stated.grasps[0].rows], axis=1)
    carried = np.maximum(carried, assembled.unit[:, None])
    holds = _balanced(stated, forces, wrench) & np.all(margins >= margin[:, None] - LIMIT * carried, axis=1)
    for limit in stated.task.limits:
        holds &= _kept(stated, limit, forces, dz_r, wrench, carried)
    return Physical(dz_r, forces, margins, holds & np.isfinite(dz_r).all(axis=1))


def _balanced(stated: Stated, forces: Array, wrench: Array) -> NDArray[np.bool_]:
    """Return (N,) whether ``G lambda + w`` is 0 beside the forces."""
    left = times(stated.formulation.map_of(lambda at: at.response.grasp.G), forces) + wrench
    scaled = stated.metric.scaled_wrenches(left)
    size = np.abs(forces * stated.metric.force).max(axis=1)
    return np.asarray(np.abs(scaled).max(axis=1) <= EXACT * np.maximum(size, 1e-12))


def _kept(stated: Stated, limit: Limit, forces: Array, dz_r: Array, wrench: Array, carried: Array) -> NDArray[np.bool_]:
    """Return (N,) whether a limit is kept by physical quantities."""
    formulation = stated.formulation
    if isinstance(limit, NormalForce):
        normal = forces[:, stated.grasps[0].normal_rows]
        beyond = np.maximum(normal - limit.upper, limit.lower - normal)
        return np.asarray(np.all(beyond <= LIMIT * carried, axis=1))
    torques = times(formulation.map_of(lambda at: at.response.grasp.J.mT), forces)
    if isinstance(limit, JointTorque):
        return _within(torques, limit.limit)
    if isinstance(limit, ActuatorEffort):
        return _within(times(formulation.map_of(lambda at: at.response.grasp.S.mT), torques), limit.limit)
    if isinstance(limit, SynergyReference):
        return _within(dz_r, limit.limit)
    assert isinstance(limit, JointRange)
    if limit.lets_go:
        return np.ones(len(forces), dtype=bool)
    own = limit.on(stated.grasps[0])
    load = wrench - formulation.map_of(lambda at: at.response.grasp.w_0)
    of_load = 0.0 if formulation.departure is not None else times(
        formulation.map_of(lambda at: at.response.dq_dw), load
    )  # fmt: skip
    value = stated.begins(limit) + times(formulation.map_of(lambda at: at.response.dq_dzr), dz_r) + of_load
    half = np.where(np.isfinite(own.upper - own.lower), (own.upper - own.lower) / 2, 1.0)
    beyond = np.maximum(value - own.upper, own.lower - value)
    return np.asarray(np.all(beyond <= LIMIT * half, axis=1))


def _within(values: Array, limit: Array) -> NDArray[np.bool_]:
    return np.asarray(np.all(np.abs(values) <= limit * (1 + LIMIT), axis=1))
