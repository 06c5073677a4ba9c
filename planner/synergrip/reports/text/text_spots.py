"""Where pads and fingertips are, as a table."""

from __future__ import annotations

from collections.abc import Sequence

from synergrip.hands.spots import Spot
from synergrip.linalg import Array
from synergrip.reports.text.tables import table

HEADER = ("pad", "link", "place [mm]", "pushes to")


def spots_table(spots: Sequence[Spot], name: str = HEADER[0]) -> str:
    """Return a line for each pad or fingertip, in the palm frame; `name` heads the first column."""
    rows = [
        (
            spot.name if spot.pad else f"{spot.name} (fingertip)", spot.link, triple(1e3 * spot.position, 4),
            "" if spot.normal is None else triple(spot.normal, 2),
        )
        for spot in spots
    ]  # fmt: skip
    return table((name, *HEADER[1:]), rows)


def triple(values: Array, digits: int) -> str:
    """Return three numbers in brackets."""
    return f"({', '.join(f'{round(float(value), 6) + 0.0:.{digits}g}' for value in values)})"
