"""Newton's method on the equations of equilibrium, at many instants at once."""

from __future__ import annotations

import numpy as np

from synergrip.equilibrium.balance import Balance
from synergrip.equilibrium.setting import Setting
from synergrip.equilibrium.states import Loads, States
from synergrip.linalg import Array

AT_REST = 1e-11
"""Error of `Balance.error` that counts as equilibrium."""
FINE = 1e-12
"""An error from which another iteration is made, if only one: two ways to the same state then agree to its digits."""
NEAR = 1e-3
"""An error below which the derivatives of the state before are as good: they leave out as much."""
MOST = 40
LOST = 1e3
"""An error that no iteration comes back from."""
LARGEST_STEP = 0.2
"""How far one iteration may move joints [rad] and the object over the length of the grasp."""


def settled(
    setting: Setting, states: States, loads: Loads, references: Array, known: Balance | None = None
) -> tuple[Balance, int]:
    """Return the equations at the states that Newton's method ends with, and how many iterations it took.

    Rolling contacts remember the way they came: the first state follows the start, each other the one before it.

    Args:
        setting: the grasp.
        states: (T) where to begin.
        loads: (T) on the object.
        references: (T, n_z) synergy references.
        known: the equations at the same states, under other references, when they are known.

    Returns:
        the equations; whose `error` is above `AT_REST` where the method did not converge.
    """
    balance = Balance.of(setting, states, loads, references, known)
    inverse, rested = None if known is None else known.inverse, None
    for count in range(MOST):
        if not np.all(at_rest(balance)):
            if rested is not None or not np.all(balance.error < LOST):
                return rested or balance, count
        elif rested is not None or np.all(balance.error <= FINE):
            return balance, count
        else:
            rested = balance
        if inverse is None or (count and np.any(balance.error > NEAR)):
            inverse = balance.inverse
        moved = _moved(setting, balance.states, _step(balance, inverse))
        balance = Balance.of(setting, moved, loads, references, balance)
    return balance, MOST


def at_rest(balance: Balance) -> Array:
    """Return which (T,) of the states are equilibria."""
    return np.asarray(balance.error <= AT_REST)


def on_faces(balance: Balance) -> int:
    """Return how many instants pass before a contact leaves its face."""
    return int(balance.meeting.left.min(initial=len(balance.states)))


def why_not(balance: Balance) -> str:
    """Return why there is no equilibrium to go on to."""
    names = [contact.name for contact in balance.setting.grasp.contacts]
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


def _moved(setting: Setting, states: States, change: Array) -> States:
    from scipy.spatial.transform import Rotation

    n_l = setting.grasp.n_l
    forces, joints, shift, turn = np.split(change, [n_l, change.shape[1] - 6, change.shape[1] - 3], axis=1)
    rotation = Rotation.from_rotvec(turn).as_matrix() @ states.rotation
    return States(states.q + joints, states.position + shift, rotation, states.forces + forces)
