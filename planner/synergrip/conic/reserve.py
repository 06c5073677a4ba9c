"""The reserve at the knots that keeps a limit between them.

References are linear between knots. Were the load linear too, forces would be, and what holds at two knots would
hold between them, the cones being convex. What the load departs from its line by, ``dw``, adds ``-G+ dw`` to the
forces, whatever the plan; so a reserve at the knots that is as large keeps every limit in between.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from synergrip.conic.bend import Bend
from synergrip.conic.rows import Kind, Rows
from synergrip.conic.situation import Affine, Situation
from synergrip.linalg import Array, frozen, interpolated


def reserved(rows_of: Callable[[Situation], Sequence[Rows]], situation: Situation, bend: Bend) -> list[Rows]:
    """Return rows that keep, at every knot, the reserve that the two intervals beside it need.

    Args:
        rows_of: what makes the rows of a limit or goal; none of them may couple knots.
        situation: at the knots.
        bend: what happens between them.
    """
    straight, bent = (_between(situation, bend, departs) for departs in (False, True))
    triples = zip(rows_of(situation), rows_of(straight), rows_of(bent), strict=True)
    return [
        _with_reserve(at, after.constant - before.constant, bend.interval, bend.allowance)
        for at, before, after in triples
    ]


def _between(situation: Situation, bend: Bend, departs: bool) -> Situation:
    """Return the situation at the instants between the knots, along straight lines or as it departs from them."""
    knots = situation.times

    def along(values: Array) -> Array:
        return frozen(interpolated(bend.times, knots, values))

    def moved(part: Affine) -> Affine:
        return replace(part, constant=along(part.constant))

    return replace(
        situation, times=bend.times, alpha=moved(situation.alpha), beta=moved(situation.beta),
        gamma=moved(situation.gamma), wrench=bend.wrench if departs else along(situation.wrench),
        wanted=bend.wanted if departs else along(situation.wanted),
    )  # fmt: skip


def _with_reserve(rows: Rows, departure: Array, interval: NDArray[np.intp], allowance: float) -> Rows:
    """Lower the head of every cone by the worst that the intervals beside each knot need."""
    if rows.kind is Kind.ZERO:
        return rows
    cones = departure.reshape(len(departure), len(rows.items), rows.dim)
    need = np.maximum(-cones[:, :, 0], 0.0) + np.linalg.norm(cones[:, :, 1:], axis=2)
    of_interval = np.zeros((len(rows.constant) - 1, len(rows.items)))
    np.maximum.at(of_interval, interval, need * allowance)
    ends = np.zeros((1, len(rows.items)))
    of_knot = np.maximum(np.vstack([ends, of_interval]), np.vstack([of_interval, ends]))
    constant = np.array(rows.constant)
    constant[:, :: rows.dim] -= of_knot
    return replace(rows, constant=frozen(constant))
