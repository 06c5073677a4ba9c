"""A hand that closes on an object at many places at once: quick, for a search; `closing` is what counts."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from synergrip.errors import InputError
from synergrip.grasps.asked_grasp import AskedGrasp
from synergrip.grasps.ball import MEETS
from synergrip.grasps.closing_joints import MOST_STEPS, ClosingJoints
from synergrip.grasps.stops import Flags
from synergrip.linalg import Array, Places
from synergrip.values import Value

STRIDE = 2.0
"""A look at the distances takes so many times the `step` of the fastest joint; what is thinner may be missed."""
TOUCHING = 1e-6
"""A pad this close to the surface touches it [m]."""
NARROWED = 60
"""Times at most that the moment of a touch is narrowed down; some 8 do."""


@dataclass(frozen=True, eq=False, repr=False)
class ClosedAtMany(Value):
    """A hand closed on an object at N places."""

    positions: Array  # (N, 3) of the object [m]
    q: Array  # (N, n_q)
    gaps: Array  # (N, n_c) of the pads to the surface [m]
    outward: Array  # (N, n_c, 3) normals of the surface there
    facing: Array  # (N, n_c) cosine of each pad's own direction to the inward normal; 1 where it has none

    @property
    def touching(self) -> Flags:
        """(N, n_c) which contacts meet the object, and face it."""
        return np.asarray((np.abs(self.gaps) <= MEETS) & (self.facing > 0))

    def joined(self, other: ClosedAtMany) -> ClosedAtMany:
        """Return these places, then those of another."""
        names = (each.name for each in fields(self))
        return ClosedAtMany(*(np.concatenate([getattr(self, name), getattr(other, name)]) for name in names))


class Closer:
    """A hand, a way of closing and an object without a place."""

    def __init__(self, asked: AskedGrasp) -> None:
        """Read what does not change from place to place.

        Args:
            asked: a hand that closes, on an object with a shape.

        Raises:
            InputError: it does not close, or the object has no shape.
        """
        if asked.closing is None or asked.body.shape is None:
            raise InputError.at("close", "missing; where an object is to be is found by a hand that closes on it")
        self.asked, self.shape = asked, asked.body.shape
        self.joints = ClosingJoints.of(asked.hand, asked.closing, asked.touches)
        self.pads = [touch.pad for touch in asked.touches]
        self.radii = np.array([pad.radius for pad in self.pads])
        self.begin = self.joints.inside(asked.q)

    def seen(self, positions: Array, q: Array) -> ClosedAtMany:
        """Return what is seen of the pads at joint values (N, n_q) with the object at `positions` (N, 3)."""
        motions = self.asked.hand.kinematics.along(q, [(pad.link, pad.point) for pad in self.pads])
        gaps, outward = self.shape.surface(motions.position - positions[:, None])
        own = np.array([pad.normal for pad in self.pads])
        pushing = np.einsum("kmij,mj->kmi", motions.rotation, own)
        aimed = np.array([touch.aimed for touch in self.asked.touches])
        facing = np.where(aimed, -(pushing * outward).sum(axis=-1), 1.0)
        return ClosedAtMany(positions, q, np.asarray(gaps - self.radii), np.asarray(outward), np.asarray(facing))

    def gaps(self, positions: Array, q: Array) -> Array:
        """Return how far pads are from the surface (N, n_c) [m], of what `seen` sees."""
        return np.asarray(self.shape.surface(self.centres(q) - positions[:, None])[0] - self.radii)

    def centres(self, q: Array) -> Array:
        """Return where the pads are (N, n_c, 3) [m] at joint values (N, n_q)."""
        return self.asked.hand.kinematics.along(q, [(pad.link, pad.point) for pad in self.pads]).position

    def path(self, looks: int = 24) -> Array:
        """Return where each pad comes (looks, n_c, 3) [m] as the hand closes on nothing."""
        joints, along = self.joints, self.joints.direction
        far = np.where(np.isfinite(joints.limit), joints.limit, self.begin + np.pi * np.sign(along))
        share = np.where(joints.closing, (far - self.begin) / np.where(joints.closing, along, 1.0), 0.0)
        return self.centres(joints.inside(self.begin + np.linspace(0.0, float(share.max()), looks)[:, None] * along))

    def closed(self, positions: Array) -> ClosedAtMany:
        """Return the hand closed on the object at each of `positions` (N, 3) where no pad begins inside it."""
        first = self.seen(positions, np.tile(self.begin, (len(positions), 1)))
        outside = ~np.any((first.gaps < -TOUCHING) & self.joints.moved, axis=1)
        positions = positions[outside]
        way = _Way(self, positions, first.gaps[outside])
        for _ in range(int(MOST_STEPS)):
            going = way.going()
            if not len(going):
                break
            way.on(going)
        return self.seen(positions, way.q)


class _Way:
    """Hands on their way, one for each place of the object; its arrays change as they go."""

    def __init__(self, closer: Closer, positions: Array, gaps: Array) -> None:
        """Begin where pads are as far from the surface as `gaps` (N, n_c) say."""
        self.of, self.joints, self.positions, count = closer, closer.joints, positions, len(positions)
        self.q, self.gaps = np.tile(closer.begin, (count, 1)), gaps
        self.moving = np.tile(self.joints.closing, (count, 1))
        self.waiting = np.tile(self.joints.moved, (count, 1))
        self._stop(np.arange(count))

    def going(self) -> Places:
        """Return the places whose hands have pads that wait and still move."""
        carried = (self.moving[:, None, :] & self.joints.movers).any(axis=2)
        return np.flatnonzero((self.waiting & carried).any(axis=1))

    def on(self, who: Places) -> None:
        """Let some hands go a step on, or to the first touch or limit within it."""
        rate = np.where(self.moving[who], self.joints.direction, 0.0)
        rate /= (np.abs(rate) / (STRIDE * self.joints.step)).max(axis=1, keepdims=True)
        with np.errstate(divide="ignore", invalid="ignore"):
            room = np.where(rate != 0, (self.joints.limit - self.q[who]) / rate, np.inf)
        far = np.minimum(room.min(axis=1), 1.0)
        q = self.joints.inside(self.q[who] + far[:, None] * rate)
        gaps = self.of.gaps(self.positions[who], q)
        beyond = self._nearest(who, gaps)
        hit = np.flatnonzero(beyond < 0)
        if len(hit):
            far[hit] = self._touch(who[hit], rate[hit], far[hit], beyond[hit])
            q[hit] = self.joints.inside(self.q[who[hit]] + far[hit, None] * rate[hit])
            gaps[hit] = self.of.gaps(self.positions[who[hit]], q[hit])
        self.q[who], self.gaps[who] = q, gaps
        self._stop(who)

    def _nearest(self, who: Places, gaps: Array) -> Array:
        """Return the least distance (k,) of the pads that wait."""
        return np.asarray(np.where(self.waiting[who], gaps, np.inf).min(axis=1))

    def _touch(self, who: Places, rate: Array, far: Array, beyond: Array) -> Array:
        """Return the share of a step at which the first pad touches, just outside, by false position.

        Args:
            who: (k,) the hands.
            rate: (k, n_q) their motion in a step.
            far: (k,) a share at which a pad is inside.
            beyond: (k,) how deep, below 0 [m].
        """
        low, high, inside = np.zeros(len(who)), far.copy(), beyond.copy()
        outside = gap = self._nearest(who, self.gaps[who])
        for turn in range(NARROWED):
            if np.all(gap < TOUCHING / 2):
                break
            share = (low + high) / 2 if turn % 4 == 3 else low + (high - low) * outside / (outside - inside)
            found = self._nearest(who, self.of.gaps(self.positions[who], self.q[who] + share[:, None] * rate))
            deep = found < 0
            outside = np.where(deep, outside / 2, found)  # the end that stays counts less, or it would stay for good
            inside = np.where(deep, found, inside / 2)
            low, high, gap = np.where(deep, low, share), np.where(deep, share, high), np.where(deep, gap, found)
        return low

    def _stop(self, who: Places) -> None:
        """Stop joints at their limits, and those that carry pads that touch, with all that they take along."""
        ended = self.joints.at_limit(self.q[who])
        stopped = (ended[:, :, None] & self.joints.takes).any(axis=1)
        touched = self.waiting[who] & (self.gaps[who] <= TOUCHING)
        carriers = np.asarray((touched[:, :, None] & self.joints.movers).any(axis=1))
        stopped |= (carriers[:, :, None] & self.joints.tied).any(axis=1)
        self.moving[who] &= ~stopped
        self.waiting[who] &= ~touched
