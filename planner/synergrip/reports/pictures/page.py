"""A whole picture: heading, columns of panels in blocks, footnotes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import chain
from pathlib import Path

from synergrip.reports.pictures.layout import MARGIN, Columns, fitted
from synergrip.reports.pictures.sheet import GREY, INK, USUAL, Letters, Sheet, write_picture

HEADING, UNDER, NOTE = 13.0, 10.0, 9.0
"""Sizes of the letters [points]."""
IN_PAPER = 9.5
"""Size of the title of a picture for a paper [points]: there it is a line above a chart, not the head of a page."""
LINE = 1.45 / 72
"""Distance of lines for each point of their letters [inch]."""
SPACE = 0.2  # [inch]


@dataclass(frozen=True)
class Heading:
    """Title and subtitle of a picture, in lines that fit."""

    lines: tuple[tuple[str, float], ...]
    """Each with the size of its letters."""

    @classmethod
    def of(cls, title: str, subtitle: str, width: float, size: float = HEADING) -> Heading:
        """Return the heading of a picture of `width` [inch], its title in letters of a size [points].

        An empty subtitle takes no room.
        """
        room = width - 2 * MARGIN
        lines = [(line, size) for line in fitted(title, room * 0.9, size)]  # bold letters are wider
        return cls((*lines, *((line, UNDER) for line in fitted(subtitle, room, UNDER))))

    @property
    def height(self) -> float:
        """With the space above it [inch]."""
        return SPACE + sum(LINE * size for _, size in self.lines)

    def write(self, sheet: Sheet) -> None:
        """Write it at the top of the sheet."""
        top = SPACE
        for line, size in self.lines:
            top += LINE * size
            title = size != UNDER
            sheet.write(MARGIN, top, line, size, INK if title else GREY, bold=title)


@dataclass(frozen=True)
class Foot:
    """What stands below the panels, over the whole width."""

    height: float  # [inch]
    draw: Callable[[Sheet, float], None]
    """Draws it below so much from the top [inch]."""


@dataclass(frozen=True)
class Page:
    """What stands around the panels."""

    title: str
    subtitle: str
    columns: Columns
    block: float
    """Height of a block of panels [inch]."""
    notes: tuple[str, ...]
    foot: Foot | None = None
    """What stands between the panels and the notes."""
    letters: Letters = USUAL

    def write(self, path: Path, draw: Callable[[Sheet, int, float, float], None]) -> None:
        """Write the picture; `draw` draws the column of an index at so much from the left and from the top [inch].

        Raises:
            InputError: a suffix that says no format.
            OSError: the file cannot be written.
        """
        room = self.columns.width - 2 * MARGIN
        heading = Heading.of(self.title, self.subtitle, self.columns.width)
        notes = list(chain.from_iterable(fitted(note, room, NOTE) for note in self.notes))
        head, foot = heading.height, self.foot.height if self.foot else 0.0
        below = head + SPACE + self.columns.blocks * (self.block + SPACE)
        height = below + foot + LINE * NOTE * len(notes) + SPACE

        def fill(sheet: Sheet) -> None:
            heading.write(sheet)
            for index in range(self.columns.count):
                row, left = self.columns.place(index)
                draw(sheet, index, left, head + SPACE + row * (self.block + SPACE))
            if self.foot:
                self.foot.draw(sheet, below)
            for number, line in enumerate(reversed(notes)):
                sheet.write(MARGIN, height - SPACE - LINE * NOTE * number, line, NOTE, GREY)

        write_picture(path, self.columns.width, height, fill, self.letters)
