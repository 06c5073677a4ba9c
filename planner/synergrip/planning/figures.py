"""What executed references come to: what they use of every limit at the true states, at the knots and between them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import compress

import numpy as np

from synergrip.conic.along import AtStates
from synergrip.conic.formulation import Formulation
from synergrip.conic.intersample import Looks
from synergrip.conic.limits.limit import Limit, Usage
from synergrip.equilibrium.execution import Execution
from synergrip.linalg import Array, frozen, interpolated
from synergrip.planning.between import LIMIT, Between
from synergrip.planning.course import off_course
from synergrip.planning.executing import analyses_of, motion_of, sag_of
from synergrip.planning.outcome import BETWEEN, Check
from synergrip.planning.told import nearest
from synergrip.planning.verified import EQUILIBRIUM, limit_usages
from synergrip.planning.walk import Walker
from synergrip.planning.walk_so_far import Walk
from synergrip.statics.motion import Motion
from synergrip.tasks.tracking_along import Steps, steps
from synergrip.values import Value

LENGTH, ANGLE, OTHER = 1e-5, 1e-4, 1e-3
"""[m], [rad] to which limits on motions are kept; the share of its size to which one in any other unit is, unless it is
one of references alone, which are what they are."""
BALANCED = 1e-8
"""Relative error of the equilibrium."""


@dataclass(frozen=True, eq=False, repr=False)
class Figures(Value):
    """What executed references are and use, at the knots of a task and between them."""

    motion: Motion
    usages: tuple[Usage, ...]
    elastic_motion: Array  # (T, 6)
    at_knots: Between
    """The limits that speak of an instant, at the knots alone."""
    between: Between | None
    checks: tuple[Check, ...]
    missed: tuple[str, ...]
    """What is beyond its limit, by how much, where and when, in words."""

    @property
    def said(self) -> str:
        """What is missed at the true states; nothing when every check passes."""
        failed = [check for check in self.checks if not check.passed]
        if not failed:
            return ""
        told = [*self.missed, *(_of_state(check) for check in failed if "stability" in check.name)]
        told = told or [f"{check.name}, by {check.error:.3g}" for check in failed]
        return f"at the true equilibrium limits are missed: {'; '.join(told)}"


def _of_state(check: Check) -> str:
    return f"{check.name}: the equilibrium gives way, its least stiffness is {-check.error:.3g} N/m"


def figures(walk: Walk, walker: Walker, formulation: Formulation, linear: Between | None) -> Figures:
    """Return the figures of a walk all of whose knots were reached.

    Args:
        walk: references and their execution.
        walker: whose task it is.
        formulation: of the task at its knots, for names and units.
        linear: what load and wish do between the knots; None when no more is known.
    """
    task, executed, way = walker.task, walk.executed, walk.way
    motion, there = moved(executed, Looks(task.times, task.wrench, walker.wanted), walker, formulation, way)
    usages = limit_usages(task, there, motion)
    rooms = rooms_of(walk, walker, task.all_limits, usages)
    elastic = there.elastic_motion(motion)
    checks = (Check(EQUILIBRIUM, executed.residual, BALANCED), stable(executed), *kept(usages, rooms))
    between, inside, there_missed = _between(walk, walker, formulation, linear)
    missed = tuple(missed_in(usages, rooms))
    missed = (*missed, *(told for told in there_missed if told.removeprefix(f"{BETWEEN}: ") not in missed))
    of_instants = [not limit.couples_knots for limit in task.all_limits]
    at_knots = Between(0, 0.0, 0.0, 0.0, tuple(compress(usages, of_instants)), (), tuple(compress(rooms, of_instants)))
    return Figures(replace(motion, du=executed.du), usages, elastic, at_knots, between, (*checks, *inside), missed)


def _between(
    walk: Walk, walker: Walker, formulation: Formulation, linear: Between | None
) -> tuple[Between | None, tuple[Check, ...], tuple[str, ...]]:
    """Return what the references really do between the knots, the checks of that, and what they miss there."""
    task = walker.task
    if len(task.times) < 2:
        return None, (), ()
    looks, where = walker.looks(walk), f"{BETWEEN}: "
    references = frozen(interpolated(looks.times, task.times, walk.references))
    near = walk.executed.interpolated(looks.times, looks.wrench)
    executed = walker.executor.run(looks.times, references, looks.wrench, near)
    if not executed.whole:
        why = f"{where}{executed.why}"
        return None, (Check(f"{where}{EQUILIBRIUM}", np.inf, BALANCED),), (why,)
    motion, there = moved(executed, looks, walker, formulation)
    limits = task.of_instants
    usages = tuple(limit.usage(there, motion) for limit in limits)
    rooms = rooms_of(walk, walker, limits, usages)
    known = linear or Between(walker.samples, 0.0, 0.0, 0.0, usages)
    astray = off_course(executed, looks, walk, walker)
    found = replace(known, samples=walker.samples, usages=usages, rooms=rooms, off_course=astray)
    if task.between == "report":
        return found, (stable(executed, where),), ()
    return found, (stable(executed, where), *kept(usages, rooms, where)), tuple(missed_in(usages, rooms, where))


def stable(executed: Execution, where: str = "") -> Check:
    """Return the check that the hand stays at its equilibria: in [N/m], how far the least stiffness is below 0.

    At 0 the equilibrium is lost, too: the error is then the smallest number above it.
    """
    least = float(executed.stiffness.min())
    return Check(f"{where}stability", 0.0 if least > 0 else max(-least, float(np.nextafter(0.0, 1.0))), 0.0)


def kept(usages: Sequence[Usage], rooms: Sequence[Array], where: str = "") -> tuple[Check, ...]:
    """Return a check for every limit, in its own unit, to the digits that a true state is promised to.

    Args:
        usages: of the limits.
        rooms: (m,) of each, how far beyond it counts as kept, for each of its items.
        where: said before the title.
    """
    return tuple(_check(usage, room, where) for usage, room in zip(usages, rooms, strict=True))


def _check(usage: Usage, room: Array, where: str) -> Check:
    """Return the check of the item that has used most of its room."""
    excess = np.maximum(usage.excess.max(axis=0, initial=0.0), 0.0)
    worst = int(np.argmax(excess / room))
    return Check(f"{where}{usage.title}", float(excess[worst]), float(room[worst]))


def missed_in(usages: Sequence[Usage], rooms: Sequence[Array], where: str = "") -> Iterator[str]:
    """Yield what is beyond its limit: the worst of each, where, when, and the limit."""
    for usage, room in zip(usages, rooms, strict=True):
        if np.any(usage.excess > room):
            (k, i), (shown, limit) = usage.worst(), nearest(usage)
            end = "at most" if usage.value[k, i] > usage.upper[i] else "at least"
            yield (f"{where}{usage.title} {shown} ({usage.items[i]}, t = {usage.times[k]:.3g} s; {end} {limit} asked)")


def rooms_of(walk: Walk, walker: Walker, limits: Sequence[Limit], usages: Sequence[Usage]) -> tuple[Array, ...]:
    """Return for each item (m,) of each limit how far beyond it counts as kept, in its own unit."""
    force = walk.kept_to
    known = {"N": force, "N m": force * walker.start.response.scale.length, "m": LENGTH, "rad": ANGLE}

    def room(limit: Limit, usage: Usage) -> Array:
        share = LIMIT if limit.of_references_alone else OTHER
        return np.full(len(usage.items), known[usage.unit]) if usage.unit in known else share * usage.scale

    return tuple(room(limit, usage) for limit, usage in zip(limits, usages, strict=True))


def moved(
    executed: Execution, looks: Looks, walker: Walker, formulation: Formulation, way: Steps | None = None
) -> tuple[Motion, AtStates]:
    """Return executed references as a motion, with the formulation in which its limits are looked at."""
    start, left = walker.start, executed.left(looks.target)
    displacement = frozen(looks.target - left)

    def rigid() -> Array:
        there = way or steps(analyses_of(executed, start), start, walker.task, left)
        return frozen(displacement + there.beside)

    there = AtStates.of(
        formulation.whole, times=executed.times, wrench=looks.wrench, target=looks.target, rigid=rigid
    )  # fmt: skip
    motion = motion_of(executed, start, looks.wrench, sag_of(executed.maps, looks.wrench, start))
    return replace(motion, du=displacement), there
