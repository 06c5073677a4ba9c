"""Whether equilibria are stable: whether the energy of hand, contacts and load has its least value there.

Unknown are the pose of the object and what gives in the hand: with ``C_q + S C_z S' = L L'`` joints are at
``q_0 + S dz_r + L y``, whose springs have the energy ``y'y / 2``. A hand may give way by itself, as a column buckles,
where the object is held as firmly as before; so the stiffness that the object feels says too little.
"""

from __future__ import annotations

import numpy as np

from synergrip.equilibrium.balance import Balance
from synergrip.linalg import Array

GIVES = 1e-12
"""Share of the largest compliance of the joints below which a direction of the hand gives nothing."""
RIGID = 1e-6
"""Compliance of a contact that has none, as a share of the largest there is at the contacts."""


def lacking_stiffness(balance: Balance) -> Array:
    """Return (T,) the least stiffness of hand and object together where it is not above 0, else 0 [N/m].

    Motions of joints and turns of the object count with the length of the grasp. With contacts that roll or slide off
    the way that they came the energy is that of the next small step.
    """
    setting, length = balance.setting, balance.setting.length
    values, vectors = np.linalg.eigh(setting.compliance)
    gives = values > GIVES * values.max(initial=0.0)
    L = vectors[:, gives] * np.sqrt(values[gives])
    count = L.shape[1]
    moves = np.zeros((setting.grasp.n_q + 6, count + 6))  # joints and pose, of y and of the pose in metres
    moves[:-6, :count], moves[-6:, count:] = L, np.diag([1.0] * 3 + [1 / length] * 3)
    whole = moves.T @ _hessian(balance) @ moves
    whole[:, range(count), range(count)] += 1.0
    if _all_above_zero(whole):
        return np.zeros(len(whole))
    values, vectors = np.linalg.eigh(whole)
    worst = vectors[:, :, 0]
    sizes = np.sum((worst[:, :count] @ L.T * length) ** 2, axis=1) + np.sum(worst[:, count:] ** 2, axis=1)
    return np.asarray(np.where(values[:, 0] > 0, 0.0, np.minimum(values[:, 0], -np.finfo(float).tiny) / sizes))


def _all_above_zero(matrices: Array) -> bool:
    """Return whether symmetric matrices (T, n, n) have no eigenvalue that is not above 0."""
    try:
        np.linalg.cholesky(matrices)
    except np.linalg.LinAlgError:
        return False
    return True


def _hessian(balance: Balance) -> Array:
    """Return (T, n_q + 6, n_q + 6) the second derivative of the energy of contacts and load by joints and pose."""
    n_q, J, G = balance.setting.grasp.n_q, balance.J, balance.G
    of_joints, of_pose, of_arms, of_object = balance.geometric
    of_springs, of_torques, of_wrench = (np.insert(each, [n_q] * 3, 0.0, axis=2) for each in balance.rolling)
    forces = np.linalg.solve(_springs(balance), np.concatenate([J, -G.mT], axis=2) + of_springs)
    upper = J.mT @ forces + np.concatenate([of_joints, of_pose], axis=2) + of_torques
    lower = -G @ forces + np.concatenate([of_arms.mT, of_object], axis=2) - of_wrench
    whole = np.concatenate([upper, lower], axis=1)
    if balance.slid is not None:
        whole = whole + balance.slid
    return np.asarray((whole + whole.mT) / 2)


def _springs(balance: Balance) -> Array:
    """Return C_s (n_l, n_l) with a little for contacts that have none."""
    C_s, J = balance.setting.grasp.C_s, balance.setting.grasp.J
    none = np.diag(C_s) == 0
    if not none.any():
        return C_s
    seen = np.diag(C_s + J @ balance.setting.compliance @ J.T).max()
    return np.asarray(C_s + np.diag(np.where(none, RIGID * (seen or 1.0), 0.0)))
