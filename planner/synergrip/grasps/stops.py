"""Why joints stop before all pads touch, and what can be done about it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from synergrip.hands.follower_ranges import likewise
from synergrip.hands.hand import Coupling, Hand
from synergrip.hands.hand_file import FILE
from synergrip.hands.synergies.matrix import drivers, ranges_of_followers
from synergrip.hands.units import SI_UNITS
from synergrip.linalg import Array

Flags = NDArray[np.bool_]

ELSE = "start from another posture, close along something else, or move the object"


@dataclass(frozen=True)
class Stop:
    """Why a joint stopped while the hand closed."""

    text: str
    limit: int | None = None
    """The joint that came to its limit: this one, or one that takes it along."""
    pad: int | None = None
    """The pad that touched."""


def advice(hand: Hand, direction: Array, movers: Flags, pad: int, stops: Mapping[int, Stop]) -> str:
    """Return what to do about a pad that does not reach the object.

    Args:
        hand: the hand.
        direction: (n_q,) joint motion of closing by 1.
        movers: (n_c, n_q) the joint carries the pad.
        pad: its number.
        stops: why each of its joints stopped.
    """
    limits = {hand.joint_names[stop.limit] for stop in stops.values() if stop.limit is not None}
    along = dict(zip(hand.joint_names, direction.tolist(), strict=True))
    short = [each for each in ranges_of_followers(hand) if each.joint.name in limits & set(hand.couplings)]
    short = [each for each in short if each.short(along[each.joint.name])]
    if short:
        return likewise(short)
    held = [j for j, stop in stops.items() if stop.pad is not None and not movers[stop.pad, j]]
    between = list(_between(hand, movers[pad])) if held else []
    return _parting(hand, between) if between else ELSE


def _between(hand: Hand, own: Flags) -> Iterator[str]:
    """Yield the followers whose rigid coupling ties joints of one finger, those of `own` (n_q,), to others."""
    inside = {name for name, mine in zip(hand.joint_names, own, strict=True) if mine}
    for name, coupling in hand.couplings.items():
        if coupling.rigid and len({joint in inside for joint in (name, *coupling.ratios)}) > 1:
            yield name


def _parting(hand: Hand, followers: Sequence[str]) -> str:
    """Return how to close a hand whose fingers rigid couplings hold together, or how to say that they part."""
    told = ", ".join(
        f"'{name}' to {drivers(hand.couplings[name])}{f' ({place})' if (place := hand.couplings[name].place) else ''}"
        for name in followers
    )
    lines = ", ".join(line for name in followers if (line := _written(hand, name)))
    return (
        f"a rigid coupling stopped it ({told}): such fingers stop together, so move the object to where all pads touch "
        "at once; or, if a differential, a clutch, a spring or a tendon lets the fingers of the real hand part, write "
        f"rigid = false under [couplings] of a {FILE} (one beside the model file, named by hand.model, see "
        f"models/README.md)" + (f": {lines}" if lines else "")
    )


def _written(hand: Hand, follower: str) -> str:
    """Return the line of a hand.toml that lets a follower part; none when it follows several joints."""
    coupling: Coupling = hand.couplings[follower]
    if len(coupling.ratios) != 1:
        return ""
    ((driver, ratio),) = coupling.ratios.items()
    unit = SI_UNITS[hand.joints[hand.joint_names.index(follower)].kind]
    offset = f', offset = "{coupling.offset:.12g} {unit}"' if coupling.offset else ""
    return f'{_key(follower)} = {{ joint = "{driver}", ratio = {ratio:.12g}{offset}, rigid = false }}'


def _key(name: str) -> str:
    bare = name.isascii() and name.replace("_", "").replace("-", "").isalnum()
    return name if bare else f'"{name}"'
