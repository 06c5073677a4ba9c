"""How a picture in space lies: axes of the palm, gravity, and how long a length is on paper."""

from __future__ import annotations

import math

import numpy as np

from synergrip.documents.quantities import in_mm
from synergrip.linalg import Array
from synergrip.reports.pictures.free_places import free_places
from synergrip.reports.pictures.sheet import INK, Sheet
from synergrip.reports.pictures.view import View

HIGH, WIDE = 0.85, 0.85
"""Room that the axes take, and gravity beside them [inch]."""
LONG = 0.7
"""Of an axis across the view, of half the room."""
SHORTEST = 0.2
"""Of an axis that is drawn as an arrow, of one across the view: what points at the viewer is a dot."""
SIZE = 7.0
"""Of the letters [points]."""


def draw_bearings(sheet: Sheet, view: View, left: float, top: float, gravity: Array | None) -> float:
    """Draw the axes of the palm, and gravity (3,) where it is known, and return the room taken [inch]."""
    _arrows(sheet, view, left, top, dict(zip("xyz", np.eye(3), strict=True)))
    if gravity is None or not np.any(gravity):
        return WIDE
    _arrows(sheet, view, left + WIDE, top, {"g": np.asarray(gravity) / np.linalg.norm(gravity)})
    return 2 * WIDE


def _arrows(sheet: Sheet, view: View, left: float, top: float, directions: dict[str, Array]) -> None:
    panel = sheet.panel(left, top, WIDE, HIGH, np.zeros(2), 2.0)
    flat = LONG * np.array([view.flat(direction) for direction in directions.values()])
    start = np.zeros(2) if len(flat) > 1 else -flat[0] / 2
    lengths = np.linalg.norm(flat, axis=1)
    for vector, length in zip(flat, lengths, strict=True):
        if length < SHORTEST * LONG:
            panel.dots(start[None], INK, 4.0, near=11)
        else:
            panel.arrows(start[None], vector[None], INK, thick=0.014)
    strokes = [np.array([start, start + vector]) for vector in flat]
    for name, place in zip(directions, free_places(start + flat, flat, strokes, 0.2), strict=True):
        panel.note(place, name, INK)


def draw_scale(sheet: Sheet, left: float, base: float, per_inch: float, room: float, word: str = "") -> None:
    """Draw a bar as long as a round length.

    Args:
        sheet: where.
        left: where it begins [inch].
        base: where its words stand [inch from the top].
        per_inch: how long an inch is there [m].
        room: the longest that it may get [inch].
        word: stands before the length.
    """
    length = round_length(room * per_inch)
    long = length / per_inch
    for start, end in (((left, base - 0.17), (left + long, base - 0.17)), ((left, base - 0.21), (left, base - 0.13)),
                       ((left + long, base - 0.21), (left + long, base - 0.13))):  # fmt: skip
        sheet.stroke(start, end, INK, 1.2)
    sheet.write(left, base, f"{word} {in_mm(length)}".strip(), SIZE)


def round_length(most: float) -> float:
    """Return the largest of 1, 2, 5, 10, 20, ... that is no longer than a length [m]."""
    power = 10.0 ** math.floor(math.log10(most))
    return next(step * power for step in (5.0, 2.0, 1.0) if step * power <= most * (1 + 1e-9))
