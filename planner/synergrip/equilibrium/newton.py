"""Newton's method on the equations of equilibrium, at many instants at once."""

from __future__ import annotations

import numpy as np

from synergrip.equilibrium.balance import Balance
from synergrip.equilibrium.setting import Setting
from synergrip.equilibrium.states import Loads, States
from synergrip.linalg import Array

AT_REST = 1e-10
"""Error of `Balance.error` that counts as equilibrium."""
MOST = 40
LOST = 1e3
"""An error that no iteration comes back from."""
LARGEST_STEP = 0.2
"""How far one iteration may move joints [rad] and the object over the length of the grasp."""


def settled(setting: Setting, states: States, loads: Loads, references: Array) -> tuple[Balance, int]:
    """Return the equations at the states that Newton's method ends with, and how many iterations it took.

    Rolling contacts remember the way they came: the first state follows the start, each other the one before it.

    Args:
        setting: the grasp.
        states: (T) where to begin.
        loads: (T) on the object.
        references: (T, n_z) synergy references.

    Returns:
        the equations; whose `error` is above `AT_REST` where the method did not converge.
    """
    balance, last = Balance.of(setting, states, loads, references), False
    for count in range(MOST):
        if last or not np.all(balance.error < LOST):
            return balance, count
        last = bool(np.all(at_rest(balance)))  # one iteration more makes all digits of that
        moved = _moved(setting, balance.states, _steps(balance))
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


def _steps(balance: Balance) -> Array:
    """Return Newton's step (T, n_l + n_q + 6) at every state, shortened where it is long; 0 where it is singular."""
    right = -np.concatenate(balance.residuals, axis=1)
    tangent, scale = balance.tangent, _sizes(balance)
    scaled = tangent * scale
    rows = np.abs(scaled).max(axis=2, initial=0.0)
    rows = np.where(rows > 0, rows, 1.0)
    try:
        steps = np.linalg.solve(scaled / rows[:, :, None], (right / rows)[:, :, None])[:, :, 0] * scale
    except np.linalg.LinAlgError:
        steps = np.stack([np.linalg.lstsq(a / r[:, None], b / r, rcond=None)[0] * scale
                          for a, b, r in zip(scaled, right, rows, strict=True)])  # fmt: skip
    n_l, length = balance.setting.grasp.n_l, balance.setting.length
    turned, shifted = np.abs(steps[:, n_l:-6]).max(axis=1, initial=0.0), np.abs(steps[:, -6:-3]).max(axis=1) / length
    largest = np.maximum(np.maximum(turned, shifted), np.abs(steps[:, -3:]).max(axis=1))
    return np.asarray(steps * np.minimum(1.0, LARGEST_STEP / np.maximum(largest, 1e-300))[:, None])


def _sizes(balance: Balance) -> Array:
    """Return (n,) sizes of forces, joints and motions that bring the columns of the tangent near each other."""
    grasp, length = balance.setting.grasp, balance.setting.length
    force = max(float(np.abs(balance.states.forces).max(initial=0.0)), 1e-3)
    moments = [length if component.startswith("m") else 1.0 for _, component in grasp.components]
    return np.concatenate([force * np.array(moments), np.ones(grasp.n_q), [length] * 3, np.ones(3)])


def _moved(setting: Setting, states: States, change: Array) -> States:
    from scipy.spatial.transform import Rotation

    n_l = setting.grasp.n_l
    forces, joints, shift, turn = np.split(change, [n_l, change.shape[1] - 6, change.shape[1] - 3], axis=1)
    rotation = Rotation.from_rotvec(turn).as_matrix() @ states.rotation
    return States(states.q + joints, states.position + shift, rotation, states.forces + forces)
