"""A plan over time as a picture: one chart for each thing that is limited, its worst lines in colour."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from synergrip.linalg import Array
from synergrip.planning.outcome import Plan
from synergrip.reports.pictures.courses import Chart, charts
from synergrip.reports.pictures.layout import MARGIN
from synergrip.reports.pictures.page import SPACE, UNDER, Heading
from synergrip.reports.pictures.sheet import BLUE, FAINT, GREEN, INK, VERMILION, Sheet, no_noise, write_picture

WIDE, HIGH = 4.3, 1.75
"""Of a chart [inch]."""
LEFT, ABOVE, BELOW = 0.65, 0.45, 0.35
"""Room around it for its labels [inch]."""
COLORS = (VERMILION, BLUE, GREEN)
"""Of the lines nearest to a bound; the others are grey."""


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
    under = f"smallest slip margin {plan.margins.min():.4g} N over {plan.motion.times[-1]:.4g} s; dashed: where a line "
    draw_charts(charts(plan), plan.motion.times, title, f"{under}is wanted, and limits", path)


def draw_charts(parts: Sequence[Chart], times: Array, title: str, under: str, path: Path) -> None:
    """Draw charts over times (T,), two in a row, under a title and a line below it."""
    width = 2 * (LEFT + WIDE) + MARGIN
    heading = Heading.of(title, under, width)
    head, block = heading.height, ABOVE + HIGH + BELOW

    def fill(sheet: Sheet) -> None:
        heading.write(sheet)
        for index, chart in enumerate(parts):
            row, column = divmod(index, 2)
            left, above = LEFT + column * (LEFT + WIDE), head + row * block + ABOVE
            sheet.write(left, above - 0.1, chart.label, UNDER)
            axes = sheet.chart(left, above, WIDE, HIGH)
            _draw(axes, times, chart)
            if index >= len(parts) - 2:
                axes.set_xlabel("time [s]", fontsize=8)

    write_picture(path, width, head + block * (1 + (len(parts) - 1) // 2) + SPACE, fill)


def _draw(axes: Any, times: np.ndarray, chart: Chart) -> None:
    marker = "o" if len(times) == 1 else None
    for number in reversed(range(len(chart.names))):
        color = COLORS[number] if number < len(COLORS) else FAINT
        name = chart.names[number] if number < len(COLORS) else None
        axes.plot(times, chart.values[:, number], color=color, lw=1.6, marker=marker, label=name, zorder=3)
        if chart.target is not None:
            axes.plot(times, chart.target[:, number], color=color, lw=1.0, ls=(0, (4, 3)), zorder=2)
    for bound in chart.bounds:
        axes.axhline(bound, color=INK, lw=1.0, ls=(0, (4, 3)), zorder=1)
    axes.spines[["top", "right"]].set_visible(False)
    axes.tick_params(labelsize=8)
    if len(times) > 1:
        axes.set_xlim(times[0], times[-1])  # the same in all charts, also where a line ends before
    else:
        axes.margins(x=0.1)
    no_noise(axes, chart.values)
    handles, names = axes.get_legend_handles_labels()
    axes.legend(handles[::-1], names[::-1], frameon=False, fontsize=7, ncols=3, loc="lower right",
                bbox_to_anchor=(1.02, 0.97), borderaxespad=0.0, handlelength=1.2, columnspacing=1.0)  # fmt: skip
