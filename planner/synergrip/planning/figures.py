"""What executed references come to: what they use of every limit at the true states, at the knots and between them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from synergrip.conic.along import AtStates
from synergrip.conic.formulation import Formulation
from synergrip.conic.intersample import Intersample, Looks
from synergrip.conic.limits.limit import Usage
from synergrip.equilibrium.execution import Execution
from synergrip.linalg import Array, frozen, interpolated
from synergrip.planning.between import Between
from synergrip.planning.executing import analyses_of, motion_of, sag_of
from synergrip.planning.instants import intersample_of, looked_at
from synergrip.planning.outcome import BETWEEN, Check
from synergrip.planning.told import nearest
from synergrip.planning.verified import LIMIT, limit_usages
from synergrip.planning.walk import Walker
from synergrip.planning.walk_so_far import Walk
from synergrip.statics.motion import Motion
from synergrip.tasks.tracking_along import Steps, steps
from synergrip.values import Value

FORCE, OF_FORCES = 1e-3, 1e-3
"""A limit on forces is kept to this many newtons, or to this share of the largest force where that is more."""
LENGTH, ANGLE = 1e-5, 1e-4
"""[m], [rad] to which limits on motions are kept."""
LOOKS, PARTS = 32, (2, 16)
"""How many instants between the knots are looked at, at least, and into how many parts a piece is divided for that: a
middle where there are many pieces; where these are few, or a load is curved, the middle alone says too little."""
BALANCED = 1e-8
"""Relative error of the equilibrium."""


@dataclass(frozen=True, eq=False, repr=False)
class Figures(Value):
    """What executed references are and use, at the knots of a task and between them."""

    motion: Motion
    usages: tuple[Usage, ...]
    elastic_motion: Array  # (T, 6)
    between: Between | None
    checks: tuple[Check, ...]
    missed: tuple[str, ...]
    """What is beyond its limit, by how much, where and when, in words."""


def figures(walk: Walk, walker: Walker, formulation: Formulation, linear: Between | None) -> Figures:
    """Return the figures of a walk all of whose knots were reached.

    Args:
        walk: references and their execution.
        walker: whose task it is.
        formulation: of the task at its knots, for names and units.
        linear: what load and wish do between the knots; None when no more is known.
    """
    task, executed, way = walker.task, walk.executed, walk.way
    motion, there = _moved(executed, Looks(task.times, task.wrench, walker.wanted), walker, formulation, way)
    usages, rooms = limit_usages(task, there, motion), _rooms(executed, walker)
    elastic = frozen(motion.du - motion.sag - there.rigid_motion(motion.dz_r))
    checks = (Check("equilibrium", executed.residual, BALANCED), stable(executed), *kept(usages, rooms))
    between, inside, there_missed = _between(walk, walker, formulation, linear, rooms)
    missed = (*_missed(usages, rooms), *there_missed)
    return Figures(replace(motion, du=executed.du), usages, elastic, between, (*checks, *inside), missed)


def _between(
    walk: Walk, walker: Walker, formulation: Formulation, linear: Between | None, rooms: Mapping[str, float]
) -> tuple[Between | None, tuple[Check, ...], tuple[str, ...]]:
    """Return what the references really do between the knots, the checks of that, and what they miss there."""
    task = walker.task
    if len(task.times) < 2:
        return None, (), ()
    looks = _looks(walker, rooms["N"])
    references = frozen(interpolated(looks.times, task.times, walk.references))
    executed = walker.executor.run(looks.times, references, looks.wrench, walk.executed.interpolated(looks.times))
    if not executed.whole:
        why = f"{BETWEEN}: {executed.why}"
        return None, (Check(why, np.inf, 0.0),), (why,)
    motion, there = _moved(executed, looks, walker, formulation)
    usages = tuple(limit.usage(there, motion) for limit in task.all_limits if not limit.couples_knots)
    found = replace(
        linear or Between(1, 0.0, 0.0, 0.0, usages), samples=1, usages=usages,
        rooms=tuple(_room(usage, rooms) for usage in usages),
    )  # fmt: skip
    where = f"{BETWEEN}: "
    if task.between == "report":
        return found, (stable(executed, where),), ()
    return found, (stable(executed, where), *kept(usages, rooms, where)), tuple(_missed(usages, rooms, where))


def stable(executed: Execution, where: str = "") -> Check:
    """Return the check that the hand stays at its equilibria: in [N/m], how far the least stiffness is below 0.

    At 0 the equilibrium is lost, too: the error is then the smallest number above it.
    """
    least = float(executed.stiffness.min())
    return Check(f"{where}stability", 0.0 if least > 0 else max(-least, float(np.nextafter(0.0, 1.0))), 0.0)


def kept(usages: Sequence[Usage], rooms: Mapping[str, float], where: str = "") -> tuple[Check, ...]:
    """Return a check for every limit, in its own unit, to the digits that a true state is promised to.

    Args:
        usages: of the limits.
        rooms: by unit, how far beyond a limit counts as kept.
        where: said before the title.
    """
    return tuple(
        Check(f"{where}{usage.title}", max(float(usage.excess.max(initial=0.0)), 0.0), _room(usage, rooms))
        for usage in usages
    )


def _missed(usages: Sequence[Usage], rooms: Mapping[str, float], where: str = "") -> Iterator[str]:
    """Yield what is beyond its limit: the worst of each, where, when, and the limit."""
    for usage in usages:
        if usage.excess.max(initial=0.0) > _room(usage, rooms):
            (k, i), (shown, limit) = usage.worst(), nearest(usage)
            end = "at most" if usage.value[k, i] > usage.upper[i] else "at least"
            yield (f"{where}{usage.title} {shown} ({usage.items[i]}, t = {usage.times[k]:.3g} s; {end} {limit} asked)")


def _rooms(executed: Execution, walker: Walker) -> dict[str, float]:
    force = max(FORCE, OF_FORCES * float(np.abs(executed.states.forces).max(initial=0.0)))
    return {"N": force, "N m": force * walker.start.response.scale.length, "m": LENGTH, "rad": ANGLE}


def _room(usage: Usage, rooms: Mapping[str, float]) -> float:
    return rooms.get(usage.unit) or LIMIT * float(np.max(usage.scale, initial=0.0))


def _looks(walker: Walker, room: float) -> Looks:
    """Return the instants that are looked at: knots, corners, and some inside every piece between them.

    Args:
        walker: whose task it is.
        room: by how much more than in the middle of a piece a load may leave its straight line elsewhere in it [N].
    """
    task = walker.task
    sampled = intersample_of(task, walker.start)
    known = Looks(task.times, task.wrench, walker.wanted) if sampled is None else sampled.grid
    first, wide = known.times[:-1], np.diff(known.times)
    parts = int(np.clip(-(-LOOKS // np.count_nonzero(wide)), *PARTS))
    inner = (first[:, None] + wide[:, None] * np.arange(1, parts) / parts)[wide > 0].ravel()
    if sampled is not None and not sampled.exact:
        inner = np.unique(np.concatenate([inner, _bent(sampled, walker, room)]))
    inside = Looks(inner, *(interpolated(inner, known.times, values) for values in (known.wrench, known.target)))
    if task.course is not None:
        inside = looked_at(task, task.course, inner, walker.start)
    whole = known.and_then(inside)
    return whole.of(np.argsort(whole.times, kind="stable"))


def _bent(sampled: Intersample, walker: Walker, room: float) -> Array:
    """Return the instants in those curved pieces where the load leaves its line by more than in the middle [N]."""
    departure = walker.start.response.scale.wrench(sampled.curved.wrench - sampled.chords.wrench)
    sizes = np.linalg.norm(departure, axis=1).reshape(-1, sampled.samples)
    far = sizes.max(axis=1, initial=0.0) > sizes[:, sampled.samples // 2] + room
    return np.asarray(sampled.curved.times[np.repeat(far, sampled.samples)])


def _moved(
    executed: Execution, looks: Looks, walker: Walker, formulation: Formulation, way: Steps | None = None
) -> tuple[Motion, AtStates]:
    """Return executed references as a motion, with the formulation in which its limits are looked at."""
    start, left = walker.start, executed.left(looks.target)
    way = way or steps(analyses_of(executed, start), start, walker.task, left)
    displacement = frozen(looks.target - left)
    there = AtStates.of(
        formulation.whole, times=executed.times, wrench=looks.wrench, target=looks.target,
        rigid=frozen(displacement + way.beside),
    )  # fmt: skip
    motion = motion_of(executed, start, looks.wrench, sag_of(way.each, looks.wrench, start))
    return replace(motion, du=displacement), there
