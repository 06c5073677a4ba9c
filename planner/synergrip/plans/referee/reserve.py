"""The reserve between the knots, worked out a second time: from the physical formulas at the instants in between."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from synergrip.conic.bend import Bend
from synergrip.linalg import Array, interpolated
from synergrip.plans.referee.model import Cone, Model


@dataclass(frozen=True)
class Courses:
    """The same task written down between the knots: along straight lines, and as it really goes."""

    bend: Bend
    straight: Model
    bent: Model

    @classmethod
    def of(cls, model: Model, bend: Bend, write: Callable[[Array, Array, Array], Model]) -> Courses:
        """Write the task of `model` down with `write`, from instants (J,), wrench and wanted displacement (J, 6)."""
        lines = [interpolated(bend.times, model.times, values) for values in (model.wrench, model.wanted)]
        straight, bent = write(bend.times, *lines), write(bend.times, bend.wrench, bend.wanted)
        return cls(bend, straight, bent)

    def reserved(self, cones: Sequence[Cone], again: Callable[[Model], Sequence[Cone]]) -> list[Cone]:
        """Return cones whose heads are lower by what the loads beside each knot can take away between the knots.

        Args:
            cones: of a limit or goal, at the knots.
            again: writes the same limit or goal down for any instants.
        """
        straight, bent = _values(again(self.straight)), _values(again(self.bent))
        return [
            replace(cone, head=cone.head - self.bend.needed(_lost(before, after)))
            for cone, before, after in zip(cones, straight, bent, strict=True)
        ]


def _values(cones: Sequence[Cone]) -> list[tuple[Array, Array | None]]:
    """Return heads and tails with the references, and every other unknown, at 0."""
    values = []
    for cone in cones:
        for part in (cone.head, cone.tail):
            for variable in getattr(part, "variables", list)():
                variable.value = np.zeros(variable.shape)
        tail = None if cone.tail is None else np.asarray(cone.tail.value)
        values.append((np.asarray(getattr(cone.head, "value", cone.head)), tail))
    return values


def _lost(before: tuple[Array, Array | None], after: tuple[Array, Array | None]) -> Array:
    """Return what the head loses and the rest gains at every instant, in the shape of the head."""
    need = np.maximum(before[0] - after[0], 0.0)
    if before[1] is not None and after[1] is not None:
        need = need + np.linalg.norm(after[1] - before[1], axis=1)
    return need
