"""Names of places in a drawing: in two columns beside it, each with a thin line to its place."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from synergrip.linalg import Array
from synergrip.reports.pictures.free_places import apart
from synergrip.reports.pictures.layout import LETTERS
from synergrip.reports.pictures.sheet import FAINT, Panel

SIZE, ROW, BESIDE = 8.0, 0.15, 0.12
"""Size of the letters [points], distance of two names, and room beside a column [inch]."""
LONGEST = 30
"""Letters of a name that are shown."""


@dataclass(frozen=True)
class Name:
    """What a place is called."""

    text: str
    color: str
    bold: bool = False

    @property
    def short(self) -> str:
        """The name, or its beginning where it is long."""
        return self.text if len(self.text) <= LONGEST else f"{self.text[: LONGEST - 1]}…"


def columns_width(names: Sequence[Name]) -> float:
    """Return how wide a column of these names is, with the room beside it [inch]."""
    if not names:
        return 0.0
    longest = max(len(name.short) * (1.1 if name.bold else 1.0) for name in names)
    return BESIDE + longest * SIZE / LETTERS


def columns_height(names: Sequence[Name]) -> float:
    """Return how high two columns of these names are [inch]."""
    return ROW * ((len(names) + 1) // 2 + 1)


def draw_names(panel: Panel, names: Sequence[Name], places: Array, middle: Array, half: Array, inch: float) -> None:
    """Write names left and right of a drawing, in the order in which their places (n, 2) lie from top to bottom.

    Args:
        panel: in whose units all lengths are.
        names: n of them.
        places: (n, 2) what they are the names of.
        middle: (2,) of the panel.
        half: (2,) half of its width and height.
        inch: in these units.
    """
    by_side = np.argsort(places[:, 0], kind="stable") if len(names) else np.zeros(0, dtype=int)
    for side, who in ((-1, by_side[: (len(names) + 1) // 2]), (1, by_side[(len(names) + 1) // 2 :])):
        at = middle[0] + side * half[0]
        room = half[1] - ROW * inch / 2
        highs = _inside(apart(places[who, 1], ROW * inch), middle[1] - room, middle[1] + room, ROW * inch)
        for index, high in zip(who, highs, strict=True):
            name = names[index]
            long = (len(name.short) * (1.1 if name.bold else 1.0) * SIZE / LETTERS + BESIDE / 2) * inch
            line = np.array([[at - side * long, high], places[index]])
            panel.strokes([line], FAINT, 0.6, near=3.0)
            panel.note(np.array([at, high]), name.short, name.color, "left" if side < 0 else "right", bold=name.bold)


def _inside(values: Array, low: float, high: float, least: float) -> Array:
    """Return values (n,) moved until they are between two ends and `least` apart, as far as there is room."""
    order = np.argsort(values, kind="stable")
    moved = values[order].tolist()
    for k in range(len(moved)):
        moved[k] = max(moved[k], moved[k - 1] + least if k else low)
    for k in reversed(range(len(moved))):
        moved[k] = min(moved[k], moved[k + 1] - least if k + 1 < len(moved) else high)
    found = np.empty(len(moved))
    found[order] = moved
    return found
