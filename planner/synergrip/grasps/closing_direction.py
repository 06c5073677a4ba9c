"""The direction in which a hand closes, from the names of synergies or joints."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from synergrip.errors import InputError, one_of
from synergrip.hands.hand import Hand, SynergySet
from synergrip.hands.synergies import JOINTS, coupling_map, joint_vector
from synergrip.linalg import Array, frozen


def closing_direction(
    hand: Hand, synergies: SynergySet, wish: str | Mapping[str, float], key: str = "hand.close"
) -> Array:
    """Return the joint motion (n_q,) of closing by 1.

    Args:
        hand: the hand.
        synergies: the chosen set; its names are looked up first.
        wish: name of a synergy or joint, with ``-`` in front for the opposite direction, or weights by name. Joints
            that follow another one follow unless they are named.
        key: where it stands, for the error.

    Raises:
        InputError: unknown names, names of different kinds, or a direction that moves no joint.
    """
    sets = list({id(each): each for each in (synergies, *hand.synergy_sets.values())}.values())
    known = dict.fromkeys([*(name for each in sets for name in each.synergies), *hand.joint_names])
    if isinstance(wish, str):
        opposite = wish not in known and len(wish) > 1 and wish.startswith("-")
        weights = {wish[1:]: -1.0} if opposite else {wish: 1.0}
    else:
        weights = dict(wish)
    for name in weights:
        if name not in known:
            at = key if isinstance(wish, str) else f"{key}.{name}"
            raise InputError.at(at, f"synergy or joint {one_of(name, known)}", on_key=at != key)
    direction = _combined(hand, sets, weights, key)
    if not np.any(direction):
        raise InputError.at(key, "moves no joint; give a weight that is not 0")
    return frozen(direction)


def _combined(hand: Hand, sets: Sequence[SynergySet], weights: Mapping[str, float], key: str) -> Array:
    """Return the sum of the columns of the first set that has all names, or of the joints."""
    for each in sets:
        if each.name != JOINTS and all(name in each.synergies for name in weights):
            return np.asarray(each.S @ [weights.get(name, 0.0) for name in each.synergies])
    if not all(name in hand.joint_names for name in weights):
        raise InputError.at(key, "some names are of joints, some of synergies, or of two synergy sets; use one kind")
    following = {name: coupling for name, coupling in hand.couplings.items() if name not in weights}
    return np.asarray(coupling_map(hand.joint_names, following)[0] @ joint_vector(hand.joint_names, weights, {}))
