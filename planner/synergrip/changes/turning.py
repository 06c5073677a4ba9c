"""The numbers of a task that could be others: of its limits, its load, its motion, its time, and of the friction."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from synergrip.changes.allowance_dials import FRICTION_END, allowance_dials
from synergrip.changes.asked import Asked
from synergrip.conic.limits.dial import Dial, quantity
from synergrip.conic.limits.limit import Limit
from synergrip.errors import InputError
from synergrip.linalg import frozen
from synergrip.statics.analysis import Analysis
from synergrip.tasks.gravity import Gravity
from synergrip.tasks.palm_motion import Palm
from synergrip.tasks.palm_path import PalmPath
from synergrip.tasks.stated import Stated
from synergrip.tasks.task import Task
from synergrip.tasks.timed_task import TimedTask
from synergrip.tasks.tracking import wish_size

LONGEST = 100.0
"""How many times as long a task is asked to take at most."""
LEAST_MASS = 1e-9
"""[kg] Of an object; a mass is never 0."""


def dials(asked: Asked, timed: TimedTask, analysis: Analysis) -> tuple[Dial[Asked], ...]:
    """Return every number that could be another one, limits first.

    Args:
        asked: what is asked.
        timed: the same at its knots.
        analysis: of the grasp.
    """
    own = (*limit_dials(asked), *_of_task(asked, timed, analysis), *_of_load(asked, timed), *_of_friction(asked))
    return (*own, *allowance_dials(asked))


def limit_dials(asked: Asked) -> Iterator[Dial[Asked]]:
    """Yield every number of the limits."""
    limits = asked.limits
    for index, limit in enumerate(limits):
        for dial in limit.dials(asked.grasp):
            yield _lifted(asked, limits, index, dial)


def _lifted(asked: Asked, limits: tuple[Limit, ...], index: int, dial: Dial[Limit]) -> Dial[Asked]:
    """Return a dial of a limit as one of what is asked."""

    def turned(value: float) -> Asked:
        return asked.with_limits((*limits[:index], dial.turned(value), *limits[index + 1 :]))

    return Dial(**{**{name: getattr(dial, name) for name in dial.__dataclass_fields__}, "turned": turned})


def _of_task(asked: Asked, timed: TimedTask, analysis: Analysis) -> Iterator[Dial[Asked]]:
    moves = bool(np.any(timed.target.values))
    if timed.tracking == "compliant":
        yield tolerance_dial(asked, timed, analysis)
    if timed.drift is not None:
        yield Dial("drift", "task.drift", timed.drift, "m", lambda v: asked.with_task(drift=v))
    if moves:
        yield amplitude_dial(asked, timed)
    if (duration := duration_dial(asked, timed)) is not None:
        yield duration


def tolerance_dial(asked: Asked, timed: TimedTask, analysis: Analysis) -> Dial[Asked]:
    """Return how far the object may be from where it is wanted."""
    return Dial(
        "tolerance", "task.tolerance", timed.tolerance, "m", lambda v: asked.with_task(tolerance=v),
        scale=wish_size(analysis, timed) or analysis.response.scale.length,
        written=lambda value: quantity(1e3 * value, "mm"),
    )  # fmt: skip


def duration_dial(asked: Asked, timed: TimedTask) -> Dial[Asked] | None:
    """Return how long a task takes; None where it does not matter, or where a load has times of its own.

    It is turned by `task.duration` where nothing else tells times, else by one factor on the times of all motions.
    """
    task = asked.task
    if not (isinstance(task, Task) and _feels_time(task, timed) and len(timed.times) > 1):
        return None
    seconds, factor = float(timed.times[-1] - timed.times[0]), task.time_factor
    if _stretches(task):
        key, per = "task.duration", factor
    elif all(_goes_along(part) for part in task.parts.values()):
        key, per = "task.time_factor", seconds / factor
    else:
        return None
    unit = "s" if key == "task.duration" else ""

    def turned(value: float) -> Asked:
        return asked.with_task(**{key.removeprefix("task."): value / per})

    return Dial(
        "duration", key, seconds, "s", turned, end=LONGEST * seconds, smooth=False, nested=not _has_inertia(task),
        written=lambda value: quantity(value / per, unit),
    )  # fmt: skip


def _goes_along(part: Stated) -> bool:
    """Return whether a load or target goes with the time of the task."""
    try:
        part.stretched(1.0)
    except InputError:
        return False
    return True


def amplitude_dial(asked: Asked, timed: TimedTask) -> Dial[Asked]:
    """Return a factor of the wanted motion."""
    task = asked.task
    if isinstance(task, Task):
        return Dial(
            "amplitude", "task.motion_factor", task.motion_factor, "", lambda v: asked.with_task(motion_factor=v),
            "down", 0.0,
        )  # fmt: skip

    def scaled(value: float) -> Asked:
        return asked.with_task(target=replace(timed.target, values=frozen(value * timed.target.values)), course=None)

    return Dial("amplitude", "task.motion_factor", 1.0, "", scaled, "down", 0.0)


def _stretches(task: Task) -> bool:
    """Return whether nothing in a task is bound to times of its own: it may take longer as it is."""
    bound = [
        part for part in (*task.loads, task.target) if part.lines is not None or part.timed or part.last is not None
    ]
    return all(isinstance(part, Palm) for part in bound)


def _feels_time(task: Task, timed: TimedTask) -> bool:
    """Return whether it matters how long a task takes: for changes from knot to knot, or for inertia."""
    changes = any(limit.couples_knots and not limit.adds_up for limit in timed.limits)
    return _has_inertia(task) or changes


def _has_inertia(task: Task) -> bool:
    """Return whether the palm's motion loads the object: then a task that takes longer may have no plan either."""
    return any(isinstance(load, Palm | PalmPath) and load.inertia for load in task.loads)


def _of_load(asked: Asked, timed: TimedTask) -> Iterator[Dial[Asked]]:
    if not np.any(timed.wrench):
        return
    task = asked.task
    mass, factor = mass_dial(asked), load_dial(asked, timed)
    whole = isinstance(task, Task) and all(isinstance(load, Gravity | Palm | PalmPath) for load in task.loads)
    if mass is not None and whole:
        yield mass
    elif factor is not None:
        yield factor


def mass_dial(asked: Asked) -> Dial[Asked] | None:
    """Return the mass of the object, gravity and inertia with it; None where nothing in the task weighs it."""
    task, held = asked.task, asked.grasp.held
    weighs = isinstance(task, Task) and any(isinstance(load, Gravity | Palm | PalmPath) for load in task.loads)
    if held is None or not held.body.mass or not weighs:
        return None
    return Dial(
        "load", "object.mass", held.body.mass, "kg", lambda v: replace(asked, grasp=asked.grasp.replace(mass=v)),
        "down", LEAST_MASS,
    )  # fmt: skip


def load_dial(asked: Asked, timed: TimedTask) -> Dial[Asked] | None:
    """Return a factor of the whole load; None where there is none."""
    task = asked.task
    if isinstance(task, TimedTask):
        return Dial(
            "load", "task.load_factor", 1.0, "",
            lambda v: asked.with_task(wrench=frozen(v * timed.wrench), course=None), "down", 0.0,
        )  # fmt: skip
    if not task.load_factor > 0:
        return None
    return Dial("load", "task.load_factor", task.load_factor, "", lambda v: asked.with_task(load_factor=v), "down", 0.0)


def _of_friction(asked: Asked) -> Iterator[Dial[Asked]]:
    if (dial := friction_dial(asked)) is not None:
        yield dial


def friction_dial(asked: Asked) -> Dial[Asked] | None:
    """Return the friction of all contacts, by one factor; spin friction goes along; None without friction."""
    least = min((contact.friction for contact in asked.grasp.contacts if contact.friction > 0), default=0.0)
    return _friction(asked, asked.grasp.contact_names, least) if least > 0 else None


def knots_dial(asked: Asked) -> Dial[Asked] | None:
    """Return how many knots a task has, which more may help that are between those there are; None without a number."""
    if not isinstance(asked.task, Task) or asked.task.knots is None or asked.task.knots < 2:
        return None
    return Dial(
        "reach", "task.knots", float(asked.task.knots), "", lambda value: asked.with_task(knots=round(value)),
        smooth=False, nested=False,
    )  # fmt: skip


def contact_dials(asked: Asked) -> dict[str, Dial[Asked]]:
    """Return by its name the friction of each contact that has any, by itself."""
    contacts = [contact for contact in asked.grasp.contacts if contact.friction > 0]
    return {contact.name: _friction(asked, (contact.name,), contact.friction) for contact in contacts}


def _friction(asked: Asked, names: tuple[str, ...], least: float) -> Dial[Asked]:
    """Return the friction of some contacts, the least of which is given, by one factor."""
    grasp = asked.grasp
    already = {contact.name: grasp.factors.friction.get(contact.name, 1.0) for contact in grasp.contacts}

    def written(value: float) -> str:
        """Return the factors of all contacts as TOML: those that the file has, and those that are changed."""
        factors = {name: factor * (value / least if name in names else 1.0) for name, factor in already.items()}
        if len(names) == len(factors) and len({*factors.values()}) == 1:
            return quantity(next(iter(factors.values())), "")
        told = (f"{json.dumps(name, ensure_ascii=False)} = {quantity(f, '')}" for name, f in factors.items() if f != 1)
        return f"{{ {', '.join(told)} }}"

    def turned(value: float) -> Asked:
        chosen = [contact for contact in grasp.contacts if contact.name in names]
        kinds = {contact.name: contact.kind.slippery(value / least) for contact in chosen}
        return replace(asked, grasp=grasp.replace(contact=kinds))

    return Dial(
        "friction", f"{_table(asked)}.friction_factor", least, "", turned, end=FRICTION_END * least, smooth=False,
        written=written,
    )  # fmt: skip


def stiffness_dial(asked: Asked) -> Dial[Asked]:
    """Return the stiffness of all contacts, by one factor: sets of plans are not nested in it."""
    grasp = asked.grasp
    return Dial(
        "stiffness", f"{_table(asked)}.stiffness_factor", (already := grasp.factors.stiffness), "",
        lambda value: replace(asked, grasp=grasp.replace(C_s=grasp.C_s * (already / value))), smooth=False,
        nested=False,
    )  # fmt: skip


def _table(asked: Asked) -> str:
    """Return the table of a problem file that multiplies friction and stiffness."""
    return "contacts" if asked.grasp.held is not None else "grasp"
