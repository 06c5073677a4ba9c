"""Which instants of a play are kept: so many that lines through them leave nothing out, and each contact's worst."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from synergrip.linalg import Array

SAMPLES = 400
"""Into how many parts what is kept divides a play, on the clock of the simulation and on that of the plan.

Where it is slow, the clock of the plan all but stands while something moves, and leaps where nothing does.
"""


class Row(NamedTuple):
    """What is seen at an instant."""

    at: float  # [s] on the clock of the plan
    forces: Array  # (n_l,)
    margins: Array  # (n_c,) [N]
    slips: Array  # (n_c,) [m]
    spins: Array  # (n_c,) [rad]
    touching: NDArray[np.bool_]  # (n_c,)
    du: Array  # (6,)
    q: Array  # (n_q,)


class Kept:
    """The instants of a play of some length on both clocks [s], by the number of the step."""

    def __init__(self, contacts: int, clock: float, plan: float) -> None:
        """Nothing is kept yet."""
        self._parts = (clock / SAMPLES, plan / SAMPLES)
        self._last = (-np.inf, -np.inf)
        self._rows = dict[int, Row]()
        self._worst: list[tuple[int, Row] | None] = [None] * contacts

    def due(self, clock: float, at: float) -> bool:
        """Return whether so much of either clock has gone by that an instant is to be kept."""
        gone = zip((clock, at), self._last, self._parts, strict=True)
        return at > self._last[1] and any(now - last >= part * (1 - 1e-9) for now, last, part in gone)

    def keep(self, number: int, clock: float, row: Row) -> None:
        """Keep an instant."""
        self._rows[number], self._last = row, (clock, row.at)

    def keep_worst(self, lower: NDArray[np.bool_], number: int, row: Row) -> None:
        """Keep an instant in place of the worst ones before of some contacts (n_c,)."""
        for contact in np.flatnonzero(lower):
            self._worst[contact] = (number, row)

    def columns(self) -> list[Any]:
        """Return the values of all instants in their order, each stacked (N, ...)."""
        rows = self._rows | dict(each for each in self._worst if each is not None)
        return [np.array(column) for column in zip(*(rows[number] for number in sorted(rows)), strict=True)]
