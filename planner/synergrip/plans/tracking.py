"""Rigid tracking: beta from the wanted motion, or the refusal that says what leaves Gamma_ucs."""

from __future__ import annotations

import numpy as np

from synergrip.errors import InputError, MotionCountError, MotionDirectionError
from synergrip.linalg import Array, frozen
from synergrip.plans.analysis import Analysis
from synergrip.plans.task import Task
from synergrip.statics.theorem1 import motion_coordinates
from synergrip.statics.twists import describe_displacement

RIGID_TOLERANCE = 1e-6
"""Share of the wanted motion that may lie outside Gamma_ucs and still counts as rounding of the data."""


def rigid_coordinates(analysis: Analysis, task: Task) -> Array:
    """Return beta (T, dim Gamma_ucs) [m] for the wanted motion.

    Raises:
        MotionCountError: more independent motions are asked for than there are synergies.
        MotionDirectionError: the motion leaves Gamma_ucs by more than the tolerance.
        InputError: modes are given with another number of columns than Gamma_ucs has.
    """
    dimension = analysis.spaces.Gamma_ucs.shape[1]
    values = task.wanted.values
    if task.wanted.kind == "hold":
        return frozen(np.zeros((len(task.times), dimension)))
    if task.wanted.kind in ("modes", "mode moves"):
        asked = values.shape[1]
        if asked > dimension or (task.wanted.kind == "modes" and asked < dimension):
            what = (
                f"mode {asked} is asked for" if task.wanted.kind == "mode moves" else f"{asked} columns of beta given"
            )
            message = f"{what}, but Gamma_ucs of this grasp has dimension {dimension}"
            raise InputError.at(task.wanted.key, message)
        return frozen(np.pad(values, ((0, 0), (0, dimension - asked))))
    wish = float(np.linalg.norm(analysis.response.scale.twist(values), axis=1).max(initial=0.0))
    allowed = max(RIGID_TOLERANCE * wish, task.tolerance)
    _count(analysis, values, allowed)
    beta, outside = motion_coordinates(analysis.response, analysis.spaces, values)
    sizes = np.linalg.norm(analysis.response.scale.twist(outside), axis=1)
    if sizes.max(initial=0.0) > allowed:
        raise _direction(analysis, task, outside, sizes)
    return frozen(beta)


def _count(analysis: Analysis, values: Array, allowed: float) -> None:
    """Refuse a motion with more independent directions than the hand has synergies (Remark 3).

    Directions are counted until what is left of the motion is within `allowed` [m] at every knot.
    """
    scale, n_z = analysis.response.scale, analysis.grasp.n_z
    left = scale.twist(values)
    directions = np.linalg.svd(left, full_matrices=True)[2]
    asked = 0
    while asked < 6 and np.linalg.norm(left, axis=1).max(initial=0.0) > allowed:
        left = left - np.outer(left @ directions[asked], directions[asked])
        asked += 1
    if asked > n_z:
        message = (
            f"the task asks for {asked} independent object motions, the hand has n_z = {n_z} "
            f"{'synergy' if n_z == 1 else 'synergies'} for motions, internal forces and redundancy together (34)"
        )
        twists = np.linalg.solve(scale.motion, directions[:asked].T)
        raise MotionCountError(message, asked, n_z, frozen(twists))


def _direction(analysis: Analysis, task: Task, outside: Array, sizes: Array) -> MotionDirectionError:
    scale, values = analysis.response.scale, task.wanted.values
    k = int(np.argmax(sizes))
    share = float(sizes[k] / np.linalg.norm(scale.twist(values[k])))
    dimension, n_z = analysis.spaces.Gamma_ucs.shape[1], analysis.grasp.n_z
    part, whole = (describe_displacement(motion[k], scale.length) for motion in (outside, values))
    message = (
        f"{share:.0%} of the wanted motion lies outside Gamma_ucs, the rigid motions that these {n_z} synergies can "
        f"produce (dimension {dimension}): at t = {task.times[k]:.3g} s, of {whole} about B, {part} would have to come "
        "from deforming the contacts"
    )
    return MotionDirectionError(message, frozen(outside[k]), float(task.times[k]), share, float(sizes[k]))
