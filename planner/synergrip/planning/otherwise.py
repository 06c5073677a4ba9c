"""The references of a walk where something is not as stated: under other loads, with other contacts or compliances."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from synergrip.conic.allowed import Allowed
from synergrip.conic.along import AtStates
from synergrip.conic.formulation import Formulation
from synergrip.conic.intersample import Looks
from synergrip.conic.limits.limit import Limit, Usage
from synergrip.equilibrium.execution import Execution
from synergrip.equilibrium.setting import Setting
from synergrip.equilibrium.states import States
from synergrip.linalg import Array, frozen, interpolated
from synergrip.planning.figures import missed_in, moved, rooms_of, stable
from synergrip.planning.in_cases import limits_of_cases
from synergrip.planning.reach import off
from synergrip.planning.walk import Walker
from synergrip.planning.walk_so_far import Walk
from synergrip.statics.motion import Motion
from synergrip.values import Value


@dataclass(frozen=True, eq=False, repr=False)
class Otherwise(Value):
    """The references of a walk all of whose knots were reached, and what its task allows for."""

    walk: Walk
    walker: Walker
    allowed: Allowed
    narrow: Formulation
    """Of the task at its knots, with the least friction that is allowed."""

    @classmethod
    def of(cls, walk: Walk, walker: Walker, formulation: Formulation, allowed: Allowed) -> Otherwise:
        """Return it.

        Args:
            walk: references and their execution.
            walker: whose task it is.
            formulation: of the task at its knots, for names and units.
            allowed: what the task allows for.
        """
        return cls(walk, walker, allowed, allowed.narrowed(formulation.whole))

    @cached_property
    def looks(self) -> Looks:
        """The instants at which limits count, under the load that is stated."""
        task = self.walker.task
        if len(task.times) < 2 or task.between == "report":
            return Looks(task.times, task.wrench, self.walker.wanted)
        return self.walker.looks(self.walk)

    @cached_property
    def limits(self) -> list[Limit]:
        """Those that differ from one case to another."""
        return limits_of_cases(self.walker.task)

    @cached_property
    def begun(self) -> States:
        """States of the walk at the instants at which limits count."""
        return self.near(self.looks)

    def near(self, looks: Looks) -> States:
        """Return states of the walk at some instants, where Newton's method may begin."""
        return self.walk.executed.interpolated(looks.times, looks.wrench)

    def run(
        self, looks: Looks, near: States | Execution, own: Setting | None = None, *, roughly: bool = False
    ) -> Execution:
        """Return the references executed.

        Args:
            looks: instants and loads.
            near: states not far from those that are looked for.
            own: the grasp as it is; the one that is stated when None.
            roughly: whether equilibria that are known well enough for limits do.
        """
        executor = self.walker.executor if own is None else replace(self.walker.executor, setting=own)
        references = frozen(interpolated(looks.times, self.walker.task.times, self.walk.references))
        return executor.run(looks.times, references, looks.wrench, near, (lambda forces: True) if roughly else None)

    def moved(self, looks: Looks, executed: Execution) -> tuple[Motion, AtStates]:
        """Return an execution as a motion, and the formulation in which its limits are looked at."""
        return moved(executed, looks, self.walker, self.narrow)

    def usages(self, states: AtStates, motion: Motion) -> tuple[Usage, ...]:
        """Return what a motion uses of the limits."""
        return tuple(limit.usage(states, motion) for limit in self.limits)

    def rooms(self, usages: tuple[Usage, ...]) -> tuple[Array, ...]:
        """Return of each limit how far beyond it each item (m,) counts as kept."""
        return rooms_of(self.walk, self.walker, self.limits, usages)

    def missed(self, executed: Execution, usages: tuple[Usage, ...]) -> list[str]:
        """Return what an execution misses, in words."""
        gives_way = () if stable(executed).passed else ("the equilibrium gives way",)
        return [*missed_in(usages, self.rooms(usages)), *gives_way]


def worst_of_all(every: Sequence[tuple[Usage, ...]]) -> tuple[Usage, ...]:
    """Return of each limit, item by item and at each instant, the value that is farthest beyond it."""
    found = []
    for usages in zip(*every, strict=True):
        which = np.argmax([usage.excess for usage in usages], axis=0)[None]
        value = np.take_along_axis(np.array([usage.value for usage in usages]), which, axis=0)[0]
        found.append(replace(usages[0], value=frozen(value)))
    return tuple(found)


def walked_harder(walk: Walk, harder: Walker) -> tuple[Walk, Walker] | None:
    """Return the walk of one who asks for more, from another walk, and that walker; None where it does not arrive."""
    again = harder.on(replace(walk, gap=np.inf))
    arrives = harder.good(again) and float(off(again, harder).max()) <= harder.allowed
    return (again, harder) if arrives or again.interrupted else None
