"""The key of a chart: names beside a stroke of their colour, in as many rows as it takes."""

from __future__ import annotations

from dataclasses import dataclass

from synergrip.reports.pictures.layout import LETTERS
from synergrip.reports.pictures.sheet import Sheet

SIZE, ROW, STROKE, APART = 7.0, 0.145, 0.16, 0.14
"""Size of the letters [points], height of a row, length of a stroke, and room between two names [inch]."""
LONGEST = 32
"""Letters of a name that are shown."""


@dataclass(frozen=True)
class Key:
    """Names with their colours, in a width [inch]."""

    entries: tuple[tuple[str, str], ...]
    width: float

    @property
    def rows(self) -> list[list[tuple[float, str, str]]]:
        """The entries of each row, with how far from the left they begin [inch]."""
        rows: list[list[tuple[float, str, str]]] = [[]]
        left = 0.0
        for name, color in self.entries:
            text = name if len(name) <= LONGEST else f"{name[: LONGEST - 1]}…"
            room = STROKE + 0.05 + (len(text) + 1) * 0.96 * SIZE / LETTERS + APART
            if rows[-1] and left + room - APART > self.width:
                rows.append([])
                left = 0.0
            rows[-1].append((left, text, color))
            left += room
        return rows

    @property
    def height(self) -> float:
        """[inch]."""
        return ROW * len(self.rows) + 0.05

    def draw(self, sheet: Sheet, left: float, top: float) -> None:
        """Draw it below so much from the top."""
        for number, row in enumerate(self.rows):
            base = top + ROW * (number + 0.72)
            for start, text, color in row:
                begin = left + start
                sheet.stroke((begin, base - 0.035), (begin + STROKE, base - 0.035), color, 2.2)
                sheet.write(begin + STROKE + 0.05, base, text, SIZE)
