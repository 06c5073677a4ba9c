"""A chart of lines over time with their limits, or of bars where there is a single instant; with a title and a key."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from synergrip.linalg import Array
from synergrip.reports.pictures.contact_colors import contact_colors
from synergrip.reports.pictures.key import Key
from synergrip.reports.pictures.limits_drawn import draw_bounds
from synergrip.reports.pictures.lines import Lines
from synergrip.reports.pictures.sheet import FAINT, INK, VERMILION, Sheet, no_noise

OTHERS = ("#393b79", "#8c6d31", "#7b4173", "#637939", "#843c39")
"""Colours of lines that are not those of contacts, which none of these has."""
MOST_BARS, LETTER = 12, 0.066
"""How many bars are drawn, and the width of a letter beside them [inch]."""
TITLE, LABEL, TICKS = 9.5, 8.0, 7.5
"""Sizes of letters [points]."""
HEAD = 0.2
"""Height of a title [inch]."""
WIDEST, THINNEST = 3.4, 1.2
"""Of the first line and of the last [points]: of lines on each other all are seen."""
BELOW_ZERO = 0.04
"""Room beyond 0 where a chart shows it, as a share of the rest: lines on 0 are seen."""
DASHED = (0, (4, 3))


@dataclass(frozen=True)
class Box:
    """Where axes are on a sheet, from its top left corner [inch]."""

    left: float
    top: float
    width: float
    height: float


def key_of(lines: Lines, width: float) -> Key:
    """Return the names of the lines with their colours, in rows that fit into a width [inch]."""
    entries = list(zip(lines.names, _colors(lines), strict=True))
    named = [entry for entry in entries if entry[1] != FAINT]
    if rest := len(entries) - len(named):
        named.append((f"{rest} other{'s' * (rest > 1)}", FAINT))
    return Key(tuple(named), width)


def head_of(lines: Lines, times: Array, width: float, *, key: bool = True) -> float:
    """Return the room that title and key take above the axes [inch]; bars have their names beside them."""
    return HEAD + (key_of(lines, width).height if key and len(times) > 1 else 0.0)


def draw_chart(
    sheet: Sheet, box: Box, times: Array, lines: Lines, *, missing: Sequence[tuple[float, float]] = (),
    title_left: float | None = None, label: bool = True, key: bool = True,
) -> Any:  # fmt: skip
    """Draw lines over times (T,) with what stands above them, and return the axes.

    Args:
        sheet: where.
        box: of the axes.
        times: of the knots [s].
        lines: what is drawn.
        missing: stretches of time that have no plan.
        title_left: where the title begins [inch]; above the axes without it.
        label: whether there is a title above the axes.
        key: whether the names of the lines are told.
    """
    single, names = len(times) == 1, key_of(lines, box.width)
    if label:
        above = box.top - (names.height if key and not single else 0.0) - 0.08
        some = f", the first {MOST_BARS} of {len(lines.names)}" if single and len(lines.names) > MOST_BARS else ""
        sheet.write(box.left if title_left is None else title_left, above, lines.label + some, TITLE)
    if single:
        return _bars(sheet, box, lines)
    if key:
        names.draw(sheet, box.left, box.top - names.height)
    axes = sheet.chart(box.left, box.top, box.width, box.height)
    _lines(axes, times, lines, sheet.scale)
    for begin, end in missing:
        axes.axvspan(begin, end, color=VERMILION, alpha=0.12, lw=0)
    axes.set_xlim(times[0], times[-1])
    axes.set_xlabel("time [s]", fontsize=LABEL * sheet.scale, labelpad=1)
    _finish(axes, lines, sheet)
    _from_zero(axes, lines)
    draw_bounds(axes, lines, sheet.scale, upright=True)
    return axes


def _lines(axes: Any, times: Array, lines: Lines, scale: float) -> None:
    colors, marker = _colors(lines), "o" if len(times) < 4 else None
    named = sum(color != FAINT for color in colors)
    widths = [*np.linspace(WIDEST, THINNEST, named)] if named > 1 else [1.8]
    for number, (name, color) in enumerate(zip(lines.names, colors, strict=True)):
        thick = THINNEST if color == FAINT else widths[number]
        near = 2 if color == FAINT else 3 + number / len(colors)
        axes.plot(times, lines.values[:, number], color=color, lw=scale * thick, label=name, zorder=near,
                  marker=marker, ms=4 * scale, solid_joinstyle="round")  # fmt: skip
        if lines.target is not None:
            axes.plot(times, lines.target[:, number], color=color, lw=scale, ls=DASHED, zorder=2)
        for level in _own(lines, number) if color != FAINT else ():
            axes.axhline(level, color=color, lw=scale, ls=DASHED, zorder=1)


def _bars(sheet: Sheet, box: Box, lines: Lines) -> Any:
    """Draw a single instant: a bar for each line, the first of them on top, their names beside them."""
    count = min(len(lines.names), MOST_BARS)
    names = [name if len(name) <= 24 else f"{name[:23]}…" for name in lines.names[:count]]
    beside = max(0.0, LETTER * max(map(len, names)) - 0.5)
    axes = sheet.chart(box.left + beside, box.top, box.width - beside, box.height)
    places, colors = np.arange(count)[::-1], _colors(lines)[:count]
    axes.barh(places, lines.values[0, :count], color=colors, height=min(0.7, 0.2 * count))
    if lines.target is not None:
        axes.plot(lines.target[0, :count], places, ls="none", marker="|", ms=9 * sheet.scale, color=INK)
    axes.set_yticks(places, names)
    axes.set_ylim(-0.6, count - 0.4)
    axes.tick_params(axis="y", length=0)
    _finish(axes, lines, sheet)
    draw_bounds(axes, lines, sheet.scale, upright=False)
    return axes


def _finish(axes: Any, lines: Lines, sheet: Sheet) -> None:
    axes.spines[["top", "right"]].set_visible(False)
    axes.tick_params(labelsize=TICKS * sheet.scale)
    no_noise(axes, lines.values, lines.unit)


def _from_zero(axes: Any, lines: Lines) -> None:
    """Let a chart of margins or forces of contacts show 0: a change of a thousandth of them must not fill it."""
    if lines.of_contacts and lines.unit == "N":
        low, high = axes.get_ylim()
        room = BELOW_ZERO * max(high, -low)
        if low > -room:  # and as much at the other end, where autoscaling has left next to nothing
            axes.set_ylim(-room, high + room)
        elif high < room:
            axes.set_ylim(low - room, room)


def _own(lines: Lines, number: int) -> Iterator[float]:
    """Yield the bounds of one line alone."""
    if lines.own is not None:
        yield from (float(level) for level in lines.own[:, number] if np.isfinite(level))


def _colors(lines: Lines) -> list[str]:
    """Return the colour of each line; those of no contact that come least near to a bound are grey."""
    if lines.of_contacts:
        return list(contact_colors(lines.names).values())
    rest = len(lines.names) - len(OTHERS)
    return [*OTHERS[: len(lines.names)], *([FAINT] * rest)]
