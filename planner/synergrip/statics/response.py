"""How forces and motions answer to synergy references and to the external wrench. Equations (17)-(28).

With the total compliance ``C = C_s + J C_q J' + J S C_z S' J'`` and ``K = C^-1`` everything is one
linear system, so C_q = 0 and C_z = 0 are ordinary values and the paper's X (24) and Y (25) are
never formed (docs/theory.md).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.errors import Issue, RigidContactError
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.scale import Scale, scale_of
from synergrip.linalg import SINGULAR, Array, Decision, frozen
from synergrip.statics.restraint import restraint


@dataclass(frozen=True)
class Response:
    """Linear maps of a restrained grasp, SI units. Forces act on the object."""

    grasp: Grasp
    scale: Scale
    restraint: Decision
    """The rank decision on G'."""
    K: Array  # (n_l, n_l) total stiffness [N/m], synergy compliance included
    right_inverse: Array  # (n_l, 6) G+ = K G' (G K G')^-1
    dlambda_dzr: Array  # (n_l, n_z) (28)
    du_dzr: Array  # (6, n_z) (27)
    dtau_dzr: Array  # (n_q, n_z)
    dsigma_dzr: Array  # (n_z, n_z)
    dz_dzr: Array  # (n_z, n_z) (25)
    dq_dzr: Array  # (n_q, n_z) (26)
    dlambda_dw: Array  # (n_l, 6) = -G+
    du_dw: Array  # (6, 6) = (G K G')^-1: the object sags under load
    dq_dw: Array  # (n_q, 6)


def respond(grasp: Grasp, load: Array | None = None) -> Response:
    """Return the response maps of a grasp.

    Args:
        grasp: the grasp.
        load: (T, 6) wrenches it is to hold, for a refusal to tell about (default: w_0).

    Raises:
        NotRestrainedError: the contacts leave the object a free motion.
        RigidContactError: some contact direction has no compliance at all.
    """
    scale = scale_of(grasp)
    decision = restraint(grasp, scale, np.atleast_2d(grasp.w_0) if load is None else load)
    K = _stiffness(grasp, scale)
    G, JS = grasp.G, grasp.J @ grasp.S
    moved = np.linalg.inv(scale.motion)  # u = moved u~; G K G' is inverted in scaled coordinates
    scaled_G = moved.T @ G
    du_dw = moved @ np.linalg.solve(scaled_G @ K @ scaled_G.T, moved.T)
    du_dw = (du_dw + du_dw.T) / 2
    right_inverse = K @ G.T @ du_dw
    # with K ill-conditioned the maps lose digits of what they are by definition: G G+ = I, G d lambda = 0, and no
    # force where the object follows rigidly; one refinement of each brings them back
    plain = np.linalg.pinv(scaled_G / scale.force) / scale.force[:, None] @ moved.T
    right_inverse = right_inverse + plain @ (np.eye(6) - G @ right_inverse)
    du_dzr = right_inverse.T @ JS
    du_dzr = du_dzr + right_inverse.T @ (JS - G.T @ du_dzr)
    dlambda_dzr = K @ (JS - G.T @ du_dzr)
    dlambda_dzr = dlambda_dzr - plain @ (G @ dlambda_dzr)
    dtau_dzr = grasp.J.T @ dlambda_dzr
    dsigma_dzr = grasp.S.T @ dtau_dzr
    dz_dzr = np.eye(grasp.n_z) - grasp.C_z @ dsigma_dzr
    dtau_dw = -grasp.J.T @ right_inverse
    return Response(
        grasp, scale, decision, frozen(K), frozen(right_inverse),
        frozen(dlambda_dzr), frozen(du_dzr), frozen(dtau_dzr), frozen(dsigma_dzr), frozen(dz_dzr),
        frozen(grasp.S @ dz_dzr - grasp.C_q @ dtau_dzr),
        frozen(-right_inverse), frozen(du_dw),
        frozen(-grasp.S @ (grasp.C_z @ (grasp.S.T @ dtau_dw)) - grasp.C_q @ dtau_dw),
    )  # fmt: skip


def total_compliance(grasp: Grasp) -> Array:
    """Return C (n_l, n_l), the sum of contact, joint and synergy compliance seen at the contacts [m/N]."""
    JS = grasp.J @ grasp.S
    return np.asarray(grasp.C_s + grasp.J @ grasp.C_q @ grasp.J.T + JS @ grasp.C_z @ JS.T)


def _stiffness(grasp: Grasp, scale: Scale) -> Array:
    """Invert C, each row and column divided by its own size first so that no unit decides."""
    C = total_compliance(grasp)
    diagonal = np.diag(C)
    largest = float(np.max(diagonal * scale.force**-2, initial=0.0))
    rigid = diagonal * scale.force**-2 <= SINGULAR * largest
    if np.any(rigid) or largest <= 0:
        raise _rigid(grasp, int(np.argmax(rigid)))
    root = np.sqrt(diagonal)
    values, vectors = np.linalg.eigh(C / np.outer(root, root))
    if values[0] < SINGULAR * len(C):
        raise _rigid(grasp, int(np.argmax(np.abs(vectors[:, 0]))))
    K: Array = (vectors / values) @ vectors.T / np.outer(root, root)
    return np.asarray((K + K.T) / 2)


def _rigid(grasp: Grasp, row: int) -> RigidContactError:
    contact, component = grasp.components[row]
    message = (
        f"the force component {component} of contact {contact} has no compliance: contact, joints and synergies are "
        "all rigid in that direction, so the force along it is undetermined (hyperstatic); let the contact yield there"
    )
    return RigidContactError([Issue(message, key="C_s")], contact, component)
