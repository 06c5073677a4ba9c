"""What is asked of a grasp that can hardly be meant: gravity of another planet, motions larger than the object."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from synergrip.documents.quantities import in_g, in_mm
from synergrip.errors import Issue
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.plausible import EARTH, extents, mass_doubt
from synergrip.grasps.scale import scale_of
from synergrip.tasks.allowances import Allowances
from synergrip.tasks.gravity import Gravity
from synergrip.tasks.inertia_left_out import left_out_notes
from synergrip.tasks.off_surface import off_surface
from synergrip.tasks.palm_motion import Palm
from synergrip.tasks.palm_path import PalmPath
from synergrip.tasks.task import Task
from synergrip.tasks.timed_task import TimedTask

FAR = 0.05
"""Share of it by which gravity on the ground never differs."""
TURN = 2 * np.pi
OFF = 0.2
"""Share of the length of a grasp by which contacts are hardly off."""
ROOM = 10.0
"""[m] By more than this no arm moves a palm."""


def task_doubts(task: Task | TimedTask, timed: TimedTask, grasp: Grasp) -> Iterator[Issue]:
    """Yield what can hardly be meant, each with its argument.

    Args:
        task: what is asked; what is known of gravity stands there.
        timed: the same at its knots.
        grasp: of whom.
    """
    for place, load in enumerate(task.loads if isinstance(task, Task) else ()):
        if isinstance(load, Gravity):
            size = float(np.linalg.norm(load.acceleration))
            if abs(size - EARTH) > FAR * EARTH:
                message = (
                    f"gravity of {size:.4g} m/s^2 is far from {EARTH} m/s^2, that of the earth: what is asked for is "
                    "the acceleration in m/s^2, neither a weight nor a multiple of g"
                )
                yield Issue(message, key=f"Task.loads[{place}]")
        shift = _shift_of(load)
        if shift > ROOM:
            message = f"the palm moves by {shift:.4g} m, more than any arm does: lengths are in m, or with their unit"
            yield Issue(message, key=f"Task.loads[{place}]")
    if isinstance(task, Task) and task.allow is not None:
        yield from _beside_what_is_stated(task.allow, grasp)
        yield from _far_off(task.allow, timed, grasp)
    yield from off_surface(timed, grasp)
    yield from _large_motion(timed, grasp)
    yield from left_out_notes(task, timed, grasp)


def _large_motion(timed: TimedTask, grasp: Grasp) -> Iterator[Issue]:
    """Yield a motion that is larger than the object, or than the grasp where no shape is known."""
    values = timed.target.values
    if not values.size:
        return
    motion = timed.target.kind == "motion"
    shift = float(np.linalg.norm(values[:, :3] if motion else values, axis=1).max())
    shape = grasp.held.body.shape if grasp.held is not None else None
    size = float(extents(shape).max()) if shape is not None else 2 * scale_of(grasp).length
    whose = f"the {shape.title}" if shape is not None else "the grasp"
    if shift > size:
        message = f"a motion of {in_mm(shift, 4)} is larger than {whose} ({in_mm(size, 4)}): hands hardly reach so far"
        yield Issue(message, key="Task.target")
    turn = float(np.linalg.norm(values[:, 3:6], axis=1).max()) if motion else 0.0
    if turn > TURN:
        message = f"a turn by {np.degrees(turn):.4g} deg is more than a whole one: no grasp turns its object so far"
        yield Issue(message, key="Task.target")


def _shift_of(load: object) -> float:
    """Return how far a load moves the palm [m]."""
    if isinstance(load, Palm):
        return 0.0 if load.shift is None else float(np.linalg.norm(load.shift))
    if isinstance(load, PalmPath):
        return float(np.linalg.norm(np.ptp(np.asarray(load.poses)[:, :3], axis=0)))
    return 0.0


def _beside_what_is_stated(allow: Allowances, grasp: Grasp) -> Iterator[Issue]:
    """Yield intervals that the value stated lies outside of: it is held for all the same."""
    body = grasp.held.body if grasp.held is not None else None
    mass = body.mass if body is not None else 0.0
    unlikely = [] if body is None else [said for each in allow.mass or () if (said := mass_doubt(body, each))]
    if unlikely:
        yield Issue(unlikely[0], key="Task.allow.mass")
    elif allow.mass is not None and mass and not allow.mass[0] <= mass <= allow.mass[1]:
        low, high = (f"{in_g(each)}" for each in allow.mass)
        message = f"the object's own mass, {in_g(mass)}, is not between {low} and {high}: it is held for, too"
        yield Issue(message, key="Task.allow.mass")
    for contact in grasp.contacts:
        friction = float(getattr(contact.kind, "friction", np.nan))
        own = allow.friction.get(contact.name) if isinstance(allow.friction, Mapping) else allow.friction
        if own is not None and not own[0] <= friction <= own[1]:
            where = f"that of contact '{contact.name}', {friction:.4g}, is not between {own[0]:.4g} and {own[1]:.4g}"
            yield Issue(f"{where}: it is held for, too", key="Task.allow.friction")
            return


def _far_off(allow: Allowances, timed: TimedTask, grasp: Grasp) -> Iterator[Issue]:
    """Yield contacts that are allowed to be off by about as much as the grasp is large."""
    gap = 0.0 if timed.allowed is None else float(timed.allowed.gaps.max())
    position = 0.0 if allow.scenarios is None else allow.scenarios.position
    length = scale_of(grasp).length
    for key, most in (("contact_gap", gap), ("scenarios.position", position)):
        if most > OFF * length:
            message = (
                f"contacts that are off by {in_mm(most, 4)} are off by much of the grasp, in which they are "
                f"{in_mm(length, 4)} from their middle: in code lengths are in m"
            )
            yield Issue(message, key=f"Task.allow.{key}")
