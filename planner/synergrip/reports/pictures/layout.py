"""Where the panels of a picture go: columns of panels, wrapped into blocks."""

from __future__ import annotations

import math
import textwrap
from dataclasses import dataclass

import numpy as np

from synergrip.linalg import Array

MOST = 16
"""Columns that are drawn; what is left out is said."""
ACROSS = 5
"""Columns beside each other."""
COLUMN, GAP, MARGIN = 2.7, 0.15, 0.35  # [inch]
NARROW = 1.35
"""The narrowest column with room for its texts [inch]."""
NARROWEST = 6.5
"""Width of a picture with room for its texts [inch]."""
LETTERS = 138.0
"""Letters of 1 point in an inch, with some room to spare."""


@dataclass(frozen=True)
class Columns:
    """`count` columns in as many blocks as it takes, of equal length where possible."""

    count: int
    room: float | None = None
    """Width of the sheet that they fill [inch]; without it columns have their usual width."""

    @property
    def blocks(self) -> int:
        """Blocks below each other."""
        most = ACROSS
        if self.room is not None:
            most = max(1, min(ACROSS, int((self.room - 2 * MARGIN + GAP) / (NARROW + GAP))))
        return math.ceil(self.count / most)

    @property
    def across(self) -> int:
        """Columns of a block."""
        return math.ceil(self.count / self.blocks)

    @property
    def column(self) -> float:
        """Width of a column [inch]."""
        if self.room is None:
            return COLUMN
        return min((self.room - 2 * MARGIN + GAP) / self.across - GAP, COLUMN)

    @property
    def width(self) -> float:
        """Of the sheet [inch]."""
        if self.room is not None:
            return self.room
        return max(NARROWEST, self.across * (COLUMN + GAP) - GAP + 2 * MARGIN)

    def place(self, index: int) -> tuple[int, float]:
        """Return the block of a column and how far from the left it starts [inch]."""
        block, column = divmod(index, self.across)
        used = self.across * (self.column + GAP) - GAP
        return block, (self.width - used) / 2 + column * (self.column + GAP)


def fitted(text: str, width: float, size: float) -> list[str]:
    """Return the lines of a text in letters of `size` points that fit into `width` inches, on average."""
    return textwrap.wrap(text, round(width * LETTERS / size))


def size_that_fits(text: str, width: float, size: float) -> float:
    """Return `size` [points], or what is left of it where a text of one line is to fit into `width` inches."""
    return min(size, width * LETTERS / max(len(text), 1))


@dataclass(frozen=True)
class Window:
    """The part of the paper that all panels of a row show."""

    middle: Array  # (2,)
    span: float
    """From left to right."""
    height: float
    """Of the panel [inch]."""


def window(points: Array, column: float = COLUMN, margin: float = 0.08) -> Window:
    """Return the window around points (n, 2), in a panel as wide as a column [inch] and as high as they are."""
    low, high = points.min(axis=0), points.max(axis=0)
    size = np.maximum((high - low) * (1 + 2 * margin), 1e-9)
    height = column * float(np.clip(size[1] / size[0], 0.55, 1.25))
    return Window((low + high) / 2, float(max(size[0], size[1] * column / height)), height)
