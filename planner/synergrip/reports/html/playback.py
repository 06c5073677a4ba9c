"""The 3-D view of an answer as a part of its report, and a still picture where a browser or paper cannot show it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from synergrip.reports.pictures.cone_sections import when_worst
from synergrip.reports.pictures.hand_scene import draw_hand
from synergrip.reports.pictures.line_chart import Box
from synergrip.reports.pictures.sheet import svg_text
from synergrip.reports.view.scene import Scene

WIDE, HIGH = 6.4, 4.6
"""Of the still picture [inch]."""
MARKS = "arrows: forces of the hand on the object; cones: friction; squares of 10 mm"


@dataclass(frozen=True)
class Playback:
    """What is seen of a hand."""

    page: str
    """The 3-D view, a page of its own."""
    note: str
    """What is to be said of it."""
    still: str
    """One instant as an SVG element."""
    still_note: str


def playback_of(document: Mapping[str, Any], folder: Path) -> Playback | None:
    """Return what is seen of the hand of an answer; None for a grasp given as matrices.

    Args:
        document: of the answer, as in plan.json.
        folder: where the hand file is looked for when it is not a bundled one.

    Raises:
        InputError: the hand file is missing or has changed.
    """
    if "execution" not in document:
        return None
    from synergrip.reports.view.drawn import page
    from synergrip.reports.view.planned import scene_of

    scene = scene_of(document, folder)
    k = 0 if scene.margins is None else when_worst(scene.margins.min(axis=1))
    still = svg_text(WIDE, HIGH, lambda sheet: draw_hand(sheet, Box(0.1, 0.05, WIDE - 0.2, HIGH - 0.1), scene, k))
    at = "at the start" if scene.margins is None else f"at t = {scene.times[k]:.3g} s, where the slip margin is least"
    return Playback(page(scene), _note(scene, len(document["time_s"])), still, f"the hand {at}")


def _note(scene: Scene, knots: int) -> str:
    if scene.margins is None:
        return "the hand at the start, palm frame; cones: friction; squares of 10 mm"
    told = f"palm frame; {MARKS}"
    if scene.left_out:
        return f"{told}; {len(scene.times)} of {len(scene.times) + scene.left_out} knots are shown"
    if len(scene.times) < knots:
        return f"{told}; until t = {scene.times[-1]:.4g} s, as far as the motion is followed"
    return told
