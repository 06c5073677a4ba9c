"""A hand that closes on an object until its pads touch."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from synergrip.documents.quantities import in_mm
from synergrip.errors import InputError, Issue
from synergrip.grasps.ball import MEETS, REACH
from synergrip.grasps.closing_joints import MOST_STEPS, ClosingJoints
from synergrip.grasps.first_touch import TOUCHING, Gaps, first_touch
from synergrip.grasps.objects import Object
from synergrip.grasps.placing import Touch
from synergrip.grasps.stops import Flags, Stop, advice
from synergrip.hands.hand import Hand
from synergrip.linalg import Array, frozen


def close(hand: Hand, q: Array, direction: Array, body: Object, touches: Sequence[Touch], key: str = "close") -> Array:
    """Return the joint values (n_q,) at which every pad that `direction` moves touches the object.

    All joints follow the direction with one common parameter. When a pad touches, the joints between its link and
    the palm stop, and all that are rigidly coupled to them. A joint that comes to its limit stops, and with it those
    that follow it by any coupling. The rest goes on until all pads touch. Pads that the direction does not move are
    left as they are.

    Args:
        hand: the hand.
        q: (n_q,) joint values to start from.
        direction: (n_q,) joint motion of closing by 1.
        body: the object.
        touches: the contacts.
        key: where the closing stands, for the error.

    Raises:
        InputError: an object without shape or position, no pad that moves, pads that start inside the object, or
            pads that do not reach it; all of them.
    """
    missing = list(unknown_surface(body))
    if body.shape is None or missing:
        raise InputError(missing)
    gaps = Gaps(hand, body.shape, body.position, touches)
    closing = _Closing(hand, gaps, ClosingJoints.of(hand, direction, touches))
    state = closing.start(q)
    if not state.waiting.any():
        raise InputError.at(key, "moves none of the pads that are to touch")
    if issues := list(closing.inside(state)):
        raise InputError(issues)
    state = closing.stopped(state)
    while pads := closing.coming(state):
        state = closing.stopped(closing.advanced(state, pads))
    if issues := list(closing.missed(state)):
        raise InputError(issues)
    return frozen(state.q)


def unknown_surface(body: Object) -> Iterator[Issue]:
    """Yield what is missing of an object to close a hand on it: its shape, its position."""
    if body.shape is None:
        yield Issue("missing; a hand closes on a shape", key="object.shape", on_key=True)
    if not body.placed:
        message = (
            "missing; to close the hand, it must be known where the object is: its centre in the palm frame, 3 lengths"
        )
        yield Issue(message, key="object.position", on_key=True)


@dataclass(frozen=True, eq=False)
class _State:
    """A hand on its way: where it is, what still moves, which pads still wait, and how it came here."""

    q: Array  # (n_q,)
    moving: Flags
    """(n_q,)"""
    waiting: Flags
    """(n_c,) pads that the closing moves and that have not touched."""
    stops: Mapping[int, Stop]
    """Joint that has stopped -> why."""
    trail: tuple[tuple[float, Array], ...]
    """How far the hand was closed, and its joint values, at the start and after each event."""


@dataclass(frozen=True, eq=False)
class _Closing:
    """What does not change while a hand closes."""

    hand: Hand
    gaps: Gaps
    joints: ClosingJoints

    def start(self, q: Array) -> _State:
        """Return the state at the start; a value that rounding put past its limit is put back."""
        inside = self.joints.inside(q)
        return _State(inside, self.joints.closing, self.joints.moved, {}, ((0.0, inside),))

    def inside(self, state: _State) -> Iterator[Issue]:
        """Yield one issue for each pad that waits inside the object."""
        for pad, gap in self._waiting_gaps(state):
            if gap < -TOUCHING:
                touch = self.gaps.touches[pad]
                yield Issue(
                    f"pad '{touch.pad.name}' is {-1e3 * gap:.3g} mm inside the {self.gaps.shape.title} before the hand "
                    "closes; start from a more open posture, or move the object",
                    key=touch.key,
                )

    def stopped(self, state: _State) -> _State:
        """Return the state with the joints stopped that are at their limits or carry a pad that touches."""
        names, stops, waiting = self.hand.joint_names, dict(state.stops), state.waiting.copy()
        at_limit = self.joints.at_limit(state.q)
        for joint in np.flatnonzero(at_limit).tolist():
            for other in np.flatnonzero(self.joints.takes[joint]).tolist():
                cause = other if at_limit[other] else joint
                why = "at its limit" if at_limit[other] else f"stopped with {names[joint]}"
                stops.setdefault(other, Stop(why, limit=cause))
        for pad, gap in self._waiting_gaps(state):
            if gap <= TOUCHING:
                waiting[pad] = False
                for joint in np.flatnonzero(self.joints.tied[self.joints.movers[pad]].any(axis=0)).tolist():
                    why = f"stopped when pad '{self.gaps.touches[pad].pad.name}' touched"
                    stops.setdefault(joint, Stop(why, pad=pad))
        moving = state.moving.copy()
        moving[list(stops)] = False
        return replace(state, moving=moving, waiting=waiting, stops=stops)

    def coming(self, state: _State) -> list[int]:
        """Return the pads that wait and still move."""
        return [int(pad) for pad in np.flatnonzero(state.waiting & (self.joints.movers & state.moving).any(axis=1))]

    def advanced(self, state: _State, pads: Sequence[int]) -> _State:
        """Return the state at the next event: the first of the pads touches, or a joint comes to its limit."""
        moved = np.where(state.moving, self.joints.direction, 0.0)
        scale = 1 / float(np.max(np.abs(moved) / self.joints.step))
        rate = scale * moved
        room = float(((self.joints.limit - state.q)[state.moving] / rate[state.moving]).min())
        event = first_touch(self.gaps, state.q, rate, min(room, MOST_STEPS), pads)
        steps, stops = min(room, MOST_STEPS) if event is None else event[0], dict(state.stops)
        if event is None and room > MOST_STEPS:
            stops |= dict.fromkeys(np.flatnonzero(state.moving).tolist(), Stop("moves without end"))
        q = self.joints.inside(state.q + steps * rate)
        closed = state.trail[-1][0] + steps * scale
        return replace(state, q=q, stops=stops, trail=(*state.trail, (closed, q)))

    def missed(self, state: _State) -> Iterator[Issue]:
        """Yield one issue for each pad that still waits: how close it came, where, and what stopped it."""
        for pad, now in self._waiting_gaps(state):
            touch, movers = self.gaps.touches[pad], self.joints.movers[pad] & self.joints.closing
            stops = {j: state.stops[j] for j in np.flatnonzero(movers).tolist()}
            # tied to a pad that touches, it is as near as a contact has to be; at a limit it never presses
            if now <= (MEETS if all(stop.pad is None for stop in stops.values()) else REACH):
                continue
            gap, closed = min(self._seen(state, pad))
            why = [f"{self.hand.joint_names[j]} {stop.text}" for j, stop in stops.items()]
            yield Issue(
                f"pad '{touch.pad.name}' does not reach the {self.gaps.shape.title}: at its closest, closed by "
                f"{closed:.4g}, it is {in_mm(gap)} away ({', '.join(why)}); "
                f"{advice(self.hand, self.joints.direction, self.joints.movers, pad, stops)}",
                key=touch.key,
            )

    def _seen(self, state: _State, pad: int) -> Iterator[tuple[float, float]]:
        """Yield the distance of a pad, and how far the hand was closed, once a step and at every event."""
        yield float(self.gaps.at(state.trail[0][1], [pad])[0][0]), 0.0
        for (before, a), (after, b) in pairwise(state.trail):
            looks = math.ceil(np.max(np.abs(b - a) / self.joints.step))
            for share in np.linspace(0.0, 1.0, looks + 1)[1:]:
                gap = float(self.gaps.at(a + share * (b - a), [pad])[0][0])
                yield gap, before + float(share) * (after - before)

    def _waiting_gaps(self, state: _State) -> list[tuple[int, float]]:
        pads = [int(pad) for pad in np.flatnonzero(state.waiting)]
        return list(zip(pads, self.gaps.at(state.q, pads)[0].tolist(), strict=True))
