"""The reserve at the knots that keeps a limit between them.

References are linear between knots. Were the load linear too, forces would be, and what holds at two knots would
hold between them, the cones being convex. What the load departs from its line by, ``dw``, adds ``-G+ dw`` to the
forces, whatever the plan; so a reserve at the knots that is as large keeps every limit in between.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from synergrip.conic.bend import Bend
from synergrip.conic.rows import Kind, Rows
from synergrip.conic.situation import Affine, Situation
from synergrip.linalg import Array, frozen, interpolated


@dataclass(frozen=True)
class Reserve:
    """A situation between its knots: along straight lines, and as loads and wishes depart from them."""

    bend: Bend
    straight: Situation
    bent: Situation

    @classmethod
    def of(cls, situation: Situation, bend: Bend) -> Reserve:
        """Return what lies between the knots of a situation."""
        lines = [interpolated(bend.times, situation.times, v) for v in (situation.wrench, situation.wanted)]
        return cls(bend, _between(situation, bend, *lines), _between(situation, bend, bend.wrench, bend.wanted))

    def kept(self, rows_of: Callable[[Situation], Sequence[Rows]], situation: Situation) -> list[Rows]:
        """Return rows that keep, at every knot, the reserve that the two intervals beside it need.

        Args:
            rows_of: what makes the rows of a limit or goal; none of them may couple knots.
            situation: at the knots.
        """
        triples = zip(rows_of(situation), rows_of(self.straight), rows_of(self.bent), strict=True)
        return [_with_reserve(at, after.constant - before.constant, self.bend) for at, before, after in triples]


def _between(situation: Situation, bend: Bend, wrench: Array, wanted: Array) -> Situation:
    """Return the situation at the instants between the knots, under a wrench and with a wish (J, 6) of their own."""

    def moved(part: Affine) -> Affine:
        return replace(part, constant=frozen(interpolated(bend.times, situation.times, part.constant)))

    return replace(
        situation, times=bend.times, alpha=moved(situation.alpha), beta=moved(situation.beta),
        gamma=moved(situation.gamma), wrench=frozen(wrench), wanted=frozen(wanted),
    )  # fmt: skip


def _with_reserve(rows: Rows, departure: Array, bend: Bend) -> Rows:
    """Lower the head of every cone by the worst that the intervals beside each knot need."""
    if rows.kind is Kind.ZERO:
        return rows
    cones = departure.reshape(len(departure), len(rows.items), rows.dim)
    need = np.maximum(-cones[:, :, 0], 0.0) + np.linalg.norm(cones[:, :, 1:], axis=2)
    constant = np.array(rows.constant)
    constant[:, :: rows.dim] -= bend.needed(need)
    return replace(rows, constant=frozen(constant))
