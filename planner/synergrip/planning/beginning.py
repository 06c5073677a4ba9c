"""Where passes along a motion begin: at the plan of the start posture, at a hold brought along, or bit by bit."""

from __future__ import annotations

import numpy as np

from synergrip.linalg import Array, frozen
from synergrip.planning.brought import brought
from synergrip.planning.growing import grown
from synergrip.planning.walk import Walker
from synergrip.planning.walk_so_far import Walk
from synergrip.statics.motion import Motion


def walk_from_plan(walker: Walker, linear: Motion) -> Walk:
    """Return the walk that the passes end with, from the motion that a plan for the start posture promises.

    Where what then happens has nothing to do with the promise, a hold is brought along first.
    """
    begun = walker.executed(linear.dz_r, linear.forces, linear, fewer=True)
    alpha, beta, gamma = walker.start.coordinates.coordinates(linear.dz_r)
    hold = frozen(walker.start.coordinates.references(alpha, np.zeros_like(beta), gamma))
    if begun.nowhere and (nearer := _brought_along(walker, hold)) is not None and _done(walker, nearer):
        return nearer
    whole = walker.on(begun)
    if not walker.effort.rounds or whole.interrupted or (whole.true and whole.behind <= walker.allowed):
        return whole
    return walk_from_hold(walker, hold).after(whole)


def walk_from_hold(walker: Walker, hold: Array) -> Walk:
    """Return the walk that comes of bringing a hold along (`brought`), or a little farther at a time (`growing`).

    Args:
        walker: whose task it is.
        hold: (T, n_z) references of a plan for the same loads without the motion; they change with the load.
    """
    along = _brought_along(walker, hold)
    if not walker.effort.rounds:
        start = walker.executor.setting.start.taken(np.zeros(len(hold), dtype=int))
        return along or walker.on(walker.executed(hold, None, start))
    if along is None:
        return grown(walker, hold)
    return along if _done(walker, along) else grown(walker, hold).after(along)


def _brought_along(walker: Walker, hold: Array) -> Walk | None:
    begun = brought(walker, hold)
    return None if begun is None else walker.on(begun)


def _done(walker: Walker, walk: Walk) -> bool:
    return walk.interrupted or walker.arrived(walk)
