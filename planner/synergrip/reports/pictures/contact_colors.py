"""One colour per contact, the same in every picture."""

from __future__ import annotations

from collections.abc import Sequence

from synergrip.reports.pictures.sheet import BLUE, GREEN, VERMILION

COLORS = (BLUE, VERMILION, GREEN, "#cc79a7", "#e69f00", "#56b4e9", "#7a5230", "#333333")
"""Colours that stay apart for the colour-blind (Okabe and Ito; its yellow, which white paper swallows, is brown)."""


def contact_colors(names: Sequence[str]) -> dict[str, str]:
    """Return the colour of each contact by its place in the grasp; from the ninth on they begin anew."""
    return {name: COLORS[index % len(COLORS)] for index, name in enumerate(names)}
