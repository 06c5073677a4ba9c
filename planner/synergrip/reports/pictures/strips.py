"""A sheet of strips below each other, each as wide as the sheet with a title of its own."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from synergrip.reports.pictures.layout import MARGIN, fitted
from synergrip.reports.pictures.page import LINE, SPACE, UNDER, Heading
from synergrip.reports.pictures.sheet import Sheet, write_picture

WIDTH, LEFT = 9.0, 0.75
"""Of the sheet, and the room left of a chart for its labels [inch]."""


@dataclass(frozen=True)
class Strip:
    """A part of the sheet, over its whole width."""

    title: str
    height: float  # [inch]
    draw: Callable[[Sheet, float], None]
    """Draws it below so much from the top [inch]."""

    @property
    def lines(self) -> list[str]:
        """Its title, in lines that fit."""
        return fitted(self.title, WIDTH - 2 * MARGIN, UNDER)


def write_strips(path: Path, title: str, under: str, strips: Sequence[Strip]) -> None:
    """Write a picture of strips under a title and a line below it.

    Raises:
        InputError: a suffix that says no format.
        OSError: the file cannot be written.
    """
    heading, line = Heading.of(title, under, WIDTH), LINE * UNDER
    heights = [line * len(strip.lines) + strip.height + SPACE for strip in strips]

    def fill(sheet: Sheet) -> None:
        heading.write(sheet)
        top = heading.height + SPACE
        for strip, height in zip(strips, heights, strict=True):
            for number, text in enumerate(strip.lines, start=1):
                sheet.write(MARGIN, top + number * line - 0.03, text, UNDER)
            strip.draw(sheet, top + len(strip.lines) * line)
            top += height

    write_picture(path, WIDTH, heading.height + SPACE + sum(heights), fill)


def plain(axes: Any, across: str, up: str) -> None:
    """Give a chart its labels, and leave away its frame."""
    axes.spines[["top", "right"]].set_visible(False)
    axes.tick_params(labelsize=8)
    axes.set_xlabel(across, fontsize=8)
    axes.set_ylabel(up, fontsize=8)
