"""Springs that pull joints where no motor holds them against it: how far a posture is from where these settle.

Motors are stiff and hold all that they move. In the motions N that neither an actuator nor a relation holds, only the
springs say where joints are without contact: where their energy is least, ``N' (K q - b) = 0``, at

    q - C (K q - b),    C = N (N' K N)^-1 N'

unless a joint comes to the end of its range on the way and stops there.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from synergrip.hands.drives import Drives
from synergrip.hands.hand import Hand, Joint, SynergySet
from synergrip.linalg import Array, split

AWAY = 1e-6
"""Distance of a joint from where its spring rests that is no rounding [rad or m]."""
HELD = 1e-9
"""Share of a motion that may be left over where synergies do it."""


def way_to_rest(hand: Hand, synergies: SynergySet, q: Array, C_q: Array) -> Array:
    """Return how far (n_q,) joints would go from q to where springs of the model file settle without contact.

    It is 0 where motors hold the joints, where the problem states another yield than the springs have, and for ways
    that are rounding.

    Args:
        hand: the hand.
        synergies: the chosen set.
        q: (n_q,) joint values [rad or m].
        C_q: (n_q, n_q) the joint compliance that is used.
    """
    drives, still = hand.drives, np.zeros(len(q))
    if drives is None or drives.stiffness is None or not np.any(drives.compliance):
        return still
    stated = stated_otherwise(drives, C_q)
    yielding = split(drives.compliance).row_space
    yielding = yielding @ split(yielding[stated]).null_space if stated.any() else yielding
    way = _settled(yielding, drives.stiffness, drives.spring_torques(q), hand.joints, q)
    left = way - synergies.S @ np.linalg.lstsq(synergies.S, way, rcond=None)[0]
    if np.linalg.norm(left) <= HELD * np.linalg.norm(way):
        return still
    return np.where(np.abs(way) > AWAY, way, 0.0)


def stated_otherwise(drives: Drives, C_q: Array) -> Array:
    """Return (n_q,) whether a joint has springs, and another yield in C_q (n_q, n_q) than by these."""
    springs = drives.compliance
    return np.asarray(np.any(~np.isclose(C_q, springs, rtol=1e-9, atol=0.0) & (springs != 0), axis=1))


def _settled(N: Array, K: Array, torques: Array, joints: Sequence[Joint], q: Array) -> Array:
    """Return the way (n_q,) along N (n_q, m) to the least energy; joints stop at the ends of their ranges."""
    lower, upper = (np.array([getattr(joint, end) for joint in joints]) - q for end in ("lower", "upper"))
    H, g = N.T @ K @ N, N.T @ torques
    stopped, ends = np.zeros(len(q), dtype=bool), np.zeros(len(q))
    for _ in range(len(q) + 1):
        firm = N[stopped]
        at = np.linalg.pinv(firm) @ ends[stopped]
        free = split(firm).null_space if stopped.any() else np.eye(N.shape[1])
        step = at - free @ np.linalg.solve(free.T @ H @ free, free.T @ (H @ at + g))
        way = N @ step
        beyond = ~stopped & ((way > upper + AWAY) | (way < lower - AWAY))
        if not beyond.any():
            break
        stopped |= beyond
        ends = np.where(stopped, np.clip(np.where(beyond, way, ends), lower, upper), 0.0)
    return np.asarray(way)
