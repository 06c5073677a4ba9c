"""Where passes along a motion begin: at the plan of the start posture, at a hold brought along, or bit by bit."""

from __future__ import annotations

import numpy as np

from synergrip.linalg import Array, frozen
from synergrip.planning.brought import brought
from synergrip.planning.fewer_knots import FewerKnots
from synergrip.planning.growing import grown
from synergrip.planning.walk import Walker
from synergrip.planning.walk_so_far import Walk
from synergrip.statics.motion import Motion


def walk_from_plan(walker: Walker, linear: Motion) -> Walk:
    """Return the walk that the passes end with, from the motion that a plan for the start posture promises.

    Where what then happens has nothing to do with the promise, a hold is brought along first. Of many knots, some show
    the way.
    """
    fewer = FewerKnots.of(walker)
    if fewer is None:
        whole = _from_plan(walker, linear)
    else:
        there = _from_plan(fewer.walker, linear.at(fewer.knots))
        walk = _on_from(fewer, there, linear.dz_r) or _from_plan(walker, linear)
        whole = fewer.told(walk, there)
    if not walker.effort.rounds or whole.interrupted or (whole.true and whole.behind <= walker.allowed):
        return whole
    return walk_from_hold(walker, _hold(walker, linear)).after(whole)


def _from_plan(walker: Walker, linear: Motion) -> Walk:
    begun = walker.executed(linear.dz_r, linear.forces, linear, fewer=True)
    if begun.nowhere:
        nearer = _brought_along(walker, _hold(walker, linear))
        if nearer is not None and _done(walker, nearer):
            return nearer
    return walker.on(begun)


def _on_from(fewer: FewerKnots, there: Walk, smooth: Array) -> Walk | None:
    """Return the walk of all knots that one of some of them leads to; None where it leads nowhere.

    Where little is tried, one that leads nowhere is how it ends: passes over all knots from the same plan hardly ever
    arrive where those over some of them do not.

    Args:
        fewer: whose knots some of them are.
        there: the walk at these.
        smooth: (T, n_z) references where it began, at all knots.

    Raises:
        KeyboardInterrupt: it was interrupted, and what it had come to ends before the last knot.
    """
    whole, leads = fewer.whole, fewer.walker.arrived(there) or there.interrupted
    if not leads and whole.effort.rounds:
        return None
    begun = fewer.at_all_knots(there, smooth)
    if begun is None and there.interrupted:
        raise KeyboardInterrupt(f"{there.come}, the hand does not get through all knots yet")
    if begun is None or not leads:
        return begun
    walk = whole.on(begun)
    return walk if _done(whole, walk) or not whole.effort.rounds else None


def _hold(walker: Walker, linear: Motion) -> Array:
    """Return references (T, n_z) that hold the object, of those that move it."""
    alpha, beta, gamma = walker.start.coordinates.coordinates(linear.dz_r)
    return frozen(walker.start.coordinates.references(alpha, np.zeros_like(beta), gamma))


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
