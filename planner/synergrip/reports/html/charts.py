"""Lines over time as charts inside a page, each with a cursor that goes with the playback."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from synergrip.linalg import Array
from synergrip.reports.pictures.line_chart import Box, draw_chart, head_of
from synergrip.reports.pictures.lines import Lines
from synergrip.reports.pictures.sheet import Sheet, svg_text
from synergrip.reports.view.planned import thinned

WIDE, HIGH = 5.6, 1.15
"""Of a chart with its labels, and of its axes [inch]."""
LEFT, RIGHT, ABOVE, BELOW = 0.62, 0.2, 0.04, 0.36
"""Room around its axes, and above its title [inch]."""


@dataclass(frozen=True)
class Chart:
    """A chart inside a page."""

    title: str
    svg: str
    left: float
    right: float
    """Where its first and last instant are, in percent of its width."""
    start: float
    end: float
    """[s] These instants."""
    last: float
    """[s] until when the lines are known."""


def charts_of(
    times: Array, every: Sequence[Lines], missing: Sequence[tuple[float, float]] = (), end: float | None = None
) -> tuple[Chart, ...]:
    """Return lines over times (T,) as charts.

    Args:
        times: at which the lines are known [s].
        every: the lines.
        missing: the stretches that have no plan [s], which are shaded.
        end: of the task [s], where the lines end before it.
    """
    return tuple(_chart(times, lines, missing, times[-1] if end is None else end) for lines in every)


def _chart(times: Array, lines: Lines, missing: Sequence[tuple[float, float]], end: float) -> Chart:
    shown, wide = thinned(len(times)), WIDE - LEFT - RIGHT
    top = ABOVE + head_of(lines, times, wide)

    def fill(sheet: Sheet) -> None:
        some = replace(lines, values=lines.values[shown], target=None if lines.target is None else lines.target[shown])
        axes = draw_chart(sheet, Box(LEFT, top, wide, HIGH), times[shown], some, missing=missing, title_left=0.08)
        if len(times) > 1:
            axes.set_xlim(times[0], end)

    sides = 100 * LEFT / WIDE, 100 * (1 - RIGHT / WIDE)
    return Chart(
        lines.title, svg_text(WIDE, top + HIGH + BELOW, fill), *sides, float(times[0]), float(end), float(times[-1])
    )  # fmt: skip
