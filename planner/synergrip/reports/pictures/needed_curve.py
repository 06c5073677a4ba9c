"""What a task comes to with k synergies, as curves: the first k of a set beside the best k."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from synergrip.explain.synergies.needed_points import NeededPoint
from synergrip.explain.synergies.subset_values import GOALS
from synergrip.explain.synergies.synergies_needed import SynergiesNeeded
from synergrip.linalg import Array
from synergrip.reports.pictures.key import SIZE as KEY
from synergrip.reports.pictures.layout import MARGIN
from synergrip.reports.pictures.line_chart import LABEL, OTHERS, TICKS
from synergrip.reports.pictures.page import IN_PAPER, SPACE, Heading
from synergrip.reports.pictures.paper import Paper
from synergrip.reports.pictures.sheet import GREY, USUAL, Sheet, write_picture

WIDTH, HEIGHT, LOWEST, LABELS, BETWEEN = 9.0, 2.0, 0.7, 0.7, 0.6  # [inch]
WIDTH_MM = 180.0
"""Usual width in a paper."""
PARTS = (
    ("largest_margin", "largest slip margin [N]", 1.0),
    ("peak", "least peak force [N]", 1.0),
    ("effort", "least effort [N]", 1.0),
    ("tracking_error", "object off its place [mm]", 1e3),
)
"""Figure, what it is called, and the factor to its unit."""


def draw_needed(needed: SynergiesNeeded, path: Path, title: str, paper: Paper | None = None) -> str:
    """Draw margin, peak force, effort and tracking error over the number of synergies.

    Args:
        needed: the curves.
        path: ends in .svg, .png or .pdf.
        title: heading of the picture.
        paper: of a picture for a paper, with a title of its own.

    Returns:
        What is to be said below it in a paper.

    Raises:
        InputError: a suffix that says no format.
        OSError: the file cannot be written.
    """
    named = f"{needed.set}, " if needed.set else ""
    model = {"start": "linear model of the start posture", "along": "the hand that moves"}[needed.model]
    under = f"{named}{len(needed.synergies)} synergies; best by {GOALS[needed.by].name}; {model}"
    width = WIDTH if paper is None else paper.wide(WIDTH_MM)
    heading = Heading.of(title, under, width) if paper is None else Heading.of(paper.title, "", width, IN_PAPER)
    top = heading.height + SPACE + 0.1 if heading.lines else SPACE
    usual = top + 2 * (HEIGHT + BETWEEN)
    high = usual if paper is None else paper.high(usual, top + 2 * (LOWEST + BETWEEN))
    each = (width - 2 * LABELS - 2 * MARGIN + 0.3) / 2

    def draw(sheet: Sheet) -> None:
        heading.write(sheet)
        for index, (name, label, factor) in enumerate(PARTS):
            row, column = divmod(index, 2)
            left, tall = LABELS + column * (each + LABELS), (high - top) / 2 - BETWEEN
            axes = sheet.chart(left, top + row * (tall + BETWEEN), each, tall)
            _curves(axes, needed, name, factor, sheet.scale)
            axes.tick_params(labelsize=TICKS * sheet.scale)
            axes.set_ylabel(label, fontsize=LABEL * sheet.scale)
            axes.set_xlabel("synergies", fontsize=LABEL * sheet.scale)
            if index == 1:  # the first has no crosses; above the axes no mark of the key is taken for a cross
                axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), fontsize=KEY * sheet.scale, ncols=4,
                            columnspacing=1.0, frameon=False, borderaxespad=0.0)  # fmt: skip

    write_picture(path, width, high, draw, USUAL if paper is None else paper.letters)
    return f"{title}: {under}. Crosses: no plan."


def _curves(axes: Any, needed: SynergiesNeeded, name: str, factor: float, scale: float) -> None:
    """Draw one figure over the number of synergies; a cross where there is no plan."""
    count = max(len(needed.first), len(needed.best), 1)
    for points, color, label, marker, height in (
        (needed.first, OTHERS[0], "first k", "o", 0.10), (needed.best, OTHERS[1], "best k", "D", 0.04),
    ):  # fmt: skip
        numbers = np.arange(1, len(points) + 1)
        axes.plot(numbers, _values(points, name, factor), color=color, marker=marker, ms=4.5 * scale, lw=1.6 * scale,
                  label=label)  # fmt: skip
        lacking = [number for number, point in zip(numbers, points, strict=True) if point.verdict != "feasible"]
        if name != "largest_margin":
            axes.plot(lacking, np.full(len(lacking), height), ls="none", marker="x", ms=5 * scale, color=color,
                      clip_on=False, label="no plan", transform=axes.get_xaxis_transform())  # fmt: skip
    if name == "largest_margin":
        axes.axhline(0.0, color=GREY, lw=0.8 * scale)
    else:
        axes.set_ylim(0.0, 1.06 * axes.get_ylim()[1])
    axes.set_xlim(0.5, count + 0.5)
    axes.set_xticks(range(1, count + 1, 1 + count // 20))
    axes.spines[["top", "right"]].set_visible(False)


def _values(points: Sequence[NeededPoint], name: str, factor: float) -> Array:
    """Return the figure of each point, NaN where there is none."""
    values = [getattr(point, name) for point in points]
    found = np.array([np.nan if value is None else factor * value for value in values])
    return np.where(np.isfinite(found), found, np.nan)
