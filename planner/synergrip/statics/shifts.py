"""What contact forces and the object do where contact springs are shifted by g at references that stay.

A contact that meets the object early shifts its own springs, a joint that goes elsewhere those of all that it carries.
With the total compliance C of contacts, joints and synergies,

    C dlambda + G' du = g,    G dlambda = 0,    so    dlambda = (I - G+ G) K g,    K = C^-1
"""

from __future__ import annotations

import numpy as np

from synergrip.grasps.compliance import compliance_of
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array, frozen

EVEN = 1e3
"""[N/m] brings lengths and forces of a grasp to one size."""


def of_shifts(C: Array, G: Array, shifts: Array) -> tuple[Array, Array]:
    """Return what k shifts change of the contact forces (..., n_l, k) [N, N m] and of the object (..., 6, k) [m, rad].

    An object that is free to move stays as far as it is free.

    Args:
        C: (..., n_l, n_l) total compliance [m/N].
        G: (..., 6, n_l) grasp matrix.
        shifts: (n_l, k) of the contacts' springs [m, rad].
    """
    n_l = G.shape[-1]
    upper = np.concatenate([C * EVEN, G.mT], axis=-1)
    lower = np.concatenate([G, np.zeros((*G.shape[:-1], 6))], axis=-1)
    inverse = np.linalg.pinv(np.concatenate([upper, lower], axis=-2))
    answer = inverse[..., :n_l] @ (shifts * EVEN)
    return answer[..., :n_l, :], answer[..., n_l:, :] / EVEN


def normal_stiffness(grasp: Grasp) -> Array:
    """Return by how much the normal force of each contact (n_c,) [N/m] changes with its own gap.

    That is the stiffness of contact, joints and synergies, with the object free to give way to the other contacts.
    """
    forces, _ = of_shifts(compliance_of(grasp), grasp.G, np.eye(grasp.n_l))
    return frozen(np.diag(forces)[np.asarray(grasp.normal_rows)])
