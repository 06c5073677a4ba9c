"""The slip margin of every contact over time, with the margin that is required."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from synergrip.reports.pictures.limits_drawn import on_paper
from synergrip.reports.pictures.line_chart import HEAD, LABEL, Box, draw_chart, head_of
from synergrip.reports.pictures.lines import Lines, lines_of
from synergrip.reports.pictures.page import IN_PAPER, SPACE, Heading
from synergrip.reports.pictures.paper import Paper
from synergrip.reports.pictures.sheet import INK, Sheet, write_picture

WIDE_MM, HIGH, LEAST = 88.0, 1.7, 0.6
"""Usual width [mm]; usual and least height of the axes [inch]."""
LEFT, RIGHT, BELOW, ABOVE = 0.55, 0.18, 0.45, 0.06
"""Room around the axes [inch]."""
SIZE = 6.5
"""Of the letters at the line of what is required [points]."""


def draw_margin(document: Mapping[str, Any], path: Path, paper: Paper) -> str:
    """Draw the slip margins of a plan.

    Args:
        document: of a plan, as in plan.json.
        path: ends in .svg, .png or .pdf.
        paper: size, letters and title.

    Returns:
        What is to be said below it in a paper.

    Raises:
        InputError: a suffix that says no format, a height without room for it, a font that is not installed.
        OSError: the file cannot be written.
    """
    lines, times = lines_of(document)[0], np.array(document["time_s"])
    width = paper.wide(WIDE_MM)
    heading, wide = Heading.of(paper.title, "", width, IN_PAPER), width - LEFT - RIGHT
    top = (heading.height + SPACE / 2 if paper.title else ABOVE) + head_of(lines, times, wide) - HEAD
    height = paper.high(top + HIGH + BELOW, top + LEAST + BELOW)

    def fill(sheet: Sheet) -> None:
        heading.write(sheet)
        axes = draw_chart(sheet, Box(LEFT, top, wide, height - top - BELOW), times, lines, label=False)
        if len(times) > 1:
            axes.set_ylabel(lines.label, fontsize=LABEL * sheet.scale)
            note_required(axes, lines, sheet.scale)
        else:
            axes.set_xlabel(lines.label, fontsize=LABEL * sheet.scale)

    write_picture(path, width, height, fill, paper.letters)
    return _caption(document, lines)


def note_required(axes: Any, lines: Lines, scale: float) -> None:
    """Write at the dashed line what margin is required, with room below it for the words."""
    low, high = axes.get_ylim()
    for bound in lines.bounds:
        low = min(low, bound - 0.2 * (high - bound))
    axes.set_ylim(low, high)
    for bound in lines.bounds:
        axes.annotate(f"required {bound:.4g} N", (0.995, bound), xycoords=axes.get_yaxis_transform(), ha="right",
                      va="top", xytext=(0, -2 * scale), textcoords="offset points", fontsize=SIZE * scale,
                      color=INK, **on_paper(scale))  # fmt: skip


def _caption(document: Mapping[str, Any], lines: Lines) -> str:
    margin = document["margin"]
    model = "linear model of the start posture" if "true" not in document else "hand that moves"
    asked = "".join(f" Dashed: the {bound:.4g} N that are required." for bound in lines.bounds)
    return (
        f"{document['title']}. Slip margin of each contact over time, of the {model}; the least is "
        f"{margin['worst_N']:.4g} N at {margin['contact']}, t = {margin['time_s']:.3g} s.{asked}"
    )
