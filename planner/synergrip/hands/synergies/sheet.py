"""A table of numbers as a logger or a spreadsheet writes it: a header, then a line for each instant.

Cells are parted by commas, semicolons, tabs or blanks; numbers may have a decimal comma where that parts no cells.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

from synergrip.documents.csv_cells import Cell, CellReader
from synergrip.documents.documents import LARGEST_NUMBER

BLANKS = " "
PARTED_BY = {",": "commas", ";": "semicolons", "\t": "tabs", BLANKS: "blanks"}
COMMENTS = ("#", "//", "%")
MOST_COLUMNS = 2000
"""More are no recording of a hand."""
LONGEST_NAME = 1000
"""Characters of a cell of the header; more are no name."""
LOOKED_AT = 20
"""Lines that decide what parts the cells."""
MISSING = ("nan", "na", "n/a", "#n/a", "null", "none", "nil", "-", "--", "missing")
UNITS = re.compile(r"[(\[]?(deg|degrees?|°|rad|radians?|s|ms|sec|m|mm|-)?[)\]]?", re.IGNORECASE)

_CELL = re.compile(r'"[^"]*"|\S+')
_NUMBER = re.compile(r"[-+]?(\d+[.,]?\d*|[.,]\d+)([eE][-+]?\d+)?", re.ASCII)
_INSTANT = re.compile(r"\d[-:/. T]+\d|\d\W*[A-Za-z]{3}|[A-Za-z]{3}\W*\d")
_SEPARATOR = re.compile(r'"?sep=(.)"?\s*', re.IGNORECASE)


@dataclass(frozen=True, eq=False)
class Sheet:
    """The lines of a recording."""

    reader: CellReader
    delimiter: str
    """What parts the cells: a comma, a semicolon, a tab, or any number of blanks."""
    header: tuple[Cell, ...]
    rows: tuple[tuple[int, str], ...]
    """Number (from 1) and text of each further line that is neither blank nor a comment."""
    above: tuple[Cell, ...]
    """The cells of the last comment above the header: names, if a tool took the header for a comment."""

    @classmethod
    def of(cls, path: Path, expected: str) -> Sheet:
        """Read the file at `path`.

        Args:
            path: the file.
            expected: what the file is to hold, for the error.

        Raises:
            InputError: no such file, one that is no text, empty, or with too many columns.
        """
        reader = CellReader.of(path)
        if len(reader.lines) == 1:
            reader.lines = reader.lines[0].split("\r")  # ends of lines of old
        lines = list(_lines(reader.lines))
        told = _SEPARATOR.fullmatch(lines[0][1]) if lines else None
        lines = lines[1:] if told else lines
        number, first = lines[0] if lines else (1, "")
        delimiter = told[1] if told else _delimiter(first, [line for _, line in islice(lines, 1, LOOKED_AT)])
        header = tuple(_cells(first, number, delimiter))
        if not lines:
            reader.refuse(f"the file is empty; expected {expected}", Cell("", 1, 1))
        elif len(header) == 1 and (most := _usual(lines[1:])) > 1:
            advice = "take out what stands above the line with the names of the joints"
            reader.refuse(f"a header of one cell, where most lines have {most}; {advice}", header[0])
        elif len(header) > MOST_COLUMNS:
            reader.refuse(f"{len(header)} columns; a recording of a hand has at most {MOST_COLUMNS}", header[0])
        for cell in header:
            if len(cell.text) > LONGEST_NAME:
                reader.refuse(f"a cell of {len(cell.text):,} characters; expected {expected}", cell)
        reader.raise_issues()
        comments = [line.lstrip(" \t#%/") for line in reader.lines[: number - 1] if line.strip()]
        above = tuple(_cells(comments[-1], number, delimiter)) if comments else ()
        return cls(reader, delimiter, header, tuple(lines[1:]), above)

    def column(self, index: int) -> Iterator[str]:
        """Yield the texts of a column, empty where a line is too short."""
        for number, line in self.rows:
            if self.delimiter == BLANKS or '"' in line:
                yield next((cell.text for cell in islice(_cells(line, number, self.delimiter), index, index + 1)), "")
            else:  # several times as fast, for recordings of an hour
                parts = line.split(self.delimiter, index + 1)
                yield parts[index].strip() if index < len(parts) else ""

    def numbers(self, wanted: Sequence[int], others: Sequence[int]) -> list[list[float]]:
        """Return the values of the columns `wanted`, line by line; what is wrong is noted in the reader.

        Cells of the columns `others` have to be numbers or instants too, but are not returned.
        """
        text = [index for index in wanted if len(self.rows) > 1 and not any(map(is_number, self.column(index)))]
        for index in text:
            if sample := next((cell for cell in self.column(index) if cell and cell.lower() not in MISSING), ""):
                name = self.header[index].text
                self.reader.refuse(f"column '{name}' holds text such as '{sample}', no joint values; take it out",
                                   self.header[index])  # fmt: skip
        return [] if self.reader.issues else [self._row(line, number, wanted, others) for number, line in self.rows]

    def _row(self, line: str, number: int, wanted: Sequence[int], others: Sequence[int]) -> list[float]:
        parts = _parts(line, self.delimiter)
        if len(parts) == len(self.header) and all(_is_time(parts[index]) for index in others):
            values = _values([parts[index] for index in wanted]) if line.isascii() and "_" not in line else []
            if values and all(abs(value) <= LARGEST_NUMBER for value in values):  # neither infinite nor nan
                return values
        cells = list(_cells(line, number, self.delimiter))
        if not self._fits(cells):
            return []
        for index in others:
            if not _is_time(cells[index].text):
                self.reader.refuse(f"expected a number, got '{cells[index].text}'", cells[index])
        return [self._number(cells[index], self.header[index].text) for index in wanted]

    def _fits(self, cells: Sequence[Cell]) -> bool:
        """Note a line that is no posture: too few or too many cells, units, or the header once more."""
        count, texts = len(self.header), [cell.text for cell in cells]
        if len(cells) != count:
            decimals = self.delimiter == "," and len(cells) == 2 * count
            hint = "; numbers with decimal commas need cells parted by semicolons" if decimals else ""
            if len(cells) == 1:
                hint = f"; the header has its cells parted by {PARTED_BY.get(self.delimiter, self.delimiter)}"
            self.reader.refuse(f"expected {count} cells as in the header, got {len(cells)}{hint}", cells[0])
        elif texts == [cell.text for cell in self.header]:
            self.reader.refuse("the header once more; take this line out", cells[0])
        elif any(texts) and all(UNITS.fullmatch(text) for text in texts):
            hint = "say them in the header (index_deg) or by --degrees, and take this line out"
            self.reader.refuse(f"a line of units; {hint}", cells[0])
        else:
            return True
        return False

    def _number(self, cell: Cell, column: str) -> float:
        where = f" (column '{column}')"
        if cell.text.lower() in ("", *MISSING):
            found = "nothing" if not cell.text else f"'{cell.text}'"
            said = (
                f"{found} is not a finite number" if cell.text.lower() == "nan" else f"expected a number, got {found}"
            )
            self.reader.refuse(f"{said}{where}; fill it in, or leave out the whole line", cell)
            return 0.0
        try:
            value = _value(cell.text)
        except ValueError:
            infinite = cell.text.lower().lstrip("+-") in ("inf", "infinity")
            said = f"'{cell.text}' is not a finite number" if infinite else f"expected a number, got '{cell.text}'"
            self.reader.refuse(f"{said}{where}", cell)
            return 0.0
        if not abs(value) <= LARGEST_NUMBER:
            self.reader.refuse(f"{cell.text} is too large{where}", cell)
        return value


def is_number(text: str) -> bool:
    """Tell whether a cell is a number to everyone: no 1_000, no digits of other scripts; "nan" is none."""
    return _NUMBER.fullmatch(text) is not None


def _is_time(text: str) -> bool:
    """Tell whether a cell may stand in a column of times: a number, a date, a time of day, or nothing."""
    return not text or is_number(text) or _INSTANT.search(text) is not None


def _values(texts: Sequence[str]) -> list[float]:
    """Return what Python takes the texts for; nothing when it takes one of them for no number."""
    try:
        return [float(text.replace(",", ".")) for text in texts]
    except ValueError:
        return []


def _value(text: str) -> float:
    if not is_number(text):
        raise ValueError
    return float(text.replace(",", "."))


def _lines(lines: Sequence[str]) -> Iterator[tuple[int, str]]:
    for number, line in enumerate(lines, start=1):
        bare = line.strip()
        if bare and (not bare.startswith(COMMENTS) or bare.startswith("%time")):
            yield number, line


def _delimiter(header: str, rows: Sequence[str]) -> str:
    """Return what parts the cells: what stands in the header equally often as in most of the rows."""
    if len(blank := _parts(header, BLANKS)) > 1 and all("," in part and is_number(part) for part in blank):
        return BLANKS  # decimal commas, which part nothing
    bare = re.sub(r'"[^"]*"', "", header)
    found = [mark for mark in (";", "\t", ",") if mark in bare]
    for mark in found:
        fitting = [len(_parts(row, mark)) == len(_parts(header, mark)) for row in rows]
        if sum(fitting) * 2 > len(rows):
            return mark
    if not found and len(blank) > 1 and any(len(_parts(row, BLANKS)) == len(blank) for row in rows):
        return BLANKS
    if not found and all(map(is_number, map(str.strip, rows))):
        return ";"  # a single joint, perhaps with decimal commas
    return found[0] if found else ","


def _usual(lines: Sequence[tuple[int, str]]) -> int:
    """Return how many cells most lines have, whatever parts them; 1 when they do not agree."""
    looked = [line for _, line in lines[:LOOKED_AT] if not is_number(line.strip())]
    for mark in PARTED_BY:
        counted = Counter(len(_parts(line, mark)) for line in looked).most_common(1)
        if counted and counted[0][0] > 1 and 2 * counted[0][1] > len(looked):
            return counted[0][0]
    return 1


def _parts(line: str, delimiter: str) -> list[str]:
    """Return the texts of the cells, without blanks and quotes around them."""
    if delimiter == BLANKS or '"' in line:
        return [cell.text for cell in _cells(line, 0, delimiter)]
    return [part.strip() for part in line.split(delimiter)]


def _cells(line: str, number: int, delimiter: str) -> Iterator[Cell]:
    """Yield the cells of line `number`; a delimiter inside quotes parts nothing."""
    if delimiter == BLANKS:
        for found in _CELL.finditer(line):
            yield Cell(found[0].strip('"').strip(), number, found.start() + 1 + found[0].startswith('"'))
        return
    start = 0
    for part in _split(line, delimiter) if '"' in line else line.split(delimiter):
        bare = part.strip()
        quoted = len(bare) > 1 and bare[0] == bare[-1] == '"'
        at = start + 1 + (part.find(bare) if bare else 0) + quoted
        yield Cell(bare[1:-1].strip() if quoted else bare, number, at)
        start += len(part) + 1


def _split(line: str, delimiter: str) -> Iterator[str]:
    """Yield the parts of a line; a delimiter inside quotes parts nothing."""
    inside, start = False, 0
    for place, letter in enumerate(line):
        inside ^= letter == '"'
        if letter == delimiter and not inside:
            yield line[start:place]
            start = place + 1
    yield line[start:]
