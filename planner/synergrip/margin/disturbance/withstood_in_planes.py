"""How large an extra force a plan withstands in every direction of a plane, to be drawn."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from synergrip.linalg import Array, frozen
from synergrip.margin.disturbance.passive import passive_along
from synergrip.margin.disturbance.reacting import statics_of
from synergrip.margin.disturbance.reaction import Reaction
from synergrip.planning.outcome import Plan

DIRECTIONS = 72
"""In which it is looked at, around the plane."""


def withstood_in_planes(plan: Plan, planes: Sequence[tuple[int, int]]) -> list[Array]:
    """Return (72, 2) each the extra forces [N] in planes at which a contact slips first, with references as planned.

    They act at B. Rows are NaN in directions without an end.

    Args:
        plan: of any task.
        planes: two of the axes 0, 1, 2 of N each.
    """
    reaction = Reaction.of(plan, statics_of(plan), cones_alone=True)
    return [_in_plane(reaction, plane) for plane in planes]


def _in_plane(reaction: Reaction, plane: tuple[int, int]) -> Array:
    found = []
    for turn in np.linspace(0.0, 2 * np.pi, DIRECTIONS, endpoint=False):
        unit = np.array([np.cos(turn), np.sin(turn)])
        wrench = np.zeros(6)
        wrench[list(plane)] = unit
        size = passive_along(reaction, reaction.scaled(wrench)[None]).upper
        found.append(np.full(2, np.nan) if size is None else size * unit)
    return frozen(found)
