"""What makes the columns of a recording doubtful: numbers in place of names, columns that only count or stand still."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from synergrip.documents.csv_cells import CellReader
from synergrip.hands.hand import Hand
from synergrip.hands.synergies.meant_units import TURN, Column
from synergrip.hands.synergies.sheet import Sheet, is_number
from synergrip.linalg import Array

NOTHING = "nothing"
"""What a column is that is empty because each line ends in a delimiter."""
ENDLESS = 1000.0
"""[deg or rad] What goes that far without turning back is no joint."""
COUNTING = 4
"""Lines, from which equal steps are no accident."""
SHOWN = 3


def refuse_numbers(sheet: Sheet, hand: Hand | None) -> None:
    """Note in the reader of a sheet that its header holds numbers in place of names."""
    known = hand.joint_names if hand is not None else ()
    numbers = [cell for cell in sheet.header if is_number(cell.text) and cell.text not in known]
    if not numbers:
        return
    above = [cell.text for cell in sheet.above]
    if len(above) == len(sheet.header) and not any(map(is_number, above)):
        listed = ", ".join([*above[:SHOWN], *["..."][: len(above) - SHOWN]])
        advice = f"if the comment above it names them ({listed}), remove the mark in front"
    else:
        names = [*(n for n in known if n not in (hand.couplings if hand is not None else {})), "index_mcp", "index_pip"]
        advice = f"write their names above the first posture, such as {sheet.delimiter.join(names[:SHOWN])}"
    sheet.reader.refuse(
        f"'{numbers[0].text}' is a number, not the name of a joint: the first line names the joints; {advice}",
        numbers[0],
    )


def counts(texts: Sequence[str]) -> bool:
    """Tell whether a column holds whole numbers that rise from line to line."""
    if not all(text.isascii() and text.isdigit() and len(text) < 16 for text in texts):
        return False
    return bool(np.all(np.diff([int(text) for text in texts]) > 0))


def left_out_notes(columns: Mapping[str, str]) -> Iterator[str]:
    """Yield what was left out, from names of columns to what they are; of ``t_s`` people know."""
    for what in dict.fromkeys(columns.values()):
        names = [f"'{name}'" for name, each in columns.items() if each == what and name != "t_s"]
        more = f" and {len(names) - SHOWN} more" if len(names) > SHOWN else ""
        if names:
            yield f"left out as {what}: {', '.join(names[:SHOWN])}{more}"


def doubts(columns: Sequence[Column], rows: Array, hand: Hand | None) -> Iterator[str]:
    """Yield notes on columns that may be no joints, or stand still; arguments as of `refuse_unit`."""
    if hand is None:
        yield from _counters(columns, rows)
    still = [column.joint for i, column in enumerate(columns) if np.ptp(rows[:, i]) == 0]
    if still and len(still) < len(columns):
        more = f" and {len(still) - SHOWN} more" if len(still) > SHOWN else ""
        yield f"the same in all postures: {', '.join(map(repr, still[:SHOWN]))}{more}"


def _counters(columns: Sequence[Column], rows: Array) -> Iterator[str]:
    for i, column in enumerate(columns):
        steps = np.diff(rows[:, i])
        even = len(rows) >= COUNTING and np.ptp(steps) <= 1e-6 * np.abs(steps).min()
        even = even or np.all(steps == 1)
        if _one_way(rows[:, i]) and (even or np.ptp(rows[:, i]) * column.factor > TURN):
            yield (
                f"{_course(column, rows[:, i])}{' by equal steps' if even else ''}: if it tells the time or counts, "
                "take it out or call it t_s"
            )


def _one_way(values: Array) -> bool:
    """Tell whether three or more values rise, or fall, from each to the next."""
    steps = np.diff(values)
    return len(steps) > 1 and bool(np.all(steps > 0) or np.all(steps < 0))


def _course(column: Column, values: Array) -> str:
    return f"'{column.joint}' goes from {values[0]:.10g} to {values[-1]:.10g} without turning back"


def refuse_endless(reader: CellReader, columns: Sequence[Column], rows: Array, hand: Hand | None) -> None:
    """Note columns that go on and on; arguments as of `refuse_unit`. Of a hand's own joints nobody doubts that."""
    for i, column in enumerate(columns if hand is None else ()):
        if _one_way(rows[:, i]) and np.abs(rows[:, i]).max() > ENDLESS:
            course = _course(column, rows[:, i])
            reader.refuse(
                f"{course}, as a time or a counter does and no joint; take it out or call it t_s", column.cell
            )
