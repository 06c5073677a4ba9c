"""Moment arms of the tendons of an MJCF file, over the ranges of the joints."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from synergrip.hands.models.mjcf import Mjcf
from synergrip.hands.models.relations import Relations
from synergrip.linalg import Array

TURN = math.pi
"""How far from its drawing a hinge without a range is looked at [rad]."""
STROKE = 0.1
"""The same of a slide [m]."""
ANYWHERE, ALONG = 192, 9
"""Postures: so many with all joints anywhere in their ranges, and so many along the range of each joint that counts."""
MOST_ALONG = 540
"""So many along ranges in all, with at least 3 for each joint."""
MOST_ARMS = 5_000_000
"""Numbers to keep, which limits the postures of a file with many tendons."""
TOUCHED = 1e-9
"""A tendon with a smaller arm passes a joint by [m or 1]."""


@dataclass(frozen=True, eq=False)
class Arms:
    """What the tendons of a file are at the joints. Of a fixed tendon the arms are its coefficients."""

    mean: Array
    """(n_t, n_q) [m/rad or 1]."""
    each: Array
    """(n_p, n_t, n_q) in the postures that were looked at; none when no tendon is spatial."""
    offset: Array
    """(n_t,) length = mean q + offset [m, or the unit of the tendon]."""

    def span(self, tendon: int, joint: int) -> tuple[float, float]:
        """Return the smallest and the largest arm of a tendon at a joint."""
        seen = self.each[:, tendon, joint] if len(self.each) else self.mean[None, tendon, joint]
        return float(seen.min()), float(seen.max())


def arms_of(file: Mjcf, relations: Relations) -> Arms:
    """Return the moment arms of a file in postures that keep the relations, as far as the ranges allow."""
    if not file.spatial:
        offset = file.model.tendon_length0 - file.tendons @ file.q_0  # of joints that stand still above the palm
        return Arms(file.tendons, np.zeros((0, *file.tendons.shape)), offset)
    lower, upper = _ranges(file)
    anywhere = np.random.default_rng(0).uniform(lower, upper, (ANYWHERE, len(lower)))
    arms, _ = file.routed(_kept(relations, anywhere, lower, upper)[:: 1 + ANYWHERE * file.tendons.size // MOST_ARMS])
    passed = np.flatnonzero(np.abs(arms[:, list(file.spatial)]).max(axis=(0, 1)) > TOUCHED)
    count = max(3, min(ALONG, MOST_ALONG // max(len(passed), 1)))
    along = [line for joint in passed.tolist() for line in _along(file, joint, lower, upper, count)]
    postures = _kept(relations, np.vstack([anywhere, *along]), lower, upper)
    postures = postures[:: 1 + len(postures) * file.tendons.size // MOST_ARMS]
    each, lengths = file.routed(postures)
    mean = file.tendons.copy()
    mean[list(file.spatial)] = each[:, list(file.spatial)].mean(axis=0)
    mean[np.abs(mean) < TOUCHED] = 0.0
    return Arms(mean, each, (lengths - postures @ mean.T).mean(axis=0))


def _ranges(file: Mjcf) -> tuple[Array, Array]:
    model, joints = file.model, list(file.q)
    wide = np.array([TURN if file.kinds[joint] == "hinge" else STROKE for joint in joints])
    limited = model.jnt_limited[joints].astype(bool)
    ends = [np.where(limited, model.jnt_range[joints, end], file.q_0 + side * wide) for end, side in ((0, -1), (1, 1))]
    return np.minimum(*ends), np.maximum(*ends)


def _along(file: Mjcf, joint: int, lower: Array, upper: Array, count: int) -> Iterator[Array]:
    """Yield postures (n_q,) along the range of a joint, the others in the drawing."""
    for value in np.linspace(lower[joint], upper[joint], count):
        posture = np.clip(file.q_0, lower, upper)
        posture[joint] = value
        yield posture


def _kept(relations: Relations, postures: Array, lower: Array, upper: Array) -> Array:
    """Return the postures (n_p, n_q) moved to where the relations hold, those left out that would leave the ranges."""
    if len(relations.A) == 0:
        return postures
    inverse = np.linalg.pinv(relations.A, rcond=1e-8)
    moved = postures + (relations.b - postures @ relations.A.T) @ inverse.T
    slack = 1e-6 * (upper - lower)
    inside = np.all((moved >= lower - slack) & (moved <= upper + slack), axis=1)
    return moved[inside] if inside.sum() > len(moved) // 8 else moved
