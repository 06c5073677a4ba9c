"""Which joints of an MJCF file a fixed synergy moves, though moment arms of spatial tendons change with the posture."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from synergrip.hands.models.mjcf_arms import Arms
from synergrip.hands.models.relations import Relations
from synergrip.hands.models.settling import Settled, moves
from synergrip.linalg import Array, split

NEAR = 0.05
"""Moment arms are constant when they stay this close to their mean, relative to the largest of the tendon."""
HOLD = 0.1
"""Motors keep hold of joints while this much is left of what they do to them with the mean moment arms."""
MOST_HELD = 60
"""Joints that tendons tie to each other; more are no finger, and not looked into."""


@dataclass(frozen=True)
class Readable:
    """What is to be made of the spatial tendons of a file."""

    lost: tuple[int, ...]
    """Columns of q of which it is not known how they move."""
    bending: tuple[int, ...]
    """Tendons that move them so: their moment arms change."""
    change: Sequence[tuple[int, float]]
    """Tendons that count as constant, and how far their moment arms change."""


def change_of(arms: Arms, kinds: Sequence[str], tendon: int) -> float:
    """Return how far a moment arm of a tendon is from its mean, relative to the largest at a joint of that kind."""
    most = 0.0
    for kind in set(kinds):
        joints = [joint for joint, each in enumerate(kinds) if each == kind]
        mean, seen = arms.mean[tendon, joints], arms.each[:, tendon, joints]
        apart, size = np.abs(seen - mean).max(initial=0.0), np.abs(mean).max(initial=0.0)
        most = max(most, apart / size if size > 0 else 0.0)
    return float(most)


def readable(
    found: Settled, relations: Relations, arms: Arms, tendons: Sequence[int], kinds: Sequence[str], rows: Array,
    pulls: Array,
) -> Readable:  # fmt: skip
    """Return which joints spatial tendons move in a way that changes with the posture, and the tendons that do not.

    Joints that motors hold whatever the moment arms are, as many motors as joints do, are driven each by itself. What
    motors leave to springs depends on the arms: these must be constant.

    Args:
        found: how the joints move with the mean moment arms.
        relations: A q = b.
        arms: of all tendons.
        tendons: the spatial ones with a motor or a spring.
        kinds: "hinge" or "slide", by column of q.
        rows: (m, n_q) what ties joints to each other: pulls, relations, springs.
        pulls: (n_p, n_a, n_q) of the actuators in each posture.
    """
    yields = moves(found.yielding)
    passed = {tendon: np.flatnonzero(arms.mean[tendon]).tolist() for tendon in tendons}
    lost, bending, change, left = set[int](), list[int](), list[tuple[int, float]](), list(tendons)
    while left:
        tied = together(rows, passed[left[0]])
        here = [tendon for tendon in left if set(passed[tendon]) & set(tied)] or left[:1]
        left = [tendon for tendon in left if tendon not in here]
        held = not yields[tied].any()
        if held and _held(relations.A[:, tied], pulls[:, :, tied]):
            continue
        changes = [(tendon, change_of(arms, kinds, tendon)) for tendon in here]
        if held or max(most for _, most in changes) > NEAR:
            lost.update(tied)
            bending += [tendon for tendon, most in changes if most > NEAR]
        else:
            change += changes
    return Readable(tuple(sorted(lost)), tuple(bending), change)


def _held(A: Array, pulls: Array) -> bool:
    """Tell whether actuators (n_p, n_a, n) hold what relations A leave free, in every posture as in the mean."""
    free = split(A).null_space
    if free.shape[1] == 0 or len(pulls) == 0:
        return True
    if free.shape[1] > MOST_HELD:
        return False
    acting = pulls[:, np.any(pulls != 0, axis=(0, 2))] @ free
    acting = np.concatenate([acting, acting.mean(axis=0, keepdims=True)])
    least = np.linalg.eigvalsh(acting.transpose(0, 2, 1) @ acting)[:, 0]  # squares of the smallest singular values
    return bool(least[-1] > 0 and least.min() >= HOLD**2 * least[-1])


def together(rows: Array, joints: Sequence[int]) -> list[int]:
    """Return the columns that `rows` tie to one of the `joints`, directly or through others, and these themselves."""
    ties = [set(np.flatnonzero(row).tolist()) for row in rows]
    found = set(joints)
    while (more := found.union(*(tie for tie in ties if tie & found))) != found:
        found = more
    return sorted(found)
