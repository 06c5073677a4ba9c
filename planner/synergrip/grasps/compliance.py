"""Springs in a row: what joints give with the synergies behind them, and contacts with the joints behind these."""

from __future__ import annotations

import numpy as np

from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array


def joint_compliance(C_q: Array, S: Array, C_z: Array) -> Array:
    """Return ``C_q + S C_z S'`` (..., n_q, n_q) [rad/(N m)]: of the joints with the synergies behind them."""
    return np.asarray(C_q + S @ C_z @ S.mT)


def total_compliance(C_s: Array, J: Array, of_joints: Array) -> Array:
    """Return ``C = C_s + J (C_q + S C_z S') J'`` (..., n_l, n_l) [m/N], of the contacts with all behind them.

    Args:
        C_s: (..., n_l, n_l) of the contacts alone [m/N].
        J: (..., n_l, n_q) hand Jacobian.
        of_joints: (..., n_q, n_q) their `joint_compliance`.
    """
    return np.asarray(C_s + J @ of_joints @ J.mT)


def compliance_of(grasp: Grasp) -> Array:
    """Return the total compliance (n_l, n_l) [m/N] of a grasp."""
    return total_compliance(grasp.C_s, grasp.J, joint_compliance(grasp.C_q, grasp.S, grasp.C_z))
