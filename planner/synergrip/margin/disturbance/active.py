"""What is withstood when internal forces answer: references planned again inside E_s, for each extra wrench its own.

The wrenches that are withstood so are a convex set W, the projection of one. Along a direction d its end is a cone
program with one unknown more: the largest f with ``b - A x + f B d`` in the cones. A wrench just beyond is proven to be
none of W by the certificate that every infeasible task has. The multipliers z of that program give a half-space that
holds all of W, ``n'w <= f n'd`` with ``n = -B'z``: the next direction along which to look for a nearer end is n.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from synergrip.changes.at_a_value import solved
from synergrip.changes.least_change import with_turns
from synergrip.conic.certificate import Certificate
from synergrip.conic.conflicts import conflicts
from synergrip.conic.relaxed import proof
from synergrip.linalg import Array
from synergrip.margin.disturbance.reaction import Reaction
from synergrip.margin.disturbance.withstood import Withstood, none_of_it, scaled
from synergrip.values import Value

FAR = 1e3
"""Times the size of the load as far as which a direction is followed."""
SHORT = 1e-6
"""Share by which what is withstood stays short of the optimum: plans keep limits to that share."""
BEYOND = (1e-6, 1e-5, 1e-4, 1e-3)
"""Shares beyond the optimum, one after the other until a wrench there is proven not to be withstood."""
NEAREST = 3
"""Directions from which a nearer end is looked for."""
TURNS = 6
"""How often the direction is turned at most."""
ASIDE = 4
"""How often a nearer end is looked for from beside the nearest one."""
FAR_ASIDE = 0.2
"""Size of each component that is added to its direction."""
WORTH = 1.2
"""Times the nearest end that a promise may be for which the next direction is tried."""
SAME = 1e-4
"""Relative gain of a turn below which it is the last one."""


@dataclass(frozen=True, eq=False, repr=False)
class End(Value):
    """Where wrenches that internal forces can answer end along a direction."""

    towards: Array
    """(6,) the direction, in scaled coordinates and force units."""
    found: Withstood
    """In multiples of the direction."""
    normal: Array | None
    """(6,) of the half-space there; None where no end was found."""

    @property
    def radius(self) -> float:
        """By the length-scaled norm, in force units; infinite without an end."""
        return np.inf if self.found.upper is None else self.found.upper * float(np.linalg.norm(self.towards))

    @property
    def promised(self) -> float:
        """The distance of the half-space: how near the end is at most along its normal."""
        if self.normal is None or self.found.upper is None:
            return np.inf
        return self.found.upper * float(self.normal @ self.towards / np.linalg.norm(self.normal))


def active_along(reaction: Reaction, direction: Array) -> End:
    """Return where wrenches along a direction (6,), in scaled coordinates and force units, are not withstood any more.

    Args:
        reaction: of the plan.
        direction: any but 0.
    """
    if reaction.free.size and reaction.works_on_free(direction):
        return End(direction, none_of_it(reaction, direction), None)
    size = float(np.linalg.norm(direction))
    column = reaction.columns @ direction / size
    decision = solved("largest wrench", with_turns(reaction.program, [column], [FAR], most=True))
    if not decision.acceptable:
        return End(direction, Withstood(0.0, None, proven=False), None)
    turn = max(float(decision.solution.x[-1]), 0.0)
    lower = turn * (1 - SHORT) / size
    if turn > FAR * (1 - SHORT):
        return End(direction, Withstood(lower, None), None)
    z = decision.solution.z[: len(column)]
    beyond, certificate = _beyond(reaction, direction / size, turn, z)
    limit, item, time = "", "", None
    if (found := conflicts(reaction.program, z if certificate.y is None else certificate.y)) and found[0].items:
        limit, item = found[0].key, found[0].items[0]
        time = float(reaction.times[found[0].knots[0]]) if found[0].knots else None
    wrench = reaction.wrench(beyond * direction / size)
    ended = Withstood(lower, beyond / size, limit, item, time, wrench, certificate.verified)
    return End(direction, ended, -(reaction.columns.T @ z))


def _beyond(reaction: Reaction, unit: Array, turn: float, z: Array) -> tuple[float, Certificate]:
    """Return the nearest of some sizes beyond the optimum of which it is proven that they are not withstood."""
    beyond, certificate = turn, Certificate("infeasible", False)
    for share in BEYOND:
        beyond = turn + share * max(turn, SHORT)
        certificate = proof(reaction.under(beyond * unit), (z,))
        if certificate.verified:
            break
    return beyond, certificate


def nearest_end(reaction: Reaction, known: Sequence[End]) -> End:
    """Return an end that is near by the length-scaled norm: an upper bound on the largest ball inside W.

    From the nearest of those that are known each direction is turned into the normal of the half-space there, as long
    as ends get nearer: they never get farther. On an edge of W, where several half-spaces meet, that may come to rest
    too early; so it is begun once more a little aside, some times.
    """
    ended = [end for end in known if end.found.upper is not None]
    if not ended:
        return min(known, key=lambda end: end.found.lower * float(np.linalg.norm(end.towards)))
    best = min(ended, key=lambda end: end.radius)
    for end in sorted(ended, key=lambda end: min(end.radius, end.promised))[:NEAREST]:
        best = min(best, _turned(reaction, end, best.radius), key=lambda each: each.radius)
    rng = np.random.default_rng(0)
    for _ in range(ASIDE if best.radius > 0 else 0):
        aside = best.towards / np.linalg.norm(best.towards) + FAR_ASIDE * rng.normal(size=6)
        begun = active_along(reaction, aside / np.linalg.norm(aside))
        best = min(best, _turned(reaction, begun, best.radius), key=lambda each: each.radius)
    return best


def _turned(reaction: Reaction, end: End, least: float) -> End:
    """Return an end that is at least as near, by turning its direction; no nearer than `least` may be all there is."""
    best = end
    for _ in range(TURNS):
        if end.normal is None or not end.promised < best.radius * (1 - SAME) or end.promised > least * WORTH:
            break
        end = active_along(reaction, end.normal / np.linalg.norm(end.normal))
        best = min(best, end, key=lambda each: each.radius)
    return best


def as_radius(reaction: Reaction, end: End) -> Withstood:
    """Return an end as the radius [N] of its wrench, by the length-scaled norm."""
    return scaled(end.found, reaction.unit * float(np.linalg.norm(end.towards)))


def active_box(reaction: Reaction, corners: Array) -> Withstood:
    """Return the largest common factor of the corners (n, 6) of a box with which each is withstood: W is convex."""
    ends = [active_along(reaction, corner) for corner in corners]
    worst = min(ends, key=lambda end: np.inf if end.found.upper is None else end.found.upper).found
    return replace(worst, lower=min(end.found.lower for end in ends), proven=all(end.found.proven for end in ends))
