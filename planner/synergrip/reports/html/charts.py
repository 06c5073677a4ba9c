"""Lines over time as charts inside a page, each with a cursor that goes with the playback."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from synergrip.linalg import Array
from synergrip.reports.html.lines import Lines
from synergrip.reports.pictures.contact_colors import COLORS, contact_colors
from synergrip.reports.pictures.sheet import FAINT, INK, VERMILION, Sheet, no_noise, svg_text
from synergrip.reports.view.planned import thinned

WIDE, HIGH = 5.6, 1.9
LEFT, RIGHT, ABOVE, BELOW = 0.62, 0.12, 0.42, 0.36
"""Of a chart, and the room around its axes [inch]."""
NAMED = 5
"""Lines that have a colour and a name; the others are grey."""
FAR = 2.5
"""A bound more than this many times what lines come to is told, not drawn."""


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


def charts_of(times: Array, every: Sequence[Lines], missing: Sequence[tuple[float, float]] = ()) -> tuple[Chart, ...]:
    """Return lines over times (T,) as charts; the stretches that have no plan are shaded."""
    return tuple(_chart(times, lines, missing) for lines in every)


def _chart(times: Array, lines: Lines, missing: Sequence[tuple[float, float]]) -> Chart:
    shown = thinned(len(times))

    def fill(sheet: Sheet) -> None:
        label = f"{lines.title} [{lines.unit}]" if lines.unit else lines.title
        sheet.write(0.08, 0.18, label + _far(lines), 9.0)
        axes = sheet.chart(LEFT, ABOVE, WIDE - LEFT - RIGHT, HIGH - ABOVE - BELOW)
        _draw(axes, times[shown], lines, lines.values[shown])
        for begin, end in missing:
            axes.axvspan(begin, end, color=VERMILION, alpha=0.12, lw=0)

    sides = 100 * LEFT / WIDE, 100 * (1 - RIGHT / WIDE)
    return Chart(lines.title, svg_text(WIDE, HIGH, fill), *sides, float(times[0]), float(times[-1]))


def _draw(axes: Any, times: Array, lines: Lines, values: Array) -> None:
    if len(times) == 1:
        _bars(axes, lines, values[0])
        return
    for number in reversed(range(len(lines.names))):
        named = lines.of_contacts or number < NAMED
        color = _color(lines, number) if named else FAINT
        axes.plot(times, values[:, number], color=color, lw=1.5, label=lines.names[number] if named else None)
    for bound in _near(lines):
        axes.axhline(bound, color=INK, lw=1.0, ls=(0, (4, 3)), zorder=1)
    axes.set_xlim(times[0], times[-1])
    axes.set_xlabel("time [s]", fontsize=7.5, labelpad=1)
    handles, names = axes.get_legend_handles_labels()
    _finish(axes, lines)
    if names:
        axes.legend(
            handles[::-1], names[::-1], frameon=False, fontsize=6.5, ncols=min(len(names), 5), loc="lower right",
            bbox_to_anchor=(1.01, 0.97), borderaxespad=0.0, handlelength=1.1, columnspacing=0.9,
        )  # fmt: skip


def _bars(axes: Any, lines: Lines, values: Array) -> None:
    """Draw a single instant: a bar for each line, the first of them on top."""
    count = min(len(values), 12)
    colors = [_color(lines, i) if lines.of_contacts or i < NAMED else FAINT for i in range(count)]
    axes.barh(range(count)[::-1], values[:count], color=colors, height=0.7)
    axes.set_yticks(range(count)[::-1], [name[:24] for name in lines.names[:count]])
    for bound in _near(lines):
        axes.axvline(bound, color=INK, lw=1.0, ls=(0, (4, 3)), zorder=1)
    _finish(axes, lines)


def _finish(axes: Any, lines: Lines) -> None:
    axes.spines[["top", "right"]].set_visible(False)
    axes.tick_params(labelsize=7)
    no_noise(axes, lines.values)


def _near(lines: Lines) -> tuple[float, ...]:
    """Return the bounds that are near enough to be drawn."""
    reach = FAR * float(np.abs(lines.values).max(initial=0.0))
    return tuple(bound for bound in lines.bounds if abs(bound) <= reach)


def _far(lines: Lines) -> str:
    """Return the bounds that are not drawn, in words."""
    far = [bound for bound in lines.bounds if bound not in _near(lines)]
    if not far or lines.unit.startswith("%"):
        return ""
    both = len(far) == 2 and far[0] == -far[1]
    told = f"±{abs(far[0]):.4g}" if both else " and ".join(f"{bound:.4g}" for bound in far)
    return f", limit{'s' * (len(far) > 1)} {told} {lines.unit}".rstrip()


def _color(lines: Lines, number: int) -> str:
    return contact_colors(lines.names)[lines.names[number]] if lines.of_contacts else COLORS[number % len(COLORS)]
