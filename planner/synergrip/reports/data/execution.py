"""What another program needs to execute a plan of a hand without knowing synergrip: the `execution` of plan.json.

Of a no it tells what was asked about.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from hashlib import sha256
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from synergrip.files import bundled
from synergrip.grasps.contacts.contact import Contact
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.held import Held
from synergrip.grasps.objects import Object, Turned
from synergrip.grasps.shapes.shape import Shape
from synergrip.grasps.shapes.sphere import Sphere
from synergrip.hands.hand import Coupling, Hand
from synergrip.linalg import Array
from synergrip.planning.outcome import Outcome
from synergrip.planning.told import finite
from synergrip.statics.motion import forces_at_start
from synergrip.tasks.gravity import Weight
from synergrip.tasks.marks import SAME_TIME, together
from synergrip.tasks.palm_in_world import PalmInWorld
from synergrip.tasks.palm_motion import PalmMotion
from synergrip.tasks.palm_path import PalmSpline
from synergrip.tasks.pushes import Pushing, pushes_in
from synergrip.tasks.timed_task import Course, TimedTask

KEY = "execution"
SAMPLES, MOST = 4, 256
"""Into how many straight lines the load is divided where it is curved, from each knot or corner to the next: at least,
and at most, so that none is off by more than `NEAR`."""
NEAR, ROUNDED = 1e-3, 1e-9
"""How far off a line may be halfway, of the largest force and moment of the load in the piece; and below which share of
the larger number one is rounding."""


def execution_document(answer: Outcome) -> dict[str, Any] | None:
    """Return hand, object, contacts and load of an answer, SI units, palm frame at the start; None for matrices.

    Forces at the start are null where the object is not held.
    """
    held, grasp, analysis = answer.grasp.held, answer.grasp, answer.analysis
    if held is None:
        return None
    forces = None if analysis is None else forces_at_start(analysis.response)
    gravity, palm = surroundings(answer.task, held.body.mass)
    return {
        **_hand(held.hand), "q_0": held.q, "S": grasp.S, "C_q": grasp.C_q, "C_z": grasp.C_z,
        "lambda_0": forces, "tau_0": None if forces is None else forces @ grasp.J, "gravity_m_s2": gravity,
        "palm": None if palm is None else _poses(palm, answer.task.times),
        "object": _object(held.body), "contacts": _contacts(grasp, held), "load": _load(answer.task, held.body),
        "interpolation": "linear",
    }  # fmt: skip


def _hand(hand: Hand) -> dict[str, Any]:
    limits = [finite(joint.torque_limit) for joint in hand.joints]
    return {
        **_file(hand.file), "root_link": hand.links[0], "joints": list(hand.joint_names),
        "joint_range": [[finite(joint.lower), finite(joint.upper)] for joint in hand.joints], "joint_torque": limits,
        "followers": [each for name, coupling in hand.couplings.items() for each in _follower(name, coupling)],
    }  # fmt: skip


def _file(name: str) -> dict[str, Any]:
    """Return the model file, a bundled one by its place in the repository, and what was in it."""
    path = Path(name)
    if not name or not path.is_file():
        return {"hand_file": name or None, "sha256": None}
    inside = bundled("models").resolve()
    shown = f"models/{path.relative_to(inside).as_posix()}" if path.is_relative_to(inside) else path.as_posix()
    return {"hand_file": shown, "sha256": sha256(path.read_bytes()).hexdigest()}


def _follower(name: str, coupling: Coupling) -> list[dict[str, Any]]:
    """Return an entry for each driver; what they move adds up, and the first one has the offset."""
    return [
        {"joint": name, "driver": driver, "ratio": ratio, "offset_rad": 0.0 if i else coupling.offset,
         "rigid": coupling.rigid}
        for i, (driver, ratio) in enumerate(coupling.ratios.items())
    ]  # fmt: skip


def _object(body: Object) -> dict[str, Any]:
    tensor = body.mass * body.shape.inertia if body.shape is not None and body.mass else None
    return {
        "position_m": body.position, "mass_kg": body.mass, "inertia_kg_m2": tensor, "shape": _shape(body.shape)
    }  # fmt: skip


def _shape(shape: Shape | None, rotation: Array | None = None) -> dict[str, Any] | None:
    """Return a shape by its name, with its sizes; the rotation has its own axes as columns."""
    if shape is None:
        return None
    turned = np.eye(3) if rotation is None else rotation
    if isinstance(shape, Turned):
        return _shape(shape.shape, turned @ shape.rotation)
    sizes: dict[str, Any] = {f"{size.name}_m": getattr(shape, size.name) for size in shape.sizes}
    return {shape.name: sizes if isinstance(shape, Sphere) else sizes | {"rotation": turned}}


def _contacts(grasp: Grasp, held: Held) -> list[dict[str, Any]]:
    each = zip(grasp.contacts, grasp.rows, held.touches, strict=True)
    return [
        {
            "name": contact.name, "link": touch.pad.link, "point_m": contact.point + held.body.position,
            "frame": contact.frame.T, "kind": contact.kind.name, "parameters": _parameters(contact),
            "compliance": grasp.C_s[rows, rows], "pad_radius_m": touch.pad.radius, "pad_centre_m": touch.pad.point,
        }
        for contact, rows, touch in each
    ]  # fmt: skip


def _parameters(contact: Contact) -> Mapping[str, float]:
    """Return the parameters of a contact's cone."""
    return {parameter.key: getattr(contact.kind, parameter.name) for parameter in contact.kind.parameters}


def _load(task: TimedTask, body: Object) -> dict[str, Any]:
    """Return the external wrench at every knot and corner, and more often where it is curved; straight in between.

    Where it jumps, an instant stands more than once: just before, at it and just after, as far as these differ.
    """
    lines = _lines(task)
    return {
        "times_s": [time for time, _, _ in lines], "wrench": np.array([wrench for _, _, wrench in lines]),
        "axes": "palm", "point": body.position,
        "forces": [{"at_m": push.point, "force": factor * _pushed(push, lines)}
                   for push, factor in pushes_in(task.course)],
        "curved_s": [[float(start), float(end)] for start, end in sorted(set(_curved(task)))],
    }  # fmt: skip


def _curved(task: TimedTask) -> tuple[tuple[float, float], ...]:
    """Return the spans [s] in which the load is curved, whatever the wanted motion is."""
    if task.course is None:
        return ()
    parts = getattr(task.course, "load", None)
    return (task.course.marks if parts is None else together(part.marks for part in parts)).curved


Line = tuple[float, int, Array]
"""Time [s]; -1 just before it, 0 at it, 1 just after; wrench (6,)."""


def _lines(task: TimedTask) -> list[Line]:
    """Return the wrench at all instants that count, in order."""
    knots = task.times.tolist()
    lines: list[Line] = [(time, 0, wrench) for time, wrench in zip(knots, task.wrench, strict=True)]
    if task.course is None:
        return lines
    marks = task.course.marks
    instants = np.concatenate([marks.corners, [jump.time for jump in marks.jumps], *_within(task, marks.corners)])
    inside = np.unique(instants[(instants >= knots[0]) & (instants <= knots[-1])])
    found = task.course.load_at(inside)
    there = np.tile(task.wrench[0], (len(inside), 1)) if found is None else found
    lines += [(float(t), 0, w) for t, w in zip(inside, there, strict=True) if float(t) not in set(knots)]
    at = {time: wrench for time, _, wrench in lines}
    slack = SAME_TIME * max(knots[-1], 1.0)
    beside = {(float(jump.time), jump.side) for jump in marks.jumps if float(jump.time) in at}
    for time, side in sorted(beside):
        if (time <= knots[0] + slack) if side < 0 else (time >= knots[-1] - slack):
            continue  # before and after the task: no plan was made for what the load is then
        changes = [jump.change for jump in marks.jumps if (float(jump.time), jump.side) == (time, side)]
        lines.append((time, side, at[time] + sum(changes)))
    return sorted(lines, key=lambda line: line[:2])


def _within(task: TimedTask, corners: Array) -> Iterator[Array]:
    """Yield instants within the curved spans: equal parts of each piece from a knot or corner to the next."""
    for start, end in _curved(task):
        ends = np.unique(np.concatenate([task.times, corners, [start, end]]))
        ends = ends[(ends >= start) & (ends <= end)]
        yield from (_straight(task.course, a, b) for a, b in pairwise(ends))


def _straight(course: Course | None, start: float, end: float) -> Array:
    """Return the ends of equal parts of a piece of time in which the load is nearly straight."""
    parts = SAMPLES
    while parts < MOST:
        found = None if course is None else course.load_at(np.linspace(start, end, 2 * parts + 1))
        if found is None:
            break
        off = np.abs(found[1::2] - (found[:-1:2] + found[2::2]) / 2).reshape(-1, 2, 3)
        size = np.abs(found).reshape(-1, 2, 3).max(axis=(0, 2))
        if np.all(off.max(axis=(0, 2)) <= NEAR * np.maximum(size, ROUNDED * size.max())):
            break
        parts *= 2
    return np.linspace(start, end, parts + 1)


def _pushed(push: Pushing, lines: list[Line]) -> Array:
    """Return the force (K, 3) of a push at lines of the load: also just before and after it jumps."""
    shares = push.share(np.array([time for time, _, _ in lines]))
    gone = {(float(jump.time), jump.side) for jump in push.marks.jumps}
    off = np.array([(time, side) in gone for time, side, _ in lines])
    return np.outer(np.where(off, 0.0, shares), push.wrench[:3])


def surroundings(task: TimedTask, mass: float) -> tuple[Array | None, PalmInWorld | None]:
    """Return gravity [m/s^2] in the palm frame at the start, and how the palm moves; None for what is not stated."""
    gravity, palm = None, None
    for part in getattr(task.course, "load", ()):
        if isinstance(part, Weight) and mass:
            gravity = part.force / mass
        palm = getattr(part, "palm", None) or palm
    return gravity, palm


def _poses(palm: PalmInWorld, times: Array) -> list[dict[str, Any]]:
    """Return position and rotation of the palm at the knots, in its frame at the start."""
    seen = np.stack([palm.seen(axis, times) for axis in np.eye(3)], axis=1)  # R' e_i in rows, so that the rows are R
    places = np.zeros((len(times), 3))
    if isinstance(palm, PalmMotion):
        places = np.outer(palm.profile.at(times), palm.shift)
    elif isinstance(palm, PalmSpline):
        places = (palm.poses(times)[:, :3] - palm.poses(palm.corners[:1])[0, :3]) @ palm.upright
    return [{"position_m": place, "rotation": turned} for place, turned in zip(places, seen, strict=True)]
