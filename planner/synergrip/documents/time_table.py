"""CSV tables over time: external wrench, wanted motion, synergy references."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

from synergrip.documents.csv_cells import Cell, CellReader, cells_of
from synergrip.errors import InputError, shortened, suggest
from synergrip.linalg import Array, frozen
from synergrip.values import Value

TIME = "t_s"
WRENCH = ("fx_N", "fy_N", "fz_N", "mx_Nm", "my_Nm", "mz_Nm")
MOTION = ("x_m", "y_m", "z_m", "rx_rad", "ry_rad", "rz_rad")
MODES = "beta_"
REFERENCES = "zr_"
SHOWN = 12
"""Names of columns that a message lists."""


@dataclass(frozen=True, eq=False, repr=False)
class Table(Value):
    """Values at increasing times."""

    times: Array  # s
    """(T,)"""
    values: Array
    """(T, m), columns in the order they were asked for."""


def read_table(path: Path, columns: Sequence[str] | str, key: str = "", *, others: bool = False) -> Table:
    """Read a CSV file with a header line, a column ``t_s`` and one number in every cell.

    Args:
        path: the file. Blank lines and lines that begin with ``#`` are skipped.
        columns: the names wanted besides ``t_s``, which may stand in any order (`WRENCH`, `MOTION`), or a
            prefix (`MODES`, `REFERENCES`) for any number of columns ``beta_1, beta_2, ...``.
        key: the key of the problem file that names this file, for messages. When it is given, the issue of a
            file that is not there has no place, for `Document.locate` to fill in.
        others: whether further columns are passed over instead of refused.

    Raises:
        InputError: no such file, wrong header, ragged lines, cells that are no finite number, times that
            do not increase; every issue with line and column.
    """
    reader = CellReader.of(path, key)
    rows = reader.rows()
    cells = reader.header(rows)
    order = _order(reader, cells, columns, others)
    if reader.issues:
        raise InputError(reader.issues)  # an unknown column before the one that is missing for it
    numbers = [(row, reader.numbers(row, line, len(cells))) for row, line in rows]
    if not numbers:
        reader.refuse("there is no line of numbers below the header", cells[0])
    _judge_times(reader, [(row, values[order[0]]) for row, values in numbers if values], order[0])
    reader.raise_issues()
    array = frozen([values for _, values in numbers])[:, order]
    return Table(frozen(array[:, 0]), frozen(array[:, 1:]))


def _order(reader: CellReader, header: list[Cell], columns: Sequence[str] | str, others: bool) -> list[int]:
    """Return the position of ``t_s`` and of every wanted column in the header."""
    names, open_ended = [cell.text for cell in header], isinstance(columns, str)
    if isinstance(columns, str):
        count = max(sum(name.startswith(columns) for name in names), 1)
        columns = [f"{columns}{index}" for index in range(1, count + 1)]
    wanted = [TIME, *columns]
    expected = f"the header {','.join([*wanted[:SHOWN], *(['...'] if open_ended else [])])}"
    if reader.is_header(header, expected):
        known, there, seen = set(wanted), set(names), set[str]()
        absent = [name for name in wanted if name not in there]
        for cell in header:
            if cell.text not in known and not others:
                reader.refuse(f"unknown column '{shortened(cell.text)}'{suggest(cell.text, absent)}", cell)
            elif cell.text in seen:
                reader.refuse(f"column '{shortened(cell.text)}' is there twice", cell)
            seen.add(cell.text)
        if absent:
            listed = ", ".join(f"'{name}'" for name in absent[:SHOWN]) + (", ..." if len(absent) > SHOWN else "")
            plural = "s" if len(absent) > 1 else ""
            reader.refuse(f"missing column{plural} {listed}; expected {expected}", header[0])
    place = {name: index for index, name in enumerate(names)}
    return [] if reader.issues else [place[name] for name in wanted]


def _judge_times(reader: CellReader, times: list[tuple[int, float]], column: int) -> None:
    for (_, earlier), (number, later) in pairwise(times):
        if later <= earlier:
            what = "is repeated" if later == earlier else f"comes after {earlier:g} s"
            cells = list(cells_of(reader.lines[number - 1], number))
            reader.refuse(f"times must increase: {later:g} s {what}", cells[column])
