"""What a picture for a paper is drawn on: its size, letters and title."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from synergrip.documents.judging import Arguments, described
from synergrip.errors import InputError
from synergrip.reports.pictures.sheet import DOTS_PER_INCH, Letters, picture_suffix

INCH, STANDARD = 25.4, 8.0
"""Millimetres of an inch, and the size of the letters for which pictures are laid out [points]."""
NARROWEST, WIDEST, SMALLEST, LARGEST, COARSEST, FINEST = 20.0, 2000.0, 3.0, 72.0, 30.0, 2400.0
"""Of widths and heights [mm], of letters [points], and of dots per inch."""


@dataclass(frozen=True)
class Paper:
    """Size, letters and title of a picture.

    Everything is laid out for letters of 8 points and then drawn as much larger as the letters are wanted; `wide` and
    `high` are lengths of that layout.
    """

    width_mm: float | None = None
    height_mm: float | None = None
    font: str = ""
    """A family that is installed, or one of serif, sans-serif, monospace."""
    font_size: float = STANDARD
    """Of axis labels [points]; other letters are in proportion."""
    title: str = ""
    dpi: float | None = None
    """Dots per inch of a PNG; those that are usual when None."""

    def __post_init__(self) -> None:
        """Judge the sizes."""
        judge = Arguments("")
        for name, least, most, unit in (
            ("width_mm", NARROWEST, WIDEST, "mm"), ("height_mm", NARROWEST, WIDEST, "mm"),
            ("font_size", SMALLEST, LARGEST, "points"), ("dpi", COARSEST, FINEST, "dots per inch"),
        ):  # fmt: skip
            if (given := getattr(self, name)) is not None or name == "font_size":
                value = judge.number(name, given, at_least=least, unit=unit)
                if value > most:
                    judge.refuse(name, f"must be {most:g} {unit} or less, got {value:g}")
        for name in ("font", "title"):
            if not isinstance(getattr(self, name), str):
                judge.refuse(name, f"expected a text, got {described(getattr(self, name))}")
        judge.finish()

    @property
    def letters(self) -> Letters:
        """Font, scale and dots."""
        return Letters(self.font, self.font_size / STANDARD, self.dpi or DOTS_PER_INCH)

    def wide(self, usual_mm: float) -> float:
        """Return the width of the layout [inch]: what is asked for, or what is usual."""
        return (self.width_mm or usual_mm) / INCH / self.letters.scale

    def high(self, usual: float, least: float) -> float:
        """Return the height of the layout [inch]: what is asked for or what is usual, if it is enough.

        Raises:
            InputError: less than the `least`.
        """
        if self.height_mm is None:
            return usual
        high = self.height_mm / INCH / self.letters.scale
        if high < least:
            needed = INCH * least * self.letters.scale
            message = f"{self.height_mm:g} mm leave no room for the drawing; give {needed:.0f} mm or more"
            raise InputError.at("height_mm", f"{message}, or smaller letters")
        return high

    def refuse_dpi(self, path: Path) -> None:
        """Refuse dots per inch where a picture is drawn in lines.

        Raises:
            InputError: some were given, for a file that is no PNG.
        """
        if self.dpi is not None and picture_suffix(path) != ".png":
            raise InputError.at("dpi", f"'{path}' has lines, no dots: leave it away, or write a .png")

    def refuse_height(self, what: str) -> None:
        """Refuse a height where it follows from the width.

        Raises:
            InputError: one was given.
        """
        if self.height_mm is not None:
            raise InputError.at("height_mm", f"the height of '{what}' follows from its width; leave it away")
