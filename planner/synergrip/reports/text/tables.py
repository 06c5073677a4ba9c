"""Small tables in plain text."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence


def table(header: Sequence[str], rows: Sequence[Sequence[str]], right: Sequence[int] = ()) -> str:
    """Return lines with aligned columns; the columns in `right` are aligned to the right."""
    lines = [list(header), *(list(row) for row in rows)]
    widths = [max(len(line[i]) for line in lines) for i in range(len(header))]

    def padded(line: Sequence[str]) -> str:
        cells = enumerate(zip(line, widths, strict=True))
        return "  ".join(cell.rjust(w) if i in right else cell.ljust(w) for i, (cell, w) in cells).rstrip()

    return "\n".join(padded(line) for line in lines)


def wrapped(label: str, text: str, width: int = 110) -> list[str]:
    """Return the text in lines of at most `width`, the first after the label, the others below the text."""
    return textwrap.wrap(text, width, initial_indent=label, subsequent_indent=" " * len(label))
