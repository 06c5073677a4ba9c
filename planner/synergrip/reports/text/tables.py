"""Small tables and paragraphs that fit the place where they are shown."""

from __future__ import annotations

import re
from collections.abc import Container, Iterator, Sequence
from itertools import zip_longest

from synergrip.reports.text.screen import LEAST, PARAGRAPH, screen
from synergrip.reports.text.unbroken import TIED, cells, freed, glued, parted

GAP = 2
"""Columns between those of a table."""
NARROW, NARROW_LAST = 14, 26
"""Columns that a cell of words keeps, and one of the last column: narrower ones are worse than a line below the row."""
BELOW = 4
"""Columns by which a line below its row is set in."""
_BOLD, _END = "\x1b[1m", "\x1b[0m"
_NUMBER = re.compile(
    r"((?:[≥≤±<>]|below|above)? ?)([-+]?\d+)((?:\.\d+)?(?:e[-+]?\d+)?(?: ?[^\d\s(),]\S*(?: [^\d\s]+){0,2})?)"
)
"""Sign or word, whole part, fraction and unit of a cell that is a number."""


def table(header: Sequence[str], rows: Sequence[Sequence[str]], right: Sequence[int] = ()) -> str:
    """Return lines with aligned columns, in which no word and no number is split.

    Numbers stand with their decimal points below each other. A table that is too wide has cells of several lines; where
    not even that fits, its last columns stand below their row, each on a line of its own.

    Args:
        header: names of the columns.
        rows: their cells.
        right: columns that are aligned to the right.
    """
    there = [i for i in range(len(header)) if not rows or any(row[i] for row in rows)]
    columns = [_aligned([header[i], *(row[i] for row in rows)], i in right) for i in there]
    rights = {k for k, i in enumerate(there) if i in right}
    width = max(screen().width, LEAST)
    kept = next((n for n in range(len(columns), 1, -1) if sum(_least(columns[:n])) + GAP * (n - 1) <= width), 1)
    widths = _widths(columns[:kept], width)
    names, *cells_of = zip(*columns, strict=True)
    lines = [_bold(line) for line in _row(names[:kept], widths, rights)]
    for row in cells_of:
        lines += [*_row(row[:kept], widths, rights), *_below(names[kept:], row[kept:], width)]
    return "\n".join(lines)


def wrapped(label: str, text: str, width: int = PARAGRAPH, inset: int = 0) -> list[str]:
    """Return the text in lines that fit, the first after the label, the others below the text.

    Args:
        label: stands before the text.
        text: words.
        width: of the longest line, where the place is wider.
        inset: columns by which all but the first line are set in further.
    """
    start = " " * (cells(label) + inset)
    lines = parted(glued(text), min(width, max(screen().width, LEAST)) - len(start))
    return [freed(f"{label if i == 0 else start}{line}") for i, line in enumerate(lines)]


def fitted(text: str) -> str:
    """Return text whose lines fit: those that are too long are continued below their own words."""
    width, lines = max(screen().width, LEAST), list[str]()
    for line in text.split("\n"):
        if cells(line) <= width:
            lines.append(line)
            continue
        label = re.match(r"\s*(?:\S+ {2,})?", line)
        start = label[0] if label and cells(label[0]) <= width // 2 else ""
        lines += wrapped(start, line[len(start) :], width, inset=0 if start else 2)
    return "\n".join(lines)


def _aligned(column: Sequence[str], right: bool) -> list[str]:
    """Return the cells of a column, tied where they must not break, numbers with their points below each other.

    A column is one of numbers when most of its cells are, or when it is aligned to the right.
    """
    head, *rest = column
    found = [_NUMBER.fullmatch(cell) for cell in rest]
    if right or sum(map(bool, found)) * 2 > sum(map(bool, rest)):
        parts = [match.groups("") for match in found if match]
        sign, whole = (max((len(part[i]) for part in parts), default=0) for i in (0, 1))
        tail = max((cells(part[2]) for part in parts), default=0) if right else 0
        for i, match in enumerate(found):
            if match:
                start, number, more = match.groups("")
                padded = f"{start:{sign}}{number:>{whole}}".replace(" ", TIED)
                rest[i] = padded + more + TIED * (tail - cells(more))
    return [glued(head), *map(glued, rest)]


def _least(columns: Sequence[Sequence[str]]) -> list[int]:
    """Return the least width of each column: its longest word, and no less than is read well."""
    least = []
    for i, column in enumerate(columns):
        natural = max(map(cells, column))
        comfort = NARROW_LAST if i == len(columns) - 1 else NARROW
        least.append(max(min(natural, comfort), *(cells(word) for cell in column for word in cell.split(" "))))
    return least


def _widths(columns: Sequence[Sequence[str]], width: int) -> list[int]:
    """Return the width of each column: that of its cells, the widest less where all together are too wide."""
    widths, least = [max(map(cells, column)) for column in columns], _least(columns)
    while sum(widths) + GAP * (len(widths) - 1) > width:
        wider = [i for i in range(len(widths)) if widths[i] > least[i]]
        if not wider:  # one word alone is too long: it is shown whole
            break
        widths[max(wider, key=lambda i: widths[i])] -= 1
    return widths


def _bold(line: str) -> str:
    return f"{_BOLD}{line}{_END}" if line and screen().color else line


def _row(row: Sequence[str], widths: Sequence[int], right: Container[int]) -> Iterator[str]:
    """Yield the lines of a row."""
    blocks = [parted(cell, width) for cell, width in zip(row, widths, strict=True)]
    for parts in zip_longest(*blocks, fillvalue=""):
        pads = [" " * (width - cells(part)) for part, width in zip(parts, widths, strict=True)]
        padded = [
            pad + part if i in right else part + pad for i, (part, pad) in enumerate(zip(parts, pads, strict=True))
        ]
        yield freed((" " * GAP).join(padded)).rstrip()


def _below(header: Sequence[str], row: Sequence[str], width: int) -> list[str]:
    """Return the lines with the cells that stand below their row, each after the name of its column."""
    lines = list[str]()
    for name, cell in zip(header, row, strict=True):
        text = cell.strip(f" {TIED}")
        if not text:
            continue
        first, *more = parted(f"{name}: {text}" if name else text, width - BELOW)
        if lines and cells(lines[-1]) + GAP + cells(first) <= width:
            lines[-1] += " " * GAP + first
        else:
            lines.append(" " * BELOW + first)
        lines += [" " * BELOW + line for line in more]
    return [freed(line) for line in lines]
