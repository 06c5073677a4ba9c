"""What a plan withstands while its references stay as they are: the hand yields, and forces answer through compliance.

Exact to rounding: the cones are those of the plan, what an extra wrench adds to them is linear, and of each cone the
largest ball, the largest multiple of a box and the way along a ray are known (`leaving`).
"""

from __future__ import annotations

import numpy as np

from synergrip.conic.rows import Kind
from synergrip.linalg import Array
from synergrip.margin.disturbance.leaving import SHORT, Balls, along, balls, proven
from synergrip.margin.disturbance.reaction import Cones, Reaction
from synergrip.margin.disturbance.withstood import NO_END, Withstood, none_of_it, scaled


def passive_ball(reaction: Reaction) -> Withstood:
    """Return the radius [N] of the largest ball of extra wrenches, by the length-scaled norm."""
    if reaction.free.size:
        return none_of_it(reaction, reaction.free[:, 0])
    found = [(cones, _balls(cones)) for cones in reaction.cones()]
    if not found:
        return NO_END
    cones, ball = min(found, key=lambda each: float(each[1].upper.min()))
    worst, lower = int(np.argmin(ball.upper)), min(float(each.lower.min()) for _, each in found)
    upper = float(ball.upper[worst])
    if not np.isfinite(upper):
        return NO_END
    holds = all(
        np.all(proven(each.start, each.change, own.sigma, np.full(len(own.sigma), lower)))
        for each, own in found
        if each.block.kind is not Kind.ZERO
    )
    found_end = _ended(reaction, cones, worst, lower, upper, ball.towards[worst], holds=holds)
    return scaled(found_end, reaction.unit)


def passive_along(reaction: Reaction, directions: Array) -> Withstood:
    """Return the largest common factor of some extra wrenches with which each of them is withstood.

    Args:
        reaction: of the plan.
        directions: (n, 6) in scaled coordinates and force units.
    """
    for direction in directions:
        if reaction.free.size and reaction.works_on_free(direction):
            return none_of_it(reaction, direction)
    best, ended = np.inf, None
    for cones in reaction.cones():
        for direction in directions:
            change = cones.change @ direction
            zero = cones.block.kind is Kind.ZERO
            reach = np.where(np.any(change != 0, axis=-1), 0.0, np.inf) if zero else along(cones.start, change)
            worst = int(np.argmin(reach))
            if reach[worst] < best:
                best, ended = float(reach[worst]), (cones, worst, direction)
    if ended is None:
        return NO_END
    cones, worst, direction = ended
    return _ended(reaction, cones, worst, best * (1 - SHORT), best, direction, holds=True)


def _balls(cones: Cones) -> Balls:
    """Return the largest ball in each cone; an equation is kept by nothing that it sees."""
    if cones.block.kind is not Kind.ZERO:
        return balls(cones.start, cones.change)
    sees = np.any(cones.change != 0, axis=(-2, -1))
    radius, largest = np.where(sees, 0.0, np.inf), np.abs(cones.change).sum(axis=1)
    return Balls(radius, radius, largest / np.maximum(np.linalg.norm(largest, axis=1), 1e-300)[:, None], radius)


def _ended(
    reaction: Reaction, cones: Cones, index: int, lower: float, upper: float, direction: Array, *, holds: bool
) -> Withstood:
    """Return what ends at a cone, as multiples of a direction (6,) in scaled coordinates and force units."""
    knot, limit, item = cones.place(index)
    wrench = reaction.wrench(upper * direction)
    return Withstood(lower, upper, limit, item, float(reaction.times[knot]), wrench, holds)
