"""What conflicts in an infeasible task, read from its proof: every limit with its share, and the items with it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from synergrip.conic.program import Program
from synergrip.conic.rows import LOWER_SIDES
from synergrip.linalg import Array

COUNTS = 0.005
"""Share of the proof below which a limit plays no part."""
ALIKE = 3
"""Digits of what items carry beside the heaviest; those that are alike to these stay in the order of the program."""
HEAVY = 0.2
"""Items that carry less than this share of what the heaviest item of their limit carries are not named."""


@dataclass(frozen=True)
class Conflict:
    """One limit's part in a proof of infeasibility."""

    key: str
    """Key in the problem file."""
    share: float
    """Share of the proof's multipliers, all in units of their limits."""
    items: tuple[str, ...]
    """Contacts, joints or synergies, the heaviest first."""
    friction: bool = False
    """Whether its multipliers say that contacts slip."""
    sides: tuple[str, ...] = ()
    """Of each item the side of the limit that it is at, as "highest" or "rising"; empty for a cone."""
    knots: tuple[int, ...] = ()
    """Those that carry most of it, in order; none where it is all between them."""


def beside_friction(found: Sequence[Conflict]) -> str:
    """Return the limit that carries most of a proof, with its heaviest item; empty when that is friction itself."""
    chief = max(found, key=lambda conflict: conflict.share, default=None)
    return "" if chief is None or chief.friction else f"{chief.key} ({chief.items[0]})"


def conflicts(program: Program, y: Array) -> tuple[Conflict, ...]:
    """Return the limits that a proof of infeasibility y (m,) rests on, the heaviest first.

    Multipliers of the two sides of one limit cancel: what is left is a proof as well, and a stronger one.
    """
    sums: dict[str, dict[tuple[str, bool], Array]] = {}
    words: dict[tuple[str, str, bool], str] = {}
    first: dict[str, int] = {}
    for block, rows in program.slices():
        sizes = np.linalg.norm(y[rows].reshape(block.knots, len(block.items), block.dim), axis=2)
        of_limit = sums.setdefault(block.limit, {})
        first.setdefault(block.limit, block.first_knot)
        for item, size in zip(block.items, sizes.T, strict=True):
            lower = item.side in LOWER_SIDES
            signed = -size if lower else size
            words[block.limit, item.name, lower] = item.side if block.dim == 1 else ""
            place = item.name, block.between
            of_limit[place] = of_limit.get(place, np.zeros(block.knots)) + signed
    friction = {block.limit for block in program.blocks if block.friction}
    weights = {key: _weights(items) for key, items in sums.items()}
    total = sum(sum(items.values()) for items in weights.values())
    found = []
    for key, items in weights.items():
        share = sum(items.values()) / total
        if share > COUNTS:
            most = max(items.values())
            ordered = sorted(items, key=lambda item: -round(items[item] / most, ALIKE))
            heavy = [item for item in ordered if items[item] > HEAVY * items[ordered[0]]]
            at_knots = {name: net for (name, between), net in sums[key].items() if not between}
            sides = tuple(words.get((key, name, _net(sums[key], name) < 0), "") for name in heavy)
            knots = _heavy_knots(at_knots, first[key])
            found.append(Conflict(key, share, tuple(heavy), key in friction, sides, knots))
    return tuple(sorted(found, key=lambda conflict: -conflict.share))


def _net(sums: dict[tuple[str, bool], Array], name: str) -> float:
    """Return which way the multipliers of an item push in all: below 0 those of its lower bound weigh more."""
    return sum(float(net.sum()) for (each, _), net in sums.items() if each == name)


def _heavy_knots(sums: dict[str, Array], first: int) -> tuple[int, ...]:
    """Return the knots that carry most of what a limit carries."""
    if not sums:
        return ()
    weight = np.sum([np.abs(net) for net in sums.values()], axis=0)
    return tuple(int(k) + first for k in np.flatnonzero(weight > HEAVY * weight.max(initial=0.0)))


def _weights(sums: dict[tuple[str, bool], Array]) -> dict[str, float]:
    """Return what each item carries, at the knots and between them."""
    found: dict[str, float] = {}
    for (name, _), net in sums.items():
        found[name] = found.get(name, 0.0) + float(np.abs(net).sum())
    return found
