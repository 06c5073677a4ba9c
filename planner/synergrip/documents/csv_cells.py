"""A CSV file as lines of cells, each with its place; what is wrong is collected and told at once."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from synergrip.documents.documents import LARGEST_NUMBER
from synergrip.errors import LONGEST_NAME, InputError, Issue, shortened
from synergrip.plain_file import read_text

MOST_LINES, MOST_COLUMNS, MOST_CELLS = 100_000, 5000, 2_000_000
"""Of a CSV file: 100 s at 1 kHz, and every force of 250 contacts in their columns."""
MOST_REFUSED = 1000
"""Cells; after them the rest of the file is not looked at."""


@dataclass(frozen=True)
class Cell:
    """The text of a cell, without blanks and quotes around it, and where it stands (from 1)."""

    text: str
    line: int
    column: int


@dataclass
class CellReader:
    """Goes through the lines of a CSV file and keeps what is wrong with them."""

    path: Path
    key: str
    """The key of another file that names this one."""
    lines: list[str]
    issues: list[Issue] = field(default_factory=list)

    @classmethod
    def of(cls, path: Path, key: str = "") -> CellReader:
        """Read the file at `path`.

        Raises:
            InputError: no such file, or one that is no text, see `read_text`; or too many lines, columns or cells.
        """
        text = read_text(path, "CSV file", key)
        if text.count("\n") > MOST_LINES or text.count(",") > MOST_CELLS:
            message = f"the file has more than {MOST_LINES:,} lines or {MOST_CELLS:,} cells; leave out lines"
            raise InputError([Issue(message, key, str(path))])
        return cls(path, key, text.split("\n"))

    def rows(self) -> Iterator[tuple[int, str]]:
        """Yield number and text of every line that is neither blank nor a comment (``#``)."""
        for number, line in enumerate(self.lines, start=1):
            if line.strip() and not line.lstrip().startswith("#"):
                yield number, line

    def header(self, rows: Iterator[tuple[int, str]]) -> list[Cell]:
        """Return the cells of the first of the `rows`, an empty one when there is none.

        Raises:
            InputError: too many columns.
        """
        number, line = next(rows, (1, ""))
        if line.count(",") >= MOST_COLUMNS:
            message = f"expected at most {MOST_COLUMNS:,} columns, got {line.count(',') + 1:,}"
            raise InputError([Issue(message, self.key, str(self.path), number, 1)])
        return list(cells_of(line, number))

    def refuse(self, message: str, cell: Cell) -> None:
        """Note what is wrong with a cell.

        Raises:
            InputError: more is wrong than anybody reads.
        """
        if len(self.issues) >= MOST_REFUSED:
            self.raise_issues()
        source = self.lines[cell.line - 1]
        issue = Issue(message, self.key, str(self.path), cell.line, cell.column, max(len(cell.text), 1), source)
        self.issues.append(issue)

    def raise_issues(self) -> None:
        """Raise the `InputError` of all that was noted, in file order; nothing when all is well."""
        if self.issues:
            raise InputError(sorted(self.issues, key=lambda issue: (issue.line, issue.column)))

    def is_header(self, header: list[Cell], expected: str) -> bool:
        """Note a first line that is no header: an empty file, or cells that no commas part."""
        if [cell.text for cell in header] == [""]:
            self.refuse(f"the file is empty; expected {expected}", header[0])
        elif len(header) == 1 and any(mark in header[0].text for mark in ";\t"):
            self.refuse("cells are separated by commas, not by semicolons or tabs", header[0])
        else:
            return True
        return False

    def numbers(self, number: int, line: str, count: int) -> list[float]:
        """Return the `count` values of a line; none after noting what is wrong with them."""
        found = line.count(",") + 1
        if found != count:
            first = next(cells_of(line[:LONGEST_NAME], number))
            self.refuse(f"expected {count} cells as in the header, got {found}", first)
            return []
        try:
            values = [float(text) for text in line.split(",")]
        except ValueError:
            values = []
        if values and all(abs(value) <= LARGEST_NUMBER for value in values) and _is_plain(line):
            return values
        before = len(self.issues)
        values = [self._number(cell) for cell in cells_of(line, number)]
        return values if len(self.issues) == before else []

    def _number(self, cell: Cell) -> float:
        try:
            value = float(cell.text if _is_plain(cell.text) else "")
        except ValueError:
            found = f"'{shortened(cell.text)}'" if cell.text else "nothing"
            self.refuse(f"expected a number, got {found}", cell)
            return 0.0
        if not math.isfinite(value):
            self.refuse(f"'{shortened(cell.text)}' is not a finite number", cell)
        elif abs(value) > LARGEST_NUMBER:
            self.refuse(f"{shortened(cell.text)} is too large", cell)
        return value


def cells_of(line: str, number: int) -> Iterator[Cell]:
    """Yield the cells of line `number`."""
    column = 1
    for text in _parts(line):
        bare = text.strip()
        if len(bare) > 1 and bare.startswith('"') and bare.endswith('"'):
            bare = bare[1:-1].replace('""', '"').strip()
        yield Cell(bare, number, column + max(text.find(bare), 0))
        column += len(text) + 1


def _parts(line: str) -> list[str]:
    """Return the texts between the commas of a line; commas inside quotes part nothing."""
    parts = list[str]()
    for piece in line.split(","):
        if parts and parts[-1].count('"') % 2:
            parts[-1] += f",{piece}"
        else:
            parts.append(piece)
    return line.split(",") if parts[-1].count('"') % 2 else parts  # a quote that nothing closes is no quote


def _is_plain(text: str) -> bool:
    """Tell whether what Python reads as numbers here is a number to everyone: no 1_000, no digits of other scripts."""
    return text.isascii() and "_" not in text
