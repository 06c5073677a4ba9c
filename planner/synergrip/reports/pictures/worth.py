"""What changes are worth, as bars: how much each adds to a slip margin, the most on top."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from synergrip.margin.sensitivity.sensitivity import Sensitivities, Sensitivity
from synergrip.reports.pictures.line_chart import LETTER, TITLE, Box
from synergrip.reports.pictures.sheet import INK, Sheet, svg_text
from synergrip.reports.pictures.strips import plain
from synergrip.reports.text.text_sensitivities import change_of

BARS, BAR = 6, 0.21
"""How many are drawn of a margin, and the height of each [inch]."""
MOST_LETTERS = 48
"""Of a name beside a bar; what is longer is cut."""
TICK = 0.65
"""Least distance of two numbers below the axis [inch]."""
WIDE, ABOVE, BELOW, RIGHT = 5.6, 0.3, 0.42, 0.15
"""Of a picture inside a page, and the room around its axes, that for its title above them [inch]."""


def worth_bars(found: Sensitivities, kind: str) -> tuple[Sensitivity, ...]:
    """Return the changes that add most to a margin, none where there is no such margin."""
    return found.worth_most(kind, BARS) if found.margins[kind] is not None else ()


def draw_worth(sheet: Sheet, box: Box, bars: Sequence[Sensitivity], colors: str | Sequence[str] = INK) -> Any:
    """Draw what changes add, with their names left of the box, and return the axes."""
    axes = sheet.chart(box.left, box.top, box.width, box.height)
    places = np.arange(len(bars))[::-1]
    axes.barh(places, [each.gain for each in bars], color=colors, height=0.7)
    axes.set_yticks(places, [_shortened(change_of(each)) for each in bars])
    axes.set_ylim(-0.6, len(bars) - 0.4)
    plain(axes, "adds to the slip margin [N]", "")
    axes.locator_params(axis="x", nbins=max(2, int(box.width / TICK)))
    axes.tick_params(axis="y", length=0)
    return axes


def worth_svg(title: str, bars: Sequence[Sensitivity]) -> str:
    """Return the same under a title as an SVG element inside a page."""
    left = 0.15 + 0.95 * LETTER * max(len(_shortened(change_of(each))) for each in bars)
    high = BAR * len(bars)

    def fill(sheet: Sheet) -> None:
        sheet.write(0.08, ABOVE - 0.12, title, TITLE)
        draw_worth(sheet, Box(left, ABOVE, WIDE - left - RIGHT, high), bars)

    return svg_text(WIDE, ABOVE + high + BELOW, fill)


def _shortened(name: str) -> str:
    """Return a name that fits beside its bar: its end says what changes, and its start of what."""
    half = MOST_LETTERS // 2
    return name if len(name) <= MOST_LETTERS else f"{name[:half]}…{name[1 - half :]}"
