"""Where pads are, and the last links of fingers without any, as a table."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from synergrip.documents.quantities import in_mm
from synergrip.hands.models.urdf_balls import Ball
from synergrip.hands.spots import Spot
from synergrip.linalg import Array
from synergrip.reports.text.tables import table, wrapped

HEADER = ("pad", "link", "place [mm]", "pushes to")

BARE, FRAME = "(origin)", "(frame)"
"""What stands for the name of a pad where a finger has none: where its last link begins, or a frame fixed on it."""
ORIGIN = f"{BARE} of the last link of a finger without a pad: not its tip"
FIXED = f"{FRAME} that no joint moves, at the end of a finger without a pad: often its tip; look at the picture"


def spots_table(spots: Sequence[Spot], name: str = HEADER[0]) -> str:
    """Return a line for each pad or last link, in the palm frame; `name` heads the first column."""
    rows = [
        (
            spot.name if spot.pad else FRAME if spot.held_fast else BARE, spot.link, triple(1e3 * spot.position, 4),
            "" if spot.normal is None else triple(spot.normal, 2),
        )
        for spot in spots
    ]  # fmt: skip
    bare = [spot.held_fast for spot in spots if not spot.pad]
    told = [*[ORIGIN] * (False in bare), *[FIXED] * (True in bare)]
    return "\n".join([table((name, *HEADER[1:]), rows), *told])


def balls_lines(balls: Mapping[str, Ball]) -> Iterator[str]:
    """Yield what balls the file has on last links, alike ones together, and the contact that makes a pad of one."""
    alike: dict[Ball, list[str]] = {}
    for link, ball in balls.items():
        alike.setdefault(ball, []).append(link)
    for ball, links in alike.items():
        lengths = ", ".join(f'"{in_mm(length, 6)}"' for length in ball.point)
        place = f", point = [{lengths}]" if any(ball.point) else ""
        pad = f'{{ name = "tip", link = "{links[0]}"{place}, radius = "{in_mm(ball.radius, 6)}" }}'
        at = triple(1e3 * np.array(ball.point), 4)
        told = (
            f"{', '.join(links)}: a ball of radius {in_mm(ball.radius)} at {at} mm; as a round pad: contact = [{pad}]"
        )
        yield from wrapped("round    ", told)


def triple(values: Array, digits: int) -> str:
    """Return three numbers in brackets."""
    return f"({', '.join(f'{round(float(value), 6) + 0.0:.{digits}g}' for value in values)})"
