"""Contacts that are off their place on a hand: executed with their springs shorter or longer, to either side.

Where there are many such cases, the maps of the knots say which of them are the worst: of each limit, and of each
contact's slip margin. Those are executed; of the others there are the figures of the maps.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from synergrip.conic.along import AtStates
from synergrip.conic.departure import Departure, off_place
from synergrip.conic.intersample import Looks
from synergrip.conic.limits.limit import Usage
from synergrip.equilibrium.execution import Execution
from synergrip.equilibrium.setting import Setting
from synergrip.linalg import Array, frozen, interpolated
from synergrip.planning.in_cases import with_contacts_off
from synergrip.planning.otherwise import Otherwise
from synergrip.statics.motion import Motion
from synergrip.values import Value

MOST_EXECUTED = 32
"""Cases with contacts off that are all executed."""


@dataclass(frozen=True, eq=False, repr=False)
class OffPlace(Value):
    """One case with contacts off, by the maps of the knots."""

    title: str
    looks: Looks
    in_place: Execution
    """The same with all contacts where they should be."""
    gaps: Array
    """(n_c,) by how much each contact is early [m], below 0 where it is late."""
    usages: tuple[Usage, ...]
    """Of the limits, by the maps."""

    def setting(self, own: Setting) -> Setting:
        """Return a grasp with its contacts off."""
        early = np.zeros(own.grasp.n_l)
        early[own.grasp.normal_rows] = self.gaps
        return replace(own, early=frozen(early))


def off_places(
    there: Otherwise, title: str, looks: Looks, executed: Execution, motion: Motion, states: AtStates
) -> Iterator[OffPlace]:
    """Yield what becomes of an execution when contacts are off, by the maps of the knots.

    Args:
        there: whose references they are.
        title: of the case with all contacts in place.
        looks: its instants and loads.
        executed: the references under them.
        motion: the same as a motion.
        states: in which its limits are looked at.
    """
    allowed, start, way = there.allowed, there.walker.start.grasp, there.walk.way
    if not np.any(allowed.gaps > 0) or way is None:
        return
    offs = [Departure(*_at(looks.times, there.walker.task.times, each))
            for each in off_place(lambda of: of(way.each), start, allowed.gaps)]  # fmt: skip
    own, names = np.flatnonzero(allowed.gaps > 0), [contact.name for contact in start.contacts]
    off = with_contacts_off(motion, start.S, allowed, offs, names)
    for signs, (words, each) in zip(allowed.signs, off, strict=True):
        gaps = np.zeros(start.n_c)
        gaps[own] = signs * allowed.gaps[own]
        said = ", ".join(part for part in (title, words) if part)
        yield OffPlace(said, looks, executed, gaps, there.usages(states, each))


def worst_of(cases: Sequence[OffPlace]) -> set[int]:
    """Return which cases are executed: all; of many those that are the worst for a limit, or for a contact's cone."""
    if len(cases) <= MOST_EXECUTED:
        return set(range(len(cases)))
    of_limits = np.array([[usage.violation for usage in case.usages] for case in cases])
    of_contacts = np.array([(case.usages[0].excess / case.usages[0].size).max(axis=0) for case in cases])
    return {int(i) for i in np.concatenate([of_limits, of_contacts], axis=1).argmax(axis=0)}


def _at(times: Array, knots: Array, departure: Departure) -> Iterator[Array]:
    for name in ("force", "torque", "joint", "displacement"):
        yield frozen(interpolated(times, knots, getattr(departure, name)))
