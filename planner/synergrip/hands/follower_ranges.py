"""The range that a follower states of its own, beside what its coupling makes of the range of its driver."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from synergrip.documents.quantities import SHOWN_IN
from synergrip.hands.hand import Coupling, Joint
from synergrip.hands.units import SI_UNITS
from synergrip.linalg import Array

FollowerRanges = Literal["keep", "ignore"]
"""What to do with the ranges that a model file states for followers."""
APART = 1e-6
"""[rad or m] Ends of a range that differ by less say the same."""
MATERIAL = 0.02
"""Share of what the coupling asks for that a range may leave out, as a rounded number does."""
REPAIR = (
    'correct one of the two, or let the couplings say how far followers go: hand.follower_ranges = "ignore" (an '
    "argument of load_hand in code)"
)


@dataclass(frozen=True)
class FollowerRange:
    """How far a follower goes by its own range, and by its coupling."""

    joint: Joint
    coupling: Coupling
    leaders: tuple[Joint, ...]
    """The joints that it follows in the end and that follow none themselves; none when it is locked."""
    lower: float  # [rad] or [m]
    upper: float  # [rad] or [m]
    """What the coupling makes of the ranges of the leaders."""

    def short(self, direction: float) -> bool:
        """Tell whether the own range ends before what the coupling asks for, upwards (> 0) or downwards (< 0).

        A leader without limits asks for nothing: its followers may well end its way.
        """
        if direction > 0:
            return self.joint.upper + APART < self.upper < np.inf
        return direction < 0 and self.joint.lower - APART > self.lower > -np.inf

    @property
    def contradicts(self) -> bool:
        """Whether the hand cannot use what the file says: no room at all, or less than a rigid coupling needs."""
        if not np.isfinite([self.lower, self.upper]).all():
            return False
        low, high = max(self.lower, self.joint.lower), min(self.upper, self.joint.upper)
        wanted = self.upper - self.lower
        if high - low <= APART:
            return self.short(1) or self.short(-1)
        return self.coupling.rigid and high - low < (1 - MATERIAL) * wanted

    def __str__(self) -> str:
        """Return both statements with their places, and what repairs them."""
        name, place = self.joint.name, _at(self.joint.place)
        own = f"the range of '{name}' is {_span(self.joint, self.joint.lower, self.joint.upper)}{place}"
        if not self.leaders:
            made = f"which is locked at {_span(self.joint, self.lower, self.upper)}"
        else:
            of = " and ".join(f"'{j.name}' at {_span(j, j.lower, j.upper)}{_at(j.place)}" for j in self.leaders)
            made = f"which takes it from {_span(self.joint, self.lower, self.upper)} with {of}"
        return f"{own}, against its coupling{_at(self.coupling.place)}, {made}: {REPAIR}"


def follower_ranges(
    joints: Sequence[Joint], couplings: Mapping[str, Coupling], E: Array, e: Array
) -> list[FollowerRange]:
    """Return the ranges of the followers, in the order of q.

    Args:
        joints: those of the hand.
        couplings: follower -> what it follows.
        E: (n_q, n_q) with `e` what `coupling_map` makes of the couplings: q = E q_free + e.
        e: (n_q,)
    """
    found = []
    for row, joint in enumerate(joints):
        if joint.name in couplings:
            columns = np.flatnonzero(E[row]).tolist()
            ends = np.array([sorted((E[row, i] * joints[i].lower, E[row, i] * joints[i].upper)) for i in columns])
            lower, upper = ends.reshape(-1, 2).sum(axis=0) + e[row]
            leaders = tuple(joints[i] for i in columns)
            found.append(FollowerRange(joint, couplings[joint.name], leaders, float(lower), float(upper)))
    return found


def led(joints: Sequence[Joint], couplings: Mapping[str, Coupling], E: Array, e: Array) -> tuple[Joint, ...]:
    """Return the joints, where each follower reaches as far as its coupling takes it.

    A follower that may part from its leader under contact keeps what its own range allows beyond that.
    The arguments are those of `follower_ranges`.
    """
    ranges = {each.joint.name: each for each in follower_ranges(joints, couplings, E, e)}
    return tuple(_led(joint, ranges[joint.name]) if joint.name in ranges else joint for joint in joints)


def _led(joint: Joint, said: FollowerRange) -> Joint:
    if said.coupling.rigid:
        return replace(joint, lower=said.lower, upper=said.upper)
    return replace(joint, lower=min(said.lower, joint.lower), upper=max(said.upper, joint.upper))


def why_outside(
    joints: Sequence[Joint], couplings: Mapping[str, Coupling], E: Array, e: Array, q: Array
) -> dict[str, FollowerRange]:
    """Return, by name, the followers that joint values put outside their range though all that they follow is inside.

    The first four arguments are those of `follower_ranges`; `q` (n_q,) are the joint values.
    """
    values = {joint.name: value for joint, value in zip(joints, q, strict=True)}
    followed = {joint.name: value for joint, value in zip(joints, E @ q + e, strict=True)}
    return {
        each.joint.name: each
        for each in follower_ranges(joints, couplings, E, e)
        if abs(values[each.joint.name] - followed[each.joint.name]) <= APART
        and all(leader.lower - APART <= values[leader.name] <= leader.upper + APART for leader in each.leaders)
        and each.short(values[each.joint.name] - (each.joint.lower + each.joint.upper) / 2)
    }


def contradictions(ranges: Sequence[FollowerRange]) -> Iterator[str]:
    """Yield one note for all followers whose range and coupling contradict each other, if there are any."""
    found = [each for each in ranges if each.contradicts]
    if found:
        yield likewise(found)


def likewise(found: Sequence[FollowerRange]) -> str:
    """Return the first of some contradictions in full, and the names of the others."""
    others = ", ".join(f"'{each.joint.name}'{_at(each.joint.place)}" for each in found[1:])
    return f"{found[0]}{f' (likewise {others})' if others else ''}"


def _span(joint: Joint, lower: float, upper: float) -> str:
    factor, unit = SHOWN_IN[SI_UNITS[joint.kind]]
    ends = [f"{factor * end:.4g}" for end in (lower, upper)]
    return f"{' to '.join(dict.fromkeys(ends))} {unit}"


def _at(place: str) -> str:
    return f" ({place})" if place else ""
