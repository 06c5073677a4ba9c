"""A plan over time as a picture: one chart for each thing that is limited, each contact in its colour."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from synergrip.documents.quantities import plain
from synergrip.linalg import Array
from synergrip.planning.outcome import Plan
from synergrip.reports.pictures.layout import MARGIN
from synergrip.reports.pictures.line_chart import Box, draw_chart, head_of
from synergrip.reports.pictures.lines import Lines, plan_lines
from synergrip.reports.pictures.page import SPACE, Heading
from synergrip.reports.pictures.sheet import Sheet, write_picture

WIDE, HIGH = 4.3, 1.75
"""Of a chart [inch]."""
LEFT, BELOW, BETWEEN = 0.65, 0.38, 0.12
"""Room around it for its labels, and between two rows of charts [inch]."""


def draw_plan(plan: Plan, title: str, path: Path) -> None:
    """Draw what a plan does over time.

    Args:
        plan: verified.
        title: heading of the picture.
        path: ends in .svg, .png or .pdf.

    Raises:
        InputError: a suffix that says no format.
        OSError: the file cannot be written.
    """
    times, parts = plan.motion.times, plan_lines(plan)
    over = f" over {plain(times[-1] - times[0])} s" if len(times) > 1 else ""
    wanted = "strokes: where the object is wanted; " if over == "" else "where the object is wanted, and "
    under = f"smallest slip margin {plan.margins.min():.4g} N{over}; {'' if over == '' else 'dashed: '}{wanted}"
    draw_charts(parts, times, title, f"{under}{'dashed: limits' if over == '' else 'limits'}", path)


def draw_charts(parts: Sequence[Lines], times: Array, title: str, under: str, path: Path) -> None:
    """Draw charts over times (T,), two in a row, under a title and a line below it."""
    width = 2 * (LEFT + WIDE) + MARGIN
    heading = Heading.of(title, under, width)
    rows = [parts[first : first + 2] for first in range(0, len(parts), 2)]
    above = [BETWEEN + max(head_of(lines, times, WIDE) for lines in row) for row in rows]
    height = heading.height + BETWEEN + sum(above) + len(rows) * (HIGH + BELOW) + SPACE

    def fill(sheet: Sheet) -> None:
        heading.write(sheet)
        top = heading.height + BETWEEN
        for row, head in zip(rows, above, strict=True):
            for column, lines in enumerate(row):
                draw_chart(sheet, Box(LEFT + column * (LEFT + WIDE), top + head, WIDE, HIGH), times, lines)
            top += head + HIGH + BELOW

    write_picture(path, width, height, fill)
