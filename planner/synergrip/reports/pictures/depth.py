"""Depth on paper: what is near is drawn in full, what is far thinner and fainter."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.linalg import Array
from synergrip.reports.pictures.view import View

FAINTEST, THINNEST, THICKEST = 0.5, 0.75, 1.2
"""How much of the paper shines through what is farthest, and its width and that of what is nearest."""


@dataclass(frozen=True)
class Depth:
    """From how far to how near what is drawn reaches."""

    view: View
    low: float
    high: float

    @classmethod
    def of(cls, view: View, points: Array) -> Depth:
        """Return the depth of points (n, 3)."""
        deep = view.depth(points)
        return cls(view, float(deep.min()), float(deep.max()))

    def near(self, points: Array) -> float:
        """Return how near the middle of points (n, 3) is: 0 for the farthest that is drawn, 1 for the nearest."""
        at = (float(self.view.depth(points).mean()) - self.low) / max(self.high - self.low, 1e-9)
        return float(np.clip(at, 0.0, 1.0))

    def drawn(self, points: Array, color: str, width: float) -> tuple[str, float]:
        """Return colour and width of what is drawn there."""
        near = self.near(points)
        return faded(color, FAINTEST * (1 - near)), width * (THINNEST + (THICKEST - THINNEST) * near)


def faded(color: str, share: float) -> str:
    """Return a colour ``#rrggbb`` with a share of white in it."""
    parts = (int(color[at : at + 2], 16) for at in (1, 3, 5))
    return "#" + "".join(f"{round(part + share * (255 - part)):02x}" for part in parts)


def darkened(color: str, share: float) -> str:
    """Return a colour ``#rrggbb`` with a share of black in it."""
    return "#" + "".join(f"{round(int(color[at : at + 2], 16) * (1 - share)):02x}" for at in (1, 3, 5))
