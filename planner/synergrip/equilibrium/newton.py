"""Newton's method on the equations of equilibrium, at many instants at once."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from synergrip.equilibrium.balance import Balance
from synergrip.equilibrium.setting import Setting
from synergrip.equilibrium.states import Loads, States
from synergrip.linalg import Array
from synergrip.vectors import rotation_matrices

AT_REST = 1e-11
"""Error of `Balance.error` that counts as equilibrium."""
FINE = 1e-12
"""An error from which another iteration is made, if only one: two ways to the same state then agree to its digits."""
ROUGH = 1e-6
"""An error of states that are known well enough to tell promise from truth."""
NEAR = 1e-3
"""An error below which the derivatives of the state before are as good: they leave out as much."""
SAME = 1e-5
"""How much forces, of the largest, and joints [rad, m] may differ for derivatives to be told of as the same."""
MOST = 40
LOST = 1e3
"""An error that no iteration comes back from."""
LARGEST_STEP = 0.2
"""How far one iteration may move joints [rad] and the object over the length of the grasp."""


def settled(
    setting: Setting, states: States, loads: Loads, references: Array, known: Balance | None = None,
    enough: Callable[[Array], bool] | None = None,
) -> tuple[Balance, int]:  # fmt: skip
    """Return the equations at the states that Newton's method ends with, and how many iterations it took.

    Rolling contacts remember the way they came: the first state follows the start, each other the one before it.

    Args:
        setting: the grasp.
        states: (T) where to begin.
        loads: (T) on the object.
        references: (T, n_z) synergy references.
        known: the equations at the same states, under other references, when they are known.
        enough: asked once, of forces (T, n_l) that are known to `ROUGH`: whether more digits are of no use.

    Returns:
        the equations; whose `error` is above `AT_REST` where the method did not converge.
    """
    balance = Balance.of(setting, states, loads, references) if known is None else known.under(loads, references)
    inverse = None if known is None else known.inverse
    found, rested = None if known is None else known.states, None
    for count in range(MOST):
        error = balance.error
        if not np.all(error <= AT_REST):
            if rested is not None or not np.all(error < LOST):
                balance = rested or balance
                break
        elif rested is not None or np.all(error <= FINE):
            break
        else:
            rested = balance
        if enough is not None and np.all(error <= ROUGH):
            if enough(balance.states.forces):
                break
            enough = None
        if inverse is None:
            inverse, found = balance.inverse, balance.states
        elif count and len(far := np.flatnonzero(error > NEAR)):
            inverse, found = inverse.copy(), None
            inverse[far] = balance.taken(far).inverse
        moved = _moved(setting, balance.states, _step(balance, inverse))
        balance = Balance.of(setting, moved, loads, references, balance)
    return replace(balance, known_inverse=inverse) if _same(found, balance.states) else balance, count


def at_rest(balance: Balance) -> Array:
    """Return which (T,) of the states are equilibria."""
    return np.asarray(balance.error <= AT_REST)


def on_faces(balance: Balance) -> int:
    """Return how many instants pass before a contact leaves its face."""
    return int(balance.meeting.left.min(initial=len(balance.states)))


def why_not(balance: Balance) -> str:
    """Return why there is no equilibrium to go on to."""
    names = balance.setting.grasp.contact_names
    off = [name for name, left in zip(names, balance.meeting.left, strict=True) if left < len(balance.states)]
    if off and at_rest(balance)[0]:
        return f"contact '{off[0]}' runs over the edge of its face there"
    return "no equilibrium is near: the hand does not follow there"


def _step(balance: Balance, inverse: Array) -> Array:
    """Return Newton's step (T, n_l + n_q + 6) at every state, shortened where it is long."""
    steps = -(inverse @ np.concatenate(balance.residuals, axis=1)[:, :, None])[:, :, 0]
    n_l, length = balance.setting.grasp.n_l, balance.setting.length
    turned, shifted = np.abs(steps[:, n_l:-6]).max(axis=1, initial=0.0), np.abs(steps[:, -6:-3]).max(axis=1)
    largest = np.maximum(np.maximum(turned, shifted / length), np.abs(steps[:, -3:]).max(axis=1))
    return np.asarray(steps * np.minimum(1.0, LARGEST_STEP / np.maximum(largest, 1e-300))[:, None])


def _same(one: States | None, other: States) -> bool:
    """Return whether derivatives at some states are those at others, to the digits that are told of them."""
    if one is None:
        return False
    forces = np.abs(one.forces - other.forces).max(initial=0.0) <= SAME * np.abs(other.forces).max(initial=0.0)
    return bool(forces and np.abs(one.q - other.q).max(initial=0.0) <= SAME)


def _moved(setting: Setting, states: States, change: Array) -> States:
    n_l = setting.grasp.n_l
    forces, joints, shift, turn = np.split(change, [n_l, change.shape[1] - 6, change.shape[1] - 3], axis=1)
    rotation = rotation_matrices(turn) @ states.rotation
    return States(states.q + joints, states.position + shift, rotation, states.forces + forces)
