"""CSV tables over time: external wrench, wanted motion, synergy references."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from pathlib import Path

from synergrip.documents import LARGEST_NUMBER, MOST_ISSUES, read_text
from synergrip.errors import InputError, Issue, suggest
from synergrip.linalg import Array, frozen

TIME = "t_s"
WRENCH = ("fx_N", "fy_N", "fz_N", "mx_Nm", "my_Nm", "mz_Nm")
MOTION = ("x_m", "y_m", "z_m", "rx_rad", "ry_rad", "rz_rad")
MODES = "beta_"
REFERENCES = "zr_"


@dataclass(frozen=True, eq=False)
class Table:
    """Values at increasing times."""

    times: Array  # s
    """(T,)"""
    values: Array
    """(T, m), columns in the order they were asked for."""


@dataclass(frozen=True)
class _Cell:
    text: str
    line: int
    column: int


@dataclass
class _Reader:
    path: Path
    key: str
    lines: list[str]
    issues: list[Issue] = field(default_factory=list)

    def refuse(self, message: str, cell: _Cell) -> None:
        source = self.lines[cell.line - 1]
        issue = Issue(message, self.key, str(self.path), cell.line, cell.column, max(len(cell.text), 1), source)
        self.issues.append(issue)

    def rows(self) -> Iterator[tuple[int, str]]:
        """Yield number and text of every line that is neither blank nor a comment."""
        for number, line in enumerate(self.lines, start=1):
            if line.strip() and not line.lstrip().startswith("#"):
                yield number, line


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
    reader = _Reader(path, key, read_text(path, "CSV file", key).split("\n"))
    rows = reader.rows()
    number, header = next(rows, (1, ""))
    cells = list(_cells(header, number))
    order = _order(reader, cells, columns, others)
    if reader.issues:
        raise InputError(reader.issues)
    numbers = [_numbers(reader, number, line, len(cells)) for number, line in rows]
    if not numbers:
        reader.refuse("there is no line of numbers below the header", cells[0])
    _judge_times(reader, [(row, values[order[0]]) for row, values in numbers if values], order[0])
    if reader.issues:
        raise InputError(_shortened(sorted(reader.issues, key=lambda issue: (issue.line, issue.column))))
    array = frozen([values for _, values in numbers])[:, order]
    return Table(frozen(array[:, 0]), frozen(array[:, 1:]))


def _cells(line: str, number: int) -> Iterator[_Cell]:
    column = 1
    for text in line.split(","):
        bare = text.strip()
        if len(bare) > 1 and bare.startswith('"') and bare.endswith('"'):
            bare = bare[1:-1].strip()
        yield _Cell(bare, number, column + (text.find(bare) if bare else 0))
        column += len(text) + 1


def _order(reader: _Reader, header: list[_Cell], columns: Sequence[str] | str, others: bool) -> list[int]:
    """Return the position of ``t_s`` and of every wanted column in the header."""
    names = [cell.text for cell in header]
    if isinstance(columns, str):
        count = max(sum(name.startswith(columns) for name in names), 1)
        columns = [f"{columns}{index}" for index in range(1, count + 1)]
    wanted = [TIME, *columns]
    if names == [""]:
        reader.refuse(f"the file is empty; expected the header {','.join(wanted)}", header[0])
    elif len(names) == 1 and any(mark in names[0] for mark in ";\t"):
        reader.refuse("cells are separated by commas, not by semicolons or tabs", header[0])
    else:
        for index, cell in enumerate(header):
            if cell.text not in wanted and not others:
                missing = [name for name in wanted if name not in names]
                reader.refuse(f"unknown column '{cell.text}'{suggest(cell.text, missing)}", cell)
            elif cell.text in names[:index]:
                reader.refuse(f"column '{cell.text}' is there twice", cell)
        absent = [name for name in wanted if name not in names]
        if absent:
            listed = ", ".join(f"'{name}'" for name in absent)
            plural = "s" if len(absent) > 1 else ""
            reader.refuse(f"missing column{plural} {listed}; expected the header {','.join(wanted)}", header[0])
    return [] if reader.issues else [names.index(name) for name in wanted]


def _numbers(reader: _Reader, number: int, line: str, count: int) -> tuple[int, list[float]]:
    """Return the line's number and its values; no values after noting what is wrong with them."""
    try:
        values = [float(text) for text in line.split(",")]
    except ValueError:
        values = []
    if len(values) == count and all(abs(value) <= LARGEST_NUMBER for value in values) and _is_plain(line):
        return number, values
    cells = list(_cells(line, number))
    if len(cells) != count:
        reader.refuse(f"expected {count} cells as in the header, got {len(cells)}", cells[0])
        return number, []
    before = len(reader.issues)
    values = [_number(reader, cell) for cell in cells]
    return number, values if len(reader.issues) == before else []


def _is_plain(text: str) -> bool:
    """Tell whether what Python reads as numbers here is a number to everyone: no 1_000, no digits of other scripts."""
    return text.isascii() and "_" not in text


def _number(reader: _Reader, cell: _Cell) -> float:
    try:
        value = float(cell.text if _is_plain(cell.text) else "")
    except ValueError:
        reader.refuse(f"expected a number, got '{cell.text}'" if cell.text else "expected a number, got nothing", cell)
        return 0.0
    if not math.isfinite(value):
        reader.refuse(f"'{cell.text}' is not a finite number", cell)
    elif abs(value) > LARGEST_NUMBER:
        reader.refuse(f"{cell.text} is too large", cell)
    return value


def _judge_times(reader: _Reader, times: list[tuple[int, float]], column: int) -> None:
    for (_, earlier), (number, later) in pairwise(times):
        if later <= earlier:
            what = "is repeated" if later == earlier else f"comes after {earlier:g} s"
            cells = list(_cells(reader.lines[number - 1], number))
            reader.refuse(f"times must increase: {later:g} s {what}", cells[column])


def _shortened(issues: list[Issue]) -> list[Issue]:
    if len(issues) <= MOST_ISSUES:
        return issues
    last = issues[MOST_ISSUES - 1]
    more = f"{last.message} (and {len(issues) - MOST_ISSUES} more in this file)"
    return [*issues[: MOST_ISSUES - 1], replace(last, message=more)]
