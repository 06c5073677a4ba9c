"""The balls that a URDF has for the shape of links: round fingertips, of which pads can be made."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from synergrip.hands.models.xml_elements import Element, read_xml

MOST = 1.0
"""[m] A ball that is larger or farther from its link than this is no fingertip."""


@dataclass(frozen=True)
class Ball:
    """A ball on a link."""

    radius: float  # [m]
    point: tuple[float, ...]
    """(3,) its centre in the frame of the link [m]."""


def balls_of(file: str, links: Iterable[str]) -> dict[str, Ball]:
    """Return the first ball with which a URDF collides, or else draws, each of some links that have one.

    Nothing of it bears on how a hand moves: numbers that are none are passed over, and so are other files.

    Raises:
        InputError: the file cannot be read, though it could be when the hand was loaded.
    """
    if Path(file).suffix != ".urdf":
        return {}
    wanted, root = set(links), read_xml(Path(file), "URDF file")
    found = {element.attributes.get("name", ""): _ball(element) for element in root.all("link")}
    return {link: ball for link, ball in found.items() if ball is not None and link in wanted}


def _ball(link: Element) -> Ball | None:
    for shape in (*link.all("collision"), *link.all("visual")):
        for sphere in shape.child("geometry").all("sphere"):
            point = _numbers(shape.child("origin").attributes.get("xyz", "0 0 0"))
            radius = _numbers(sphere.attributes.get("radius", ""))
            if len(point) == 3 and len(radius) == 1 and 0 < radius[0] < MOST and max(map(abs, point)) < MOST:
                return Ball(radius[0], point)
    return None


def _numbers(text: str) -> tuple[float, ...]:
    """Return the finite numbers of a text; none where it is anything else."""
    try:
        values = tuple(float(part) for part in text[:200].split())
    except ValueError:
        return ()
    return values if all(map(math.isfinite, values)) else ()
