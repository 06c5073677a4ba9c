"""What the synergies control: E_s, Gamma_ucs and Gamma_zr. Equations (29) and (31).

All ranks are decided on matrices that hold no compliance (the dimensions do not depend on it) and
no units. ``Gamma_zr`` and ``Gamma_zcs`` are cut from one null space, so (34) holds by construction,
and the rank of the force map is decided once more by itself as a check.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from synergrip.linalg import SINGULAR, Array, Decision, canonical, frozen, split
from synergrip.statics.response import Response
from synergrip.values import Value


@dataclass(frozen=True, eq=False, repr=False)
class Subspaces(Value):
    """Bases of the controlled subspaces. Each is determined by its subspace alone (fixed order and sign)."""

    E_s: Array
    """(n_l, dim) controllable internal forces; orthonormal with spin moments divided by the length."""
    Gamma_ucs: Array
    """(6, dim) rigid object motions about B; orthonormal in the scaled coordinates of `Scale` [m]."""
    Gamma_zcs: Array
    """(n_z, dim) the synergy motions that go with Gamma_ucs: ``J S Gamma_zcs = G' Gamma_ucs``."""
    Gamma_zr: Array
    """(n_z, dim) synergy motions that move no contact; orthonormal."""
    decisions: Mapping[str, Decision]
    """The singular values behind each dimension, relative to the size that counts as 1."""

    @property
    def dimensions(self) -> tuple[int, int, int]:
        """Dimensions of E_s, Gamma_ucs and Gamma_zr; their sum is n_z (34)."""
        return self.E_s.shape[1], self.Gamma_ucs.shape[1], self.Gamma_zr.shape[1]

    @property
    def ambiguous(self) -> bool:
        """True when a singular value lies in the grey zone, or the force map disagrees with (34)."""
        return any(decision.ambiguous for decision in self.decisions.values())

    def __repr__(self) -> str:
        """Return the dimensions."""
        forces, motions, redundant = self.dimensions
        doubt = ", ambiguous" * self.ambiguous
        return f"Subspaces(dim E_s {forces}, Gamma_ucs {motions}, Gamma_zr {redundant}{doubt})"


def subspaces(response: Response) -> Subspaces:
    """Return the controlled subspaces of a grasp (29), (31).

    Uses ``J S`` and not the print's ``J X S Y``: for C_s > 0 the null spaces agree, and for C_s = 0
    only ``J S`` gives the force-free motions (docs/theory.md).
    """
    grasp, scale = response.grasp, response.scale
    Gt = grasp.G.T @ np.linalg.inv(scale.motion) / scale.force[:, None]  # (n_l, 6), scaled
    JS = grasp.J @ grasp.S / scale.force[:, None]
    size = _size(JS, grasp.J / scale.force[:, None], grasp.S)
    held = np.linalg.qr(Gt)[0]
    against = split(JS - held @ (held.T @ JS), size)  # contact motion that no rigid object motion follows
    free = against.null_space  # (n_z, dim Gamma_zcs + dim Gamma_zr)
    within = split(JS @ free, size)
    Gamma_zr = canonical(free @ within.null_space)
    Gamma_zcs, moved = _rigid_motions(free @ within.row_space, JS, Gt)
    E_s, forces = _forces(response, against.decision.rank, Gt)
    decisions = {
        "restraint": response.restraint,
        "redundancy": split(JS, size).decision,
        "rigid": against.decision,
        "forces": forces,
    }
    return Subspaces(E_s, frozen(np.linalg.solve(scale.motion, moved)), Gamma_zcs, Gamma_zr, decisions)


def _size(JS: Array, J: Array, S: Array) -> float:
    """Return the largest singular value of J S, or 0 when J S is nothing but rounding."""
    value = float(np.linalg.norm(JS, 2)) if JS.size else 0.0
    return value if value > SINGULAR * np.linalg.norm(J, 2) * np.linalg.norm(S, 2) else 0.0


def _rigid_motions(synergies: Array, JS: Array, Gt: Array) -> tuple[Array, Array]:
    """Return Gamma_zcs and scaled Gamma_ucs, the latter orthonormal and canonical."""
    if synergies.shape[1] == 0:
        return frozen(synergies), np.zeros((6, 0))
    motions = np.asarray(np.linalg.lstsq(Gt, JS @ synergies, rcond=None)[0], dtype=np.float64)
    basis = canonical(motions)
    coordinates = np.linalg.lstsq(motions, basis, rcond=None)[0]  # basis = motions @ coordinates
    return frozen(synergies @ coordinates), basis


def _forces(response: Response, rank: int, Gt: Array) -> tuple[Array, Decision]:
    """Return E_s with the `rank` that the kinematics dictates, and the force map's own decision.

    A singular value of the map counts when the map is known that well; how far it is below the largest says nothing,
    because it comes with stiffnesses.
    """
    force, known = response.scale.force, response.accuracy["dlambda_dzr"]
    scaled = force[:, None] * response.dlambda_dzr
    vectors, values, _ = np.linalg.svd(scaled, full_matrices=False)
    noise = max(known.unknown, np.finfo(float).eps * known.size) * np.sqrt(scaled.size)
    counted = int(np.sum(values > noise))
    # grey values are no news here: they come with stiff contacts, and (34) has settled the rank
    decision = Decision(counted, frozen(values / values[0] if counted else 0 * values), counted != rank)
    internal = vectors[:, :rank]
    held = np.linalg.qr(Gt)[0]
    internal = internal - held @ (held.T @ internal)  # G E_s = 0 to the last digit
    return frozen(canonical(internal) / force[:, None]), decision
