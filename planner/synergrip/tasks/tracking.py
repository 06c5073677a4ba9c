"""From the wanted motion to the rigid motion beta, as far as it is fixed, or the refusal that says why not."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from synergrip.conic.limits.object_error import AXES, axis_weights
from synergrip.errors import InputError, MotionCountError, MotionDirectionError
from synergrip.linalg import RANK_TOLERANCE, Array, frozen, split
from synergrip.statics.analysis import Analysis
from synergrip.statics.theorem1 import motion_coordinates
from synergrip.statics.twists import describe_displacement
from synergrip.tasks.timed_task import Target, TimedTask
from synergrip.vectors import rotation_matrices, rotation_vectors

RIGID_TOLERANCE = 1e-6
"""Share of the wanted motion that may lie outside Gamma_ucs and still counts as rounding of the data."""


@dataclass(frozen=True)
class Followed:
    """What the wanted motion says about the rigid motion."""

    beta: Array  # (T, dim Gamma_ucs) [m]
    basis: Array
    """(dim Gamma_ucs, m) orthonormal directions in which beta is the program's choice."""
    target: Array  # (T, 6) wanted displacement of the object about B [m, rad]


def followed(analysis: Analysis, task: TimedTask) -> Followed:
    """Return what the wanted motion fixes: all of beta, the part that the asked axes see, or nothing.

    Rigid tracking asks Gamma_ucs beta to be the wanted motion on the asked axes; compliant tracking leaves beta to
    the program, which keeps the object within the tolerance.

    Raises:
        MotionCountError: more independent motions are asked for than there are synergies.
        MotionDirectionError: the motion leaves Gamma_ucs by more than the tolerance.
        InputError: modes are given with another number of columns than Gamma_ucs has.
    """
    dimension = analysis.spaces.Gamma_ucs.shape[1]
    if task.target.kind in ("modes", "mode moves"):
        _beta_of_modes(analysis, task)
    wanted = target_displacement(analysis, task, task.target.values)
    if task.tracking == "compliant":
        return Followed(frozen(np.zeros((len(task.times), dimension))), frozen(np.eye(dimension)), wanted)
    if len(task.axes) == len(AXES):
        return Followed(rigid_coordinates(analysis, task), frozen(np.zeros((dimension, 0))), wanted)
    return _on_axes(analysis, task, wanted)


def target_displacement(analysis: Analysis, task: TimedTask, values: Array) -> Array:
    """Return the displacement (K, 6) that a wish asks for: where the object stays on the axes that are not asked for.

    Args:
        analysis: of the grasp.
        task: says what the wish means.
        values: (K, m) at any instants, with the columns of `Target.values`.
    """
    if task.target.kind == "motion":
        whole = np.asarray(values)
    else:
        whole = values @ analysis.spaces.Gamma_ucs[:, : values.shape[1]].T
    return frozen(whole if set(AXES).issubset(task.axes) else whole * [axis in task.axes for axis in AXES])


def off_target(analysis: Analysis, task: TimedTask, du: Array) -> Array:
    """Return how far the object is from where it is wanted, (K, 6): shift and rotation vector [m, rad].

    Args:
        analysis: of the grasp.
        task: what is wanted, on axes beside which nothing counts.
        du: (K, 6) displacement from the start at the first K knots: translation and rotation vector.
    """
    wanted = np.array(target_displacement(analysis, task, task.target.values)[: len(du)])
    turn = rotation_vectors(rotation_matrices(du[:, 3:]) @ rotation_matrices(wanted[:, 3:]).mT)
    whole = np.hstack([du[:, :3] - wanted[:, :3], turn])
    return frozen(np.where([axis in task.axes for axis in AXES], whole, 0.0))


def wish_size(analysis: Analysis, task: TimedTask) -> float:
    """Return how far a task wants the object away from where it starts, at most [m, rotations times length]."""
    wish = target_displacement(analysis, task, task.target.values)
    return float(np.linalg.norm(analysis.response.scale.twist(wish), axis=1).max(initial=0.0))


def undone(analysis: Analysis, task: TimedTask) -> float:
    """Return how much of a wanted motion is none of the hand's and left undone, at most [m, rotations times length]."""
    if task.target.kind != "motion" or task.tracking == "compliant" or len(task.axes) < len(AXES):
        return 0.0
    return float(out_of_reach(analysis, task.target.values).max(initial=0.0))


def out_of_reach(analysis: Analysis, motions: Array) -> Array:
    """Return (K,) how much of motions (K, 6) about B is no rigid motion of the hand [m, rotations times length]."""
    _, outside = motion_coordinates(analysis.response, analysis.spaces, motions)
    return frozen(np.linalg.norm(analysis.response.scale.twist(outside), axis=1))


def in_motions(analysis: Analysis, task: TimedTask) -> TimedTask:
    """Return the task with its wish as a motion of the object, which means the same whatever the synergies are.

    A wish in modes, the coordinates of Gamma_ucs, means something else to a hand with other synergies. What such a wish
    does between the knots is left out.
    """
    if task.target.kind not in ("modes", "mode moves"):
        return task
    values = target_displacement(analysis, task, task.target.values)
    return replace(task, target=Target("motion", values, task.target.key), course=None)


def followed_axes(analysis: Analysis, task: TimedTask) -> tuple[Array, Array]:
    """Return what the asked axes see of Gamma_ucs (asked, dim), and the directions (dim, m) that they do not see."""
    seen = axis_weights(task.axes, analysis.response.scale.length) @ analysis.spaces.Gamma_ucs
    return seen, split(seen, 1.0).null_space


def _on_axes(analysis: Analysis, task: TimedTask, target: Array) -> Followed:
    """Fix beta as far as the asked axes see it."""
    scale = analysis.response.scale
    weights = axis_weights(task.axes, scale.length)
    seen, unseen = followed_axes(analysis, task)
    beta = target @ weights.T @ np.linalg.pinv(seen, rcond=RANK_TOLERANCE).T
    outside = target @ weights.T - beta @ seen.T
    k = int(np.argmax(np.linalg.norm(outside, axis=1)))
    # outside is orthogonal to all that the asked axes see of Gamma_ucs; the same covector in scaled coordinates
    covector = np.linalg.solve(scale.motion.T, weights.T @ outside[k])
    reach = float(abs(scale.twist(target[k]) @ covector)) / max(float(np.linalg.norm(covector)), 1e-300)
    wish = float(np.linalg.norm(scale.twist(target), axis=1).max(initial=0.0))
    allowed = max(RIGID_TOLERANCE * wish, task.tolerance)
    if min(reach, float(np.linalg.norm(outside[k]))) > allowed:
        missed, whole = (
            describe_displacement(twist, scale.length) for twist in (_twist(weights, outside[k]), target[k])
        )
        message = (
            f"the rigid motions that these {analysis.grasp.n_z} synergies can produce (Gamma_ucs, dimension "
            f"{len(beta.T)}) cannot follow the wanted motion on the axes {', '.join(task.axes)}: at t = "
            f"{task.times[k]:.3g} s, of {whole} about B, they miss {missed} at best"
        )
        residual = np.linalg.solve(scale.motion, covector)
        raise MotionDirectionError(message, frozen(residual), float(task.times[k]), reach / wish, reach)
    return Followed(frozen(beta), frozen(unseen), target)


def _twist(weights: Array, values: Array) -> Array:
    """Return the twist (6,) with these values on the asked axes and 0 on the others."""
    return np.asarray(np.linalg.lstsq(weights, values, rcond=None)[0])


def rigid_coordinates(analysis: Analysis, task: TimedTask) -> Array:
    """Return beta (T, dim Gamma_ucs) [m] for the wanted motion.

    Raises:
        MotionCountError: more independent motions are asked for than there are synergies.
        MotionDirectionError: the motion leaves Gamma_ucs by more than the tolerance.
        InputError: modes are given with another number of columns than Gamma_ucs has.
    """
    dimension = analysis.spaces.Gamma_ucs.shape[1]
    values = task.target.values
    if task.target.kind == "hold":
        return frozen(np.zeros((len(task.times), dimension)))
    if task.target.kind in ("modes", "mode moves"):
        return _beta_of_modes(analysis, task)
    wish = float(np.linalg.norm(analysis.response.scale.twist(values), axis=1).max(initial=0.0))
    allowed = max(RIGID_TOLERANCE * wish, task.tolerance)
    beta, outside = motion_coordinates(analysis.response, analysis.spaces, values)
    sizes = np.linalg.norm(analysis.response.scale.twist(outside), axis=1)
    if sizes.max(initial=0.0) > allowed:
        _count(analysis, values, allowed)
        raise _direction(analysis, task, outside, sizes)
    return frozen(beta)


def _beta_of_modes(analysis: Analysis, task: TimedTask) -> Array:
    dimension, asked = analysis.spaces.Gamma_ucs.shape[1], task.target.values.shape[1]
    if asked > dimension or (task.target.kind == "modes" and asked < dimension):
        what = f"mode {asked} is asked for" if task.target.kind == "mode moves" else f"{asked} columns of beta given"
        raise InputError.at(task.target.key, f"{what}, but Gamma_ucs of this grasp has dimension {dimension}")
    return frozen(np.pad(task.target.values, ((0, 0), (0, dimension - asked))))


def _count(analysis: Analysis, values: Array, allowed: float) -> None:
    """Refuse a motion with more independent directions than the hand has synergies (Remark 3).

    What the tolerance can absorb, `allowed` [m] at every knot, is not counted.
    """
    scale, n_z = analysis.response.scale, analysis.grasp.n_z
    wish = scale.twist(values)
    asked = max((count for count in range(1, min(wish.shape) + 1) if apart_by(wish, count) > allowed), default=0)
    if asked > n_z:
        message = (
            f"the task asks for {asked} independent object motions, the hand has n_z = {n_z} "
            f"{'synergy' if n_z == 1 else 'synergies'} for motions, internal forces and redundancy together (34)"
        )
        directions = np.linalg.svd(wish[_spread(wish, asked)])[2][:asked]
        twists = np.linalg.solve(scale.motion, directions.T)
        raise MotionCountError(message, asked, n_z, frozen(twists))


def apart_by(wish: Array, count: int) -> float:
    """Return how far [m] a wish (T, 6) is at some knot from any space of `count` - 1 directions, at least.

    For any such space, the squares of the distances of k of the knots add up to the square of the k-th singular value
    of those knots or more, and so the largest distance is that value over the root of k or more.
    """
    knots = wish[_spread(wish, count)]
    return float(np.linalg.svd(knots, compute_uv=False)[count - 1]) / float(np.sqrt(count))


def _spread(wish: Array, count: int) -> list[int]:
    """Return `count` knots of a wish (T, 6), each the farthest from what those before it span."""
    left, chosen = np.array(wish), list[int]()
    for _ in range(count):
        sizes = np.linalg.norm(left, axis=1)
        chosen.append(int(np.argmax(sizes)))
        if sizes[chosen[-1]] > 0:
            direction = left[chosen[-1]] / sizes[chosen[-1]]
            left = left - np.outer(left @ direction, direction)
    return chosen


def _direction(analysis: Analysis, task: TimedTask, outside: Array, sizes: Array) -> MotionDirectionError:
    scale, values = analysis.response.scale, task.target.values
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
