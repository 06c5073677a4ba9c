"""What a load by inertia leaves out where the object moves in the fingers of a palm that moves.

The load is that of the object fixed to the palm where it starts. An object that is wanted d(t) from there, turned by
theta(t), has besides, in the axes of the palm with omega and alpha of the palm,

    force   -m (alpha x d + omega x (omega x d) + 2 omega x d' + d'')
    moment  what -(I_R alpha_o + omega_o x I_R omega_o) is more than without theta,
            I_R = R I R', omega_o = omega + theta', alpha_o = alpha + omega x theta' + theta''

for turns theta about one axis or so small that theta' is their angular velocity.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from synergrip.documents.quantities import plain
from synergrip.errors import Issue
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array
from synergrip.tasks.inertia import inertial_moment
from synergrip.tasks.marks import distinct
from synergrip.tasks.palm_in_world import PalmInWorld, acceleration_of
from synergrip.tasks.palm_motion import Palm
from synergrip.tasks.palm_path import PalmPath
from synergrip.tasks.task import Task
from synergrip.tasks.timed_task import Course, TimedTask
from synergrip.tasks.timing import stretched
from synergrip.vectors import rotation_matrices

LOOKS = 65
"""Instants from one corner of the motion to the next at which it is looked at."""
LITTLE = 1e-3
"""Share of the largest force of the load that is worth no note."""
NOTHING = 1e-9
"""Share of the largest of some values that is rounding."""


def left_out_notes(task: Task | TimedTask, timed: TimedTask, grasp: Grasp) -> Iterator[Issue]:
    """Yield a note where inertia is asked for and the object is to move in the fingers, with what is left out.

    Args:
        task: what is asked; of a timed one nothing is known of its loads.
        timed: the same at its knots.
        grasp: of whom.
    """
    loads = stretched(task).loads if isinstance(task, Task) else ()
    moving = [load for load in loads if isinstance(load, Palm | PalmPath) and load.inertia]
    if not moving or timed.course is None or not np.any(timed.target.values):
        return
    said = "the load by inertia is that of the object fixed to the palm where it starts; as it moves in the fingers"
    if timed.target.kind != "motion":
        yield Issue(f"{said}, its own path adds to that, which is not counted", key="Task.target")
        return
    palm = moving[0].motion(float(timed.times[0]), float(timed.times[-1]))
    times, more = left_out(palm, grasp, timed.course, timed.times[[0, -1]])
    size = np.linalg.norm(more[:, :3], axis=1)
    if np.abs(more).max() <= LITTLE * np.abs(timed.wrench).max():
        return
    k = int(size.argmax())
    moment = float(np.linalg.norm(more[:, 3:], axis=1).max())
    box = ", ".join(plain(each, 2) for each in _rounded_up(np.abs(more).max(axis=0)))
    yield Issue(
        f"{said}, its own path adds up to {plain(float(size[k]), 3)} N (t = {times[k]:.3g} s) and "
        f"{plain(1e3 * moment, 3)} N mm, which is not counted: allow.load_box = [{box}] holds for it",
        key="Task.target",
    )


def left_out(palm: PalmInWorld, grasp: Grasp, course: Course, span: Array) -> tuple[Array, Array]:
    """Return times (T,) [s] in a span (2,), and the wrench (T, 6) about the object that is left out [N, N m].

    Jolts at corners of the wanted motion, where its velocity jumps, have no part in it.
    """
    body = grasp.held.body if grasp.held is not None else None
    if body is None:
        return span, np.zeros((2, 6))
    corners = distinct(np.clip(np.concatenate([course.marks.corners, span]), *span))
    pieces = [np.linspace(begin, end, LOOKS) for begin, end in pairwise(corners)]
    tensor = np.zeros((3, 3)) if body.shape is None else body.mass * np.asarray(body.shape.inertia)
    found = [_left_out(palm, body.mass, tensor, course, times) for times in pieces]
    return np.concatenate(pieces), np.concatenate(found)


def _left_out(palm: PalmInWorld, mass: float, tensor: Array, course: Course, times: Array) -> Array:
    """Return the wrench (T, 6) at evenly spaced times (T,), between which the wanted motion is smooth."""
    moved = course.target_at(times)
    rates = np.gradient(moved, times, axis=0, edge_order=2)
    changes = np.gradient(rates, times, axis=0, edge_order=2)
    omega, alpha = palm.rotation_rates(times)
    d, v, a = moved[:, :3], rates[:, :3], changes[:, :3]
    force = -mass * acceleration_of(d, a + 2 * np.cross(omega, v), omega, alpha)
    R = rotation_matrices(moved[:, 3:])
    turned = R @ tensor @ R.transpose(0, 2, 1)
    whole = inertial_moment(turned, omega + rates[:, 3:], alpha + np.cross(omega, rates[:, 3:]) + changes[:, 3:])
    return np.hstack([force, whole - inertial_moment(tensor, omega, alpha)])


def _rounded_up(values: Array) -> list[float]:
    """Return values >= 0 with two digits, none of them less than it was; what is far below the largest counts as 0."""
    kept = np.where(values > NOTHING * values.max(), values, 0.0)
    last = 10.0 ** (np.floor(np.log10(np.where(kept > 0, kept, 1.0))) - 1)
    return [float(each) for each in np.ceil(kept / last * (1 - NOTHING)) * last]
