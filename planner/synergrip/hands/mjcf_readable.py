"""Which joints of an MJCF file a fixed synergy moves, though moment arms of spatial tendons change with the posture."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from synergrip.errors import InputError
from synergrip.hands.relations import Relations
from synergrip.hands.settling import Settled, Springs, ratios, settle
from synergrip.linalg import Array

NEAR = 0.05
"""A coupling may change over the ranges of the joints by this share of the largest motion that its driver causes."""


def departures(
    found: Settled,
    drivers: Sequence[int],
    kinds: Sequence[str],
    relations: Relations,
    q_0: Array,
    postures: Sequence[tuple[Array, Springs]],
) -> Array:
    """Return (n_q,) how far what a driver does to each joint changes from the mean moment arms to those in postures.

    Changes are relative to the largest motion of a joint of that kind by the driver. They are infinite where the
    actuators lose hold of a driver.

    Args:
        found: with the mean moment arms.
        drivers: the columns of q that lead.
        kinds: "hinge" or "slide", by column.
        relations: A q = b.
        q_0: (n_q,) the drawing.
        postures: pulls (n_a, n_q) and springs in each.
    """
    usual = ratios(found, list(drivers))
    alike = np.array([[one == other for other in kinds] for one in kinds])
    size = np.array([np.abs(usual[row]).max(axis=0, initial=0.0) for row in alike])  # (n_q, d)
    worst = np.zeros(len(usual))
    for pulls, springs in postures:
        try:
            there = ratios(settle(relations, pulls, springs, q_0), list(drivers))
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
