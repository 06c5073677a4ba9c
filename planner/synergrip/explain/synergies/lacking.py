"""What a hand must be able to do, and with its synergies cannot: motions of the object, directions of force.

A motion u is free when ``G'u`` is in the range of J S (Gamma_ucs), and a direction e of internal force is controlled
when ``(C_s + J C_q J') e`` is in the range of ``[J S, G']``. So a lack is a contact motion outside a range, and columns
X repair it when J X brings it in. Contact motions are in scaled coordinates throughout.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.conic.limits.object_error import AXES, axis_weights
from synergrip.errors import SynergripError
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.other_synergies import extended
from synergrip.grasps.scale import Scale
from synergrip.linalg import RANK_TOLERANCE, Array, frozen
from synergrip.statics.analysis import Analysis, analyse
from synergrip.tasks.timed_task import TimedTask
from synergrip.tasks.tracking import RIGID_TOLERANCE, apart_by, target_displacement
from synergrip.values import Value

COVERED = 1e-7
"""Share of a contact motion that may be left outside a range it is said to be in."""


@dataclass(frozen=True, eq=False, repr=False)
class Lack(Value):
    """Contact motions that synergies must reach beyond those in a range."""

    outside: Array
    """(n_l, p) orthonormal basis of the complement of that range."""
    wanted: Array
    """(p, r) what is wanted, in that complement; its columns are independent and of length 1."""
    J: Array
    """(p, n_q) what the joints move there."""

    @classmethod
    def of(cls, scale: Scale, J: Array, reached: Array, wanted: Array) -> Lack:
        """Return the lack of contact motions `wanted` (n_l, k) beyond the range of `reached` (n_l, m)."""
        vectors, values, _ = np.linalg.svd(reached)
        rank = int(np.sum(values > RANK_TOLERANCE * values.max(initial=0.0)))
        outside = vectors[:, rank:]
        size = np.linalg.norm(wanted, axis=0).max(initial=0.0)
        left, sizes, _ = np.linalg.svd(outside.T @ wanted, full_matrices=False)
        counted = int(np.sum(sizes > RANK_TOLERANCE * size)) if size > 0 else 0
        return cls(frozen(outside), frozen(left[:, :counted]), frozen(outside.T @ scale.scaled_rows(J)))

    @property
    def count(self) -> int:
        """How many columns it takes at least."""
        return int(self.wanted.shape[1])

    def covered(self, columns: Array) -> Array:
        """Return whether columns (..., n_q, k), appended to S, reach all that is wanted (...)."""
        if not self.count:
            return np.ones(columns.shape[:-2], dtype=bool)
        moved = self.J @ columns
        largest = np.linalg.norm(self.J, 2) * np.linalg.norm(columns, axis=-2).max(axis=-1, initial=0.0)
        moved = moved / np.where(largest > 0, largest, 1.0)[..., None, None]
        left = self.wanted - moved @ (np.linalg.pinv(moved, rcond=RANK_TOLERANCE) @ self.wanted)
        return np.asarray(np.linalg.norm(left, axis=(-2, -1)) <= COVERED)

    def least_columns(self, weights: Array) -> Array:
        """Return (n_q, r) the joint motions of least norm that reach what is wanted, each joint times its weight."""
        solved, *_ = np.linalg.lstsq(self.J / weights, self.wanted, rcond=RANK_TOLERANCE)
        return np.asarray(solved / weights[:, None])


@dataclass(frozen=True, eq=False, repr=False)
class Lacking(Value):
    """What the synergies of a grasp lack for a task."""

    lacks: tuple[Lack, ...]
    proven: bool
    """Whether it is certain that fewer columns do not do: with a tolerance other directions might."""
    beyond: float
    """How far [m] the wanted motion leaves what even all joints together can follow, where that counts; else 0."""
    forces_beyond: bool
    """Whether some asked direction of force is none that all joints together control."""

    @property
    def count(self) -> int:
        """The fewest columns: a column that frees a motion is nothing to the lack of forces, so that these add up."""
        return sum(lack.count for lack in self.lacks)


def lacking(analysis: Analysis, task: TimedTask, forces: Array | None = None) -> Lacking:
    """Return what is lacking for the wanted motion of a task, and for directions of force.

    Args:
        analysis: of the grasp.
        task: with a wanted motion.
        forces: (n_l, k) directions of internal force to be controlled; none when None.
    """
    grasp, scale = analysis.grasp, analysis.response.scale
    every = all_joints(grasp)
    of_S, of_object = scale.scaled_rows(grasp.J @ grasp.S), scale.scaled_grasp(grasp.G)
    directions, proven, beyond = _directions(analysis, every, task)
    motion = Lack.of(scale, grasp.J, of_S, of_object @ scale.motion @ directions)
    lacks, forces_beyond = [motion], False
    if forces is not None:
        yielding = (grasp.C_s + grasp.J @ grasp.C_q @ grasp.J.T) @ _internal(grasp, forces)
        force = Lack.of(scale, grasp.J, np.hstack([of_S, of_object]), scale.scaled_rows(yielding))
        forces_beyond = not bool(force.covered(np.eye(grasp.n_q)))
        lacks.append(force)
    return Lacking(tuple(lacks), proven, beyond, forces_beyond)


def all_joints(grasp: Grasp) -> Grasp:
    """Return the grasp with every joint as a synergy of its own, beside those that it has."""
    return extended(grasp, grasp.joints, np.eye(grasp.n_q))


def _internal(grasp: Grasp, forces: Array) -> Array:
    """Return the part of forces (n_l, k) that does not push the object."""
    return np.asarray(forces - np.linalg.pinv(grasp.G) @ (grasp.G @ forces))


def _directions(analysis: Analysis, every: Grasp, task: TimedTask) -> tuple[Array, bool, float]:
    """Return the object motions (6, k) that must become free, as few as will do, beside those that are.

    Also whether fewer are certain not to do, and how far [m] the wish leaves what all joints can follow, or 0 where
    that does not count.
    """
    scale = analysis.response.scale
    if task.tracking == "compliant" or task.target.kind != "motion":
        return np.zeros((6, 0)), True, 0.0  # modes are coordinates of Gamma_ucs, and who yields asks for no direction
    whole = len(task.axes) == len(AXES)
    weights = scale.motion if whole else axis_weights(task.axes, scale.length)
    wish = target_displacement(analysis, task, task.target.values) @ weights.T
    size = np.linalg.norm(scale.twist(task.target.values), axis=1).max(initial=0.0)
    allowed = max(RIGID_TOLERANCE * float(size), task.tolerance)
    able = _able(every, analysis)
    seen = weights @ able
    beyond = float(np.linalg.norm(wish - _projected(wish, seen), axis=1).max(initial=0.0))
    beyond = beyond if beyond > allowed else 0.0
    left = _projected(wish - _projected(wish, weights @ analysis.spaces.Gamma_ucs), seen)
    _, _, rows = np.linalg.svd(left, full_matrices=False)
    count = next(k for k in range(len(rows) + 1) if k == len(rows) or _within(left, rows[:k], allowed))
    proven = count == 0 or apart_by(left, count) > allowed
    reached = np.linalg.pinv(seen, rcond=RANK_TOLERANCE) @ rows[:count].T
    return np.asarray(able @ reached), bool(proven), beyond


def _able(every: Grasp, analysis: Analysis) -> Array:
    """Return Gamma_ucs (6, dim) of all joints; that of the synergies where it cannot be told."""
    try:
        return analyse(every).spaces.Gamma_ucs
    except SynergripError:
        return analysis.spaces.Gamma_ucs


def _projected(rows: Array, basis: Array) -> Array:
    """Return the part of rows (T, m) in the range of `basis` (m, k)."""
    return np.asarray(rows @ np.linalg.pinv(basis, rcond=RANK_TOLERANCE).T @ basis.T)


def _within(rows: Array, directions: Array, allowed: float) -> bool:
    """Return whether all rows are within a distance of the span of orthonormal directions (k, m)."""
    left = rows - rows @ directions.T @ directions
    return bool(np.linalg.norm(left, axis=1).max() <= allowed)
