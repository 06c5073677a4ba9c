"""What a problem is about, in a few words: what was read, and what is asked."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

import numpy as np

from synergrip.documents.quantities import in_g, in_mm, plain
from synergrip.grasps.grasp import Grasp
from synergrip.tasks.gravity import Weight
from synergrip.tasks.inertia import Inertia
from synergrip.tasks.profiles import Profiles
from synergrip.tasks.timed_task import TimedTask


def read_in_short(grasp: Grasp) -> Iterator[str]:
    """Yield hand, sizes, object and contacts."""
    held = grasp.held
    yield held.hand.title if held else "grasp given as matrices"
    yield f"{many(grasp.n_q, 'joint')}, {many(grasp.n_z, 'synergy')}"
    if held is not None:
        mass = f", {in_g(held.body.mass)}" if held.body.mass else ""
        yield (held.body.shape.title if held.body.shape else held.body.title) + mass
    kinds = Counter(contact.kind.title for contact in grasp.contacts)
    yield " and ".join(many(n, f"{kind} contact") for kind, n in kinds.items())


def asked_in_short(task: TimedTask) -> Iterator[str]:
    """Yield what is wanted, what the palm does, knots, load, margin and goals."""
    knots = len(task.times)
    span = f" in {plain(task.times[-1], 3)} s" if knots > 1 else ""
    yield _wanted(task) + span
    yield from _palm(task)
    yield many(knots, "knot")
    yield f"load up to {plain(_load(task), 3)} N"
    yield f"slip margin ≥ {plain(task.margin)} N"
    yield ", then ".join(goal.name for goal in task.goals)


def _load(task: TimedTask) -> float:
    """Return the largest force on the object at the knots and at the corners between them [N]."""
    wrench = task.wrench
    if task.course is not None:
        corners = task.course.marks.corners
        inside = corners[(corners > task.times[0]) & (corners < task.times[-1])]
        load = task.course.load_at(inside)
        wrench = wrench if load is None else np.vstack([wrench, load])
    return float(np.linalg.norm(wrench[:, :3], axis=1).max(initial=0.0))


def _palm(task: TimedTask) -> Iterator[str]:
    """Yield what the palm does where it moves, and whether the object loads the grasp by its inertia then."""
    parts = task.course.load if isinstance(task.course, Profiles) else ()
    palms = [part.palm for part in parts if isinstance(part, Weight | Inertia) and part.palm is not None]
    if palms:
        yield f"the palm {palms[0].in_words}{', with inertia' * any(isinstance(part, Inertia) for part in parts)}"


def _wanted(task: TimedTask) -> str:
    """Return what is wanted of the object, with its size: numbers in the wrong unit are seen there first."""
    values = task.target.values
    if task.target.kind == "hold":
        return "hold the object"
    if task.target.kind != "motion":
        return f"move along Γ_ucs by up to {in_mm(np.linalg.norm(values, axis=1).max())}"
    shift, turn = (np.linalg.norm(part, axis=1).max() for part in (values[:, :3], values[:, 3:]))
    sizes = [in_mm(shift)] * bool(shift) + [f"{plain(np.degrees(turn), 3)} deg"] * bool(turn)
    return "move the object" + f" by up to {' and '.join(sizes)}" * bool(sizes)


def many(count: int, noun: str) -> str:
    """Return ``1 knot``, ``2 knots``, ``3 synergies``."""
    plural = f"{noun[:-1]}ies" if noun.endswith("y") else f"{noun}s"
    return f"{count} {noun if count == 1 else plural}"
