"""The direction in which a hand closes, from the names of synergies or joints."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from synergrip.errors import InputError
from synergrip.hands.hand import Hand, SynergySet
from synergrip.hands.synergies.matrix import coupling_map, joint_vector, names_known, set_named
from synergrip.linalg import Array, frozen


def closing_direction(hand: Hand, synergies: SynergySet, wish: str | Mapping[str, float], key: str = "close") -> Array:
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
    if isinstance(wish, str):
        opposite = len(wish) > 1 and wish.startswith("-") and wish not in names_known(hand, synergies)
        weights = {wish[1:]: -1.0} if opposite else {wish: 1.0}
    else:
        weights = dict(wish)
    keys = {name: key if isinstance(wish, str) else f"{key}.{name}" for name in weights}
    direction = _combined(hand, set_named(hand, synergies, keys, key), weights)
    if not np.any(direction):
        raise InputError.at(key, "moves no joint; give a weight that is not 0")
    return frozen(direction)


def _combined(hand: Hand, chosen: SynergySet | None, weights: Mapping[str, float]) -> Array:
    """Return the sum of the columns of a set, or of the joints when there is none."""
    if chosen is not None:
        return np.asarray(chosen.S @ [weights.get(name, 0.0) for name in chosen.synergies])
    following = {name: coupling for name, coupling in hand.couplings.items() if name not in weights}
    return np.asarray(coupling_map(hand.joint_names, following)[0] @ joint_vector(hand.joint_names, weights, {}))
