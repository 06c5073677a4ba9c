"""Whether the values of a recording can be in the unit they are read in: radians taken for degrees, and the reverse."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from synergrip.documents.csv_cells import Cell, CellReader
from synergrip.hands.hand import Hand
from synergrip.hands.synergies.column_names import UNITS
from synergrip.linalg import Array

TURN = 2 * math.pi
SMALL = 3.2
"""[deg] Postures that all are within this of 0 are more likely radians, which half a turn bounds."""
SLACK = 0.1
"""Share of a range by which records may leave it: calibration is not perfect."""
FEW, MANY = 0.5, 0.75
"""Shares of the values that keep to the ranges of their joints, when the unit is wrong, and when it is right."""
OTHER = {"rad": "deg", "deg": "rad", "m": "mm", "mm": "m"}
WORDS = {"rad": "radians", "deg": "degrees", "m": "m", "mm": "mm"}


@dataclass(frozen=True)
class Column:
    """A column with the values of a joint."""

    joint: str
    kind: str
    unit: str
    """A key of `UNITS`."""
    stated: bool
    """Whether its name says the unit."""
    cell: Cell
    index: int

    @property
    def factor(self) -> float:
        """To rad or m."""
        return UNITS[self.kind][self.unit]


def refuse_unit(
    reader: CellReader, columns: Sequence[Column], rows: Array, lines: Sequence[int], hand: Hand | None
) -> None:
    """Note columns whose values leave the ranges of their joints in their unit and keep them in the other one.

    Args:
        reader: takes the issues.
        columns: those of joints.
        rows: (N, n) values as they are written.
        lines: (N) where they stand.
        hand: whose ranges they are; nothing is judged without it.
    """
    for kind, unit in dict.fromkeys((column.kind, column.unit) for column in columns):
        group = [i for i, column in enumerate(columns) if (column.kind, column.unit) == (kind, unit)]
        as_read, as_other = (_inside(columns, rows, group, each, hand) for each in (unit, OTHER[unit]))
        if not as_read.size or as_read.mean() > FEW or as_other.mean() < MANY:
            continue
        ranged = [i for i in group if _range(columns[i], hand) is not None]
        row, far = _farthest(rows, ranged)
        column = columns[far]
        lower, upper = _range(column, hand) or (0.0, 0.0)
        reader.refuse(
            f"read in {WORDS[unit]}, {100 * as_read.mean():.0f} % of the values keep to the ranges of their joints "
            f"('{column.joint}' is at {rows[row, far]:.4g} {unit} in line {lines[row]}, its range is "
            f"{lower / column.factor:.4g} to {upper / column.factor:.4g} {unit}); in {WORDS[OTHER[unit]]} "
            f"{100 * as_other.mean():.0f} % do: {_restate(column, OTHER[unit])}",
            column.cell,
        )


def unit_notes(columns: Sequence[Column], rows: Array, lines: Sequence[int]) -> Iterator[str]:
    """Yield notes on angles that are very large or very small for their unit; arguments as of `refuse_unit`."""
    yield from _too_large(columns, rows, lines)
    yield from _too_small(columns, rows)


def _restate(column: Column, unit: str) -> str:
    """Return how to say that the values of a column are in `unit`."""
    named = f"name the column{'s' if not column.stated else ''} {column.joint}_{unit}"
    if column.stated or column.kind == "slide":
        return named
    return f"say --degrees, or {named}" if unit == "deg" else f"leave out --degrees, or {named}"


def _range(column: Column, hand: Hand | None) -> tuple[float, float] | None:
    """Return the range of a joint [rad or m], widened by some slack; None when it has none."""
    joint = next((each for each in hand.joints if each.name == column.joint), None) if hand is not None else None
    if joint is None or not math.isfinite(joint.upper - joint.lower):
        return None
    return joint.lower, joint.upper


def _inside(
    columns: Sequence[Column], rows: Array, group: Sequence[int], unit: str, hand: Hand | None
) -> NDArray[np.bool_]:
    """Return which values keep to the range of their joint when they are read in `unit`."""
    found = []
    for i in group:
        if (ends := _range(columns[i], hand)) is not None:
            values, slack = rows[:, i] * UNITS[columns[i].kind][unit], SLACK * (ends[1] - ends[0])
            found.append((values >= ends[0] - slack) & (values <= ends[1] + slack))
    return np.array(found, dtype=bool)


def _farthest(rows: Array, group: Sequence[int]) -> tuple[int, int]:
    """Return line and column, among those of `group`, of the value that is farthest from 0."""
    row, place = divmod(int(np.argmax(np.abs(rows[:, group]))), len(group))
    return row, group[place]


def _too_large(columns: Sequence[Column], rows: Array, lines: Sequence[int]) -> Iterator[str]:
    turning = [i for i, column in enumerate(columns) if column.unit == "rad"]
    if turning and np.abs(rows[:, turning]).max() > TURN:
        row, which = _farthest(rows, turning)
        column = columns[which]
        where = f"'{column.joint}' in line {lines[row]}"
        way = f"name the column {column.joint}_deg" if column.stated else "say --degrees"
        yield (
            f"values up to {abs(rows[row, which]):.4g} rad ({where}) are more than a turn; if they are degrees, {way}"
        )


def _too_small(columns: Sequence[Column], rows: Array) -> Iterator[str]:
    turning = [i for i, column in enumerate(columns) if column.unit == "deg"]
    if turning and 0 < np.abs(rows[:, turning]).max() <= SMALL:
        named = [columns[i].joint for i in turning if columns[i].stated]
        way = f"name the columns {named[0]}_rad and so on" if named else "leave out --degrees"
        yield (
            f"all values in degrees are within {np.abs(rows[:, turning]).max():.4g} deg of 0, which hardly moves a "
            f"hand; if they are radians, {way}"
        )
