"""The sheet of paper: panels with equal scales, and the file it is written to. The only module that imports matplotlib.

The same values give the same bytes: no date, no random names, no settings of the user.
"""

from __future__ import annotations

import io
import re
import unicodedata
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from synergrip.errors import InputError, one_of, suggest
from synergrip.files import atomic_path
from synergrip.linalg import Array

SUFFIXES = (".svg", ".png", ".pdf")
INK, GREY, FAINT = "#222222", "#767676", "#c4c4c4"
BLUE, SKY, VERMILION, GREEN = "#0072b2", "#8cc8ec", "#d55e00", "#009e73"
"""Colours that stay apart for the colour-blind (Okabe and Ito)."""
SETTINGS = {"svg.hashsalt": "synergrip", "svg.fonttype": "none", "pdf.fonttype": 42, "text.parse_math": False}
NO_DATE: dict[str, dict[str, Any]] = {
    ".svg": {"Date": None, "Creator": None}, ".png": {"Software": None}, ".pdf": {"CreationDate": None}
}  # fmt: skip
DOTS_PER_INCH, MOST_DOTS = 160.0, 1e8
"""Of a PNG where nothing else is asked for; and the most that it may have in all."""
_PATH, _FINER = re.compile(r' d="[^"]*"'), re.compile(r"(\.\d\d)\d+")
"""The way of a line, and the digits of its places [points] beyond those that are seen."""
_FONTS, _INDENT = re.compile(r"(<text style=\"[^\"]*'DejaVu Sans', )[^;\"]*(?=sans-serif)"), re.compile(r"\n\s*(?=<)")
"""What each text repeats of fonts that few have, and the room before tags: a fifth of a page's pictures."""
LEAST = {"mm": 0.01, "deg": 0.01, "N": 1e-3, "% of limit": 0.1, "% of its range": 0.1}
"""What is less than this from top to bottom is no motion, force or share that anybody means."""


def picture_suffix(path: Path, key: str = "") -> str:
    """Return the suffix of a picture file or raise an `InputError` at `key` that lists the suffixes."""
    suffix = path.suffix.lower()
    if suffix not in SUFFIXES:
        raise InputError.at(key, f"the suffix of '{path}' says no format: {one_of(suffix, SUFFIXES)}")
    return suffix


@dataclass(frozen=True)
class Letters:
    """The letters of a picture, and how large it is drawn."""

    font: str = ""
    """A family that is installed; that of matplotlib when empty."""
    scale: float = 1.0
    """Of all letters, strokes and lengths: a sheet of 4 inches is one of 4 times this on paper."""
    dpi: float = DOTS_PER_INCH
    """Dots per inch of a PNG."""


USUAL = Letters()
SIZES = {"font.size": 10.0, "axes.linewidth": 0.8, "xtick.major.size": 3.5, "ytick.major.size": 3.5,
         "xtick.major.width": 0.8, "ytick.major.width": 0.8, "xtick.major.pad": 3.5, "ytick.major.pad": 3.5,
         "axes.labelpad": 4.0}  # fmt: skip
"""What matplotlib takes for itself [points]."""


@dataclass(frozen=True)
class Panel:
    """One drawing on the sheet, in the units of what is drawn, equal in both directions."""

    axes: Any
    """`matplotlib.axes.Axes`."""
    scale: float = 1.0
    """Of letters and strokes."""

    def strokes(
        self, lines: Sequence[Array], color: str, width: float, near: float = 1.0, dashed: bool = False
    ) -> None:
        """Draw polylines, each (n, 2); what has the larger `near` covers the other. Width in points."""
        style = (0, (4, 3)) if dashed else "solid"
        for line in lines:
            self.axes.plot(*line.T, color=color, lw=self.scale * width, ls=style, zorder=near,
                           solid_capstyle="round", solid_joinstyle="round")  # fmt: skip

    def area(self, polygon: Array, color: str, opacity: float, near: float = 1.0) -> None:
        """Fill a polygon (n, 2)."""
        self.axes.fill(*polygon.T, color=color, alpha=opacity, zorder=near, lw=0, clip_on=False)

    def dots(self, points: Array, color: str, size: float, near: float = 1.0, edge: float = 0.0) -> None:
        """Draw points (n, 2) as discs of a diameter in points, with a white edge."""
        self.axes.plot(*points.T, ls="none", marker="o", ms=self.scale * size, mfc=color, mec="white",
                       mew=self.scale * edge, zorder=near)  # fmt: skip

    def outlined(self, point: Array, color: str, size: float, near: float = 1.0, square: bool = False) -> None:
        """Draw a ring, or a square, around a point (2,), white inside; the size is in points."""
        self.axes.plot(*point, ls="none", marker="s" if square else "o", ms=self.scale * size, mfc="white", mec=color,
                       mew=1.1 * self.scale, zorder=near)  # fmt: skip

    def cross(self, point: Array, color: str, near: float = 1.0) -> None:
        """Mark a point (2,)."""
        self.axes.plot(*point, ls="none", marker="+", ms=9 * self.scale, mec=color, mew=1.2 * self.scale,
                       zorder=near)  # fmt: skip

    def arrows(self, points: Array, vectors: Array, color: str | Sequence[str], near: float = 10.0,
               thick: float = 0.028) -> None:  # fmt: skip
        """Draw arrows from points (n, 2), as long as their vectors (n, 2), in one colour or one for each."""
        size = {"angles": "xy", "scale_units": "xy", "scale": 1.0, "units": "inches"}
        head = {"headwidth": 4.2, "headlength": 5.0, "headaxislength": 4.5, "minlength": 0.5}
        self.axes.quiver(*points.T, *vectors.T, color=color, zorder=near, width=thick * self.scale, **size, **head)

    def note(self, point: Array, text: str, color: str = GREY, across: str = "center", bold: bool = False) -> None:
        """Write small lines at a point (2,), by default around it."""
        lines, weight = "\n".join(map(readable, text.split("\n"))), "bold" if bold else "normal"
        self.axes.text(*point, lines, color=color, ha=across, va="center", fontsize=8 * self.scale, zorder=2e3,
                       weight=weight)  # fmt: skip


@dataclass(frozen=True)
class Sheet:
    """A figure of a given size; places are in inches from its top left corner."""

    width: float  # [inch]
    height: float  # [inch]
    figure: Any = field(repr=False)
    """`matplotlib.figure.Figure`."""
    scale: float = 1.0
    """Of letters and strokes; all lengths here are those of a sheet at scale 1."""

    def panel(self, left: float, top: float, width: float, height: float, middle: Array, span: float) -> Panel:
        """Return a panel that shows what lies around `middle` (2,), `span` from left to right."""
        axes = self.figure.add_axes(self._box(left, top, width, height))
        half = np.array([span, span * height / width]) / 2
        axes.set(xlim=(middle[0] - half[0], middle[0] + half[0]), ylim=(middle[1] - half[1], middle[1] + half[1]))
        axes.set_axis_off()
        return Panel(axes, self.scale)

    def chart(self, left: float, top: float, width: float, height: float) -> Any:
        """Return axes with ticks, for a diagram."""
        return self.figure.add_axes(self._box(left, top, width, height))

    def write(self, left: float, top: float, text: str, size: float = 10.0, color: str = INK, across: str = "left",
              bold: bool = False) -> None:  # fmt: skip
        """Write a line of text, its baseline at `top`; control characters are left out."""
        weight = "bold" if bold else "normal"
        self.figure.text(left / self.width, 1 - top / self.height, readable(text), size=self.scale * size, color=color,
                         ha=across, va="baseline", weight=weight)  # fmt: skip

    def stroke(self, start: tuple[float, float], end: tuple[float, float], color: str, width: float) -> None:
        """Draw a line from one place to another."""
        from matplotlib.lines import Line2D

        x, y = zip(*((left / self.width, 1 - top / self.height) for left, top in (start, end)), strict=True)
        self.figure.add_artist(Line2D(x, y, color=color, lw=self.scale * width, solid_capstyle="butt"))

    def _box(self, left: float, top: float, width: float, height: float) -> tuple[float, float, float, float]:
        bottom = self.height - top - height
        return left / self.width, bottom / self.height, width / self.width, height / self.height


def readable(text: str) -> str:
    """Return a text without what no picture file may hold: control characters, half and no characters (U+FFFF)."""
    return "".join(c for c in text if unicodedata.category(c) not in ("Cc", "Cs") and ord(c) & 0xFFFE != 0xFFFE)


def no_noise(axes: Any, values: Array, unit: str = "") -> None:
    """Keep rounding from filling a diagram of values that hardly move; ticks stand for what they say."""
    axis, (low, high) = (axes.yaxis, axes.get_ylim()) if len(values) > 1 else (axes.xaxis, axes.get_xlim())
    room = max(LEAST.get(unit, 0.0), 1e-6 * max(1.0, float(np.nanmax(np.abs(values), initial=0.0))))
    if high - low < room:
        middle, half = float(np.nanmean(values)), 5 * LEAST.get(unit, 0.2)
        (axes.set_ylim if len(values) > 1 else axes.set_xlim)(middle - half, middle + half)
    formatter = axis.get_major_formatter()
    if hasattr(formatter, "set_useOffset"):
        formatter.set_useOffset(False)
        formatter.set_scientific(False)


def write_picture(
    path: Path, width: float, height: float, draw: Callable[[Sheet], None], letters: Letters = USUAL
) -> None:
    """Write a picture of `width` x `height` inches, whole or not at all.

    Args:
        path: ends in one of `SUFFIXES`.
        width: [inch].
        height: [inch].
        draw: draws on the empty sheet.
        letters: in which it is written.

    Raises:
        InputError: a suffix that says no format, a font that is not installed, or a PNG of more dots than `MOST_DOTS`.
        OSError: the file cannot be written.
    """
    suffix = picture_suffix(path)
    if suffix == ".png":
        _refuse_too_many(width * letters.scale * letters.dpi, height * letters.scale * letters.dpi)
    with _drawn(width, height, draw, letters) as figure, atomic_path(path) as temporary:
        figure.savefig(temporary, format=suffix[1:], dpi=letters.dpi, metadata=NO_DATE[suffix])


def _refuse_too_many(across: float, down: float) -> None:
    if across * down > MOST_DOTS:
        message = (
            f"a picture of {across:.0f} x {down:.0f} dots has more than {MOST_DOTS:.0g}; give fewer, or a smaller size"
        )
        raise InputError.at("dpi", message)


def svg_text(width: float, height: float, draw: Callable[[Sheet], None], letters: Letters = USUAL) -> str:
    """Return a picture of `width` x `height` inches as the text of an SVG element, to stand inside a page."""
    stream = io.StringIO()
    with _drawn(width, height, draw, letters) as figure:
        figure.savefig(stream, format="svg", metadata=NO_DATE[".svg"])
    text = stream.getvalue()
    text = _INDENT.sub("", _FONTS.sub(r"\1'Verdana', ", text[text.index("<svg") :]))
    return _PATH.sub(lambda found: _FINER.sub(r"\1", found[0]), text)


@contextmanager
def _drawn(width: float, height: float, draw: Callable[[Sheet], None], letters: Letters) -> Iterator[Any]:
    """Draw a figure, whatever the settings of the user are, and hold these off until it is saved."""
    import matplotlib
    from matplotlib.figure import Figure

    with matplotlib.rc_context(), warnings.catch_warnings():
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(SETTINGS | {key: letters.scale * size for key, size in SIZES.items()})
        if letters.font:
            matplotlib.rcParams["font.family"] = [_installed(letters.font)]
        figure = Figure(figsize=(letters.scale * width, letters.scale * height), facecolor="white")
        draw(Sheet(width, height, figure, letters.scale))
        warnings.filterwarnings("ignore", "Glyph .* missing")  # a title in letters that the font does not have
        yield figure


def _installed(font: str) -> str:
    """Return the name of a font or refuse one that is not there, which would be drawn in another."""
    from matplotlib import font_manager

    names = sorted({each.name for each in font_manager.fontManager.ttflist} | set(font_manager.font_family_aliases))
    found = {name.casefold(): name for name in names}.get(font.casefold())
    if found is None:
        near = suggest(font, names)
        families = "serif, sans-serif, monospace"
        raise InputError.at("font", f"no font '{font}' is installed{near}; give one that is, or {families}")
    return found
