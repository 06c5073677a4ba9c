"""Which joints of an MJCF file a fixed synergy moves, though moment arms of spatial tendons change with the posture."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from synergrip.errors import InputError
from synergrip.hands.relations import Relations, couplings
from synergrip.hands.settling import Springs, ratios, settle
from synergrip.linalg import Array

Pull = tuple[Array, Springs]
"""Joint torque per force of each actuator (n_a, n_q), and the springs, in one posture."""

NEAR = 0.05
"""A coupling may change over the ranges of the joints by this share of the largest motion that its driver causes."""
MOST_TIED = 60
"""Joints that tendons tie to each other; more are no finger, and not looked into."""
MOST_LOOKED = 2e5
"""Postures times the square of the number of joints, which limits the time."""


def departures(
    kinds: Sequence[str], order: Sequence[int], relations: Relations, q_0: Array, mean: Pull, postures: Sequence[Pull]
) -> Array:
    """Return (n_q,) how far what drives a joint moves it otherwise in some posture than with mean moment arms.

    Changes are relative to the largest motion of a joint of that kind by the same driver. They are infinite where the
    actuators lose hold of a driver. Of joints that are tied to each other, the first posture beyond `NEAR` is the last
    one that is looked at.

    Args:
        kinds: "hinge" or "slide", by column of q.
        order: columns, those first that are to be followers.
        relations: A q = b.
        q_0: (n_q,) the drawing.
        mean: pulls and springs with the mean moment arms.
        postures: the same in each posture.
    """
    changes = np.zeros(len(kinds))
    left = set(np.flatnonzero(_changing(mean, postures)).tolist())
    rows = np.vstack([relations.A, *(part for pulls, springs in (mean, *postures[:1]) for part in (pulls, springs.F))])
    while left:
        tied = together(rows, [min(left)])
        left -= set(tied)
        if len(tied) > MOST_TIED:
            changes[tied] = np.inf
            continue
        step = max(1, round(len(postures) * len(tied) ** 2 / MOST_LOOKED))
        part = Relations(relations.A[:, tied], relations.b)
        fewer = [_columns(pull, tied) for pull in postures[::step]]
        rank = [order.index(joint) for joint in tied]
        changes[tied] = _departures(
            [kinds[joint] for joint in tied], np.argsort(rank).tolist(), part, q_0[tied], _columns(mean, tied), fewer
        )
    return changes


def _changing(mean: Pull, postures: Sequence[Pull]) -> NDArray[np.bool_]:
    """Return (n_q,) whether the arm of any actuator or spring at the joint changes with the posture."""
    changing = np.zeros(mean[0].shape[1], dtype=bool)
    for pulls, springs in postures:
        for here, usual in ((pulls, mean[0]), (springs.F, mean[1].F)):
            changing |= np.any(np.abs(here - usual) > 1e-9 * np.abs(usual).max(initial=0.0), axis=0)
    return changing


def _columns(pull: Pull, joints: Sequence[int]) -> Pull:
    pulls, springs = pull
    return pulls[:, joints], Springs(springs.F[:, joints], springs.g)


def _departures(
    kinds: Sequence[str], order: Sequence[int], relations: Relations, q_0: Array, mean: Pull, postures: Sequence[Pull]
) -> Array:
    found = settle(relations, *mean, q_0)
    followers = couplings([str(joint) for joint in range(len(kinds))], found.relations or relations, order)
    drivers = [joint for joint in range(len(kinds)) if str(joint) not in followers and not found.idle[joint]]
    usual = ratios(found, drivers)
    alike = np.array([[one == other for other in kinds] for one in kinds])
    size = np.array([np.abs(usual[row]).max(axis=0, initial=0.0) for row in alike])  # (n_q, d)
    worst = np.zeros(len(kinds))
    for pull in postures:
        if worst.max() > NEAR:
            break
        try:
            there = ratios(settle(relations, *pull, q_0), drivers)
        except InputError:  # pulls that nearly repeat each other in this posture only
            there = np.full_like(usual, np.inf)
        change = np.abs(there - usual)
        share = np.divide(change, size, out=np.where(change > 0, np.inf, 0.0), where=size > 0)
        worst = np.maximum(worst, share.max(axis=1, initial=0.0))
    return worst


def together(rows: Array, joints: Sequence[int]) -> list[int]:
    """Return the columns that `rows` tie to one of the `joints`, directly or through others, and these themselves."""
    ties = [set(np.flatnonzero(row).tolist()) for row in rows]
    found = set(joints)
    for _ in ties:
        found = found.union(*(tie for tie in ties if tie & found))
    return sorted(found)
