"""Limits of a chart: where they are, or beyond a break of the axis where they are far from all lines."""

from __future__ import annotations

from typing import Any

import numpy as np

from synergrip.reports.pictures.lines import PERCENT, Lines
from synergrip.reports.pictures.sheet import INK

FAR = 2.5
"""A bound more than this many times what lines come to is drawn beyond a break of the axis."""
BEYOND = 0.26
"""The room beyond the break, as a share of what is before it."""
SIZE = 6.5
"""Of the letters at a bound [points]."""
DASHED = (0, (4, 3))
OVER = 4.5
"""Bounds near the lines are drawn over them: what lies on a bound must not hide it."""


def draw_bounds(axes: Any, lines: Lines, scale: float, upright: bool) -> None:
    """Draw the bounds of lines; those far away are told at a break of the axis of values.

    Args:
        axes: `matplotlib.axes.Axes`, whose lines are drawn.
        lines: with their bounds.
        scale: of letters and strokes.
        upright: whether values go up, else from left to right.
    """
    stroke = axes.axhline if upright else axes.axvline
    get, put = (axes.get_ylim, axes.set_ylim) if upright else (axes.get_xlim, axes.set_xlim)
    low, high = get()
    near, low_far, high_far = apart(lines, low, high)
    for level in near:
        stroke(level, color=INK, lw=scale, ls=DASHED, zorder=OVER)
    if low_far is None and high_far is None:
        return
    low, high = get()
    ticks = [tick for tick in (axes.get_yticks() if upright else axes.get_xticks()) if low <= tick <= high]
    room = BEYOND * (high - low)
    ends = (low - room * (low_far is not None), high + room * (high_far is not None))
    put(*ends)
    (axes.set_yticks if upright else axes.set_xticks)(ticks)
    for bound, end, edge in ((low_far, ends[0], low), (high_far, ends[1], high)):
        if bound is not None:
            _beyond(axes, lines.unit, bound, end, edge, scale, upright)


def apart(
    lines: Lines, low: float = np.inf, high: float = -np.inf
) -> tuple[tuple[float, ...], float | None, float | None]:
    """Return the bounds near the lines, and those far below and far above; of percent only on a side that is used.

    Args:
        lines: with their bounds.
        low: the axis begins here at most.
        high: the axis ends here at least.
    """
    values = lines.values[np.isfinite(lines.values)]
    if not values.size:
        return lines.bounds, None, None
    reach = FAR * float(np.abs(values).max())
    near = tuple(bound for bound in lines.bounds if abs(bound) <= reach or low <= bound <= high)
    far = [bound for bound in lines.bounds if bound not in near]
    sides = [bound for bound in far if lines.bounds != PERCENT or bound * values.min() > 0 or bound * values.max() > 0]
    sides = sides or far[-1:]
    below, above = [b for b in sides if b < values.min()], [b for b in sides if b > values.max()]
    return near, max(below, default=None), min(above, default=None)


def on_paper(scale: float) -> dict[str, Any]:
    """Return what keeps words clear of the strokes that cross them: paper below, axes and lines above."""
    return {"bbox": {"facecolor": "white", "edgecolor": "none", "pad": 0.8 * scale}, "zorder": 2.2}


def _beyond(axes: Any, unit: str, bound: float, end: float, edge: float, scale: float, upright: bool) -> None:
    """Draw one bound between the end of the axis and its edge before, where the axis is broken."""
    at, middle = edge + 0.55 * (end - edge), edge + 0.22 * (end - edge)
    word = f"limit {bound:.4g}{'%' if unit.startswith('%') else f' {unit}'.rstrip()}".replace("-", "−")
    letters = {"textcoords": "offset points", "va": "bottom", "fontsize": SIZE * scale, "color": INK, **on_paper(scale)}
    if upright:
        across, where, mark = axes.get_yaxis_transform(), ([0.0], [middle]), (1.0, 0.45)
        axes.axhline(at, color=INK, lw=scale, ls=DASHED, zorder=1.5)
        axes.annotate(word, (0.995, at), xycoords=across, xytext=(0, 1.5 * scale), ha="right", **letters)
    else:
        across, where, mark = axes.get_xaxis_transform(), ([middle], [0.0]), (0.45, 1.0)
        axes.axvline(at, color=INK, lw=scale, ls=DASHED, zorder=1.5)
        axes.annotate(word, (at, 1.0), xycoords=across, xytext=(0, scale), ha="center", **letters)
    slash, style = [(-mark[0], -mark[1]), mark], {"ls": "none", "clip_on": False, "transform": across}
    axes.plot(*where, marker=slash, ms=10 * scale, mec="white", mew=4 * scale, zorder=5, **style)
    for shift in (-0.5, 0.5):  # two short strokes across the axis, with paper between them
        moved = [(x + shift * (not upright), y + shift * upright) for x, y in slash]
        axes.plot(*where, marker=moved, ms=10 * scale, mec=INK, mew=0.8 * scale, zorder=6, **style)
