"""An answer at one look: the hand with forces and cones at the worst instant, beside margins and forces over time."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from synergrip.reports.figures.margin_figure import note_required
from synergrip.reports.pictures.cone_sections import when_worst
from synergrip.reports.pictures.hand_scene import draw_hand
from synergrip.reports.pictures.line_chart import Box, draw_chart, head_of
from synergrip.reports.pictures.lines import Lines, lines_of
from synergrip.reports.pictures.page import IN_PAPER, Heading
from synergrip.reports.pictures.paper import Paper
from synergrip.reports.pictures.sheet import INK, Sheet, write_picture
from synergrip.reports.view.planned import scene_of
from synergrip.reports.view.scene import Scene

WIDE_MM, HIGH = 180.0, 3.3
"""Usual width [mm] and height [inch]."""
LEAST, NARROW = 2.4, 5.5
"""The lowest it can be, and the width below which the charts stand below the hand [inch]."""
HAND, LEFT, BELOW, RIGHT = 0.57, 0.5, 0.42, 0.18
"""Share of the width that the hand takes; room around a chart [inch]."""


def draw_overview(document: Mapping[str, Any], folder: Path, path: Path, paper: Paper) -> str:
    """Draw what a hand does and how safe it is.

    Args:
        document: of a plan for a grasp on a hand, as in plan.json.
        folder: where its hand file is looked for when it is not a bundled one.
        path: ends in .svg, .png or .pdf.
        paper: size, letters and title.

    Returns:
        What is to be said below it in a paper.

    Raises:
        InputError: a grasp given as matrices, a suffix that says no format, a font that is not installed.
        OSError: the file cannot be written.
    """
    scene = scene_of(document, folder)
    k = 0 if scene.margins is None else when_worst(scene.margins.min(axis=1))
    every = {lines.title: lines for lines in lines_of(document)}
    parts = [every[title] for title in ("slip margin", "normal force") if title in every]
    width, times = paper.wide(WIDE_MM), np.array(document["time_s"])
    heading = Heading.of(paper.title, "", width, IN_PAPER)
    top = heading.height if paper.title else 0.05
    beside = width >= NARROW
    height = paper.high((HIGH if beside else 2 * HIGH) + top, (LEAST if beside else 2 * LEAST) + top)
    hand = Box(0.1, top, HAND * width - 0.2, height - top - 0.05)
    charts = Box(HAND * width, top, (1 - HAND) * width - RIGHT, height - top)
    if not beside:
        half = (height - top) / 2
        hand, charts = Box(0.1, top, width - 0.2, half), Box(0.05, top + half, width - 0.05 - RIGHT, half)

    def fill(sheet: Sheet) -> None:
        heading.write(sheet)
        draw_hand(sheet, hand, scene, k)
        _charts(sheet, parts, times, scene.times[k], charts)

    write_picture(path, width, height, fill, paper.letters)
    return _caption(document, scene, k, ("Left", "Right") if beside else ("Above", "Below"))


def _charts(sheet: Sheet, parts: list[Lines], times: np.ndarray, at: float, box: Box) -> None:
    """Draw charts below each other, with the instant at which the hand is seen."""
    heads = [head_of(lines, times, box.width - LEFT, key=number == 0) for number, lines in enumerate(parts)]
    high = (box.height - sum(heads)) / len(parts) - BELOW
    top = box.top
    for number, (lines, head) in enumerate(zip(parts, heads, strict=True)):
        inside = Box(box.left + LEFT, top + head, box.width - LEFT, high)
        axes = draw_chart(sheet, inside, times, lines, key=number == 0)
        if len(times) > 1:
            axes.axvline(at, color=INK, lw=0.8 * sheet.scale, zorder=1)
        if lines.title == "slip margin":
            note_required(axes, lines, sheet.scale)
        top += head + high + BELOW


def _caption(document: Mapping[str, Any], scene: Scene, k: int, places: tuple[str, str]) -> str:
    """Return what is seen, in words."""
    margin, (hand, charts) = document["margin"], places
    return (
        f"{document['title']}. {hand}: the hand at t = {scene.times[k]:.3g} s; arrows are the forces of the hand on "
        "the object, translucent cones the friction cones, in the colours of their contacts; axes of the palm, "
        f"gravity g. {charts}: slip margin and normal force of each contact over time, dashed where they are limited; "
        f"the least slip margin is {margin['worst_N']:.4g} N at {margin['contact']}."
    )
