"""Theorem 1: forces alpha, rigid motion beta and redundancy gamma fix the synergy references. Equation (35).

(33) as printed asks ``Gamma_zr gamma = dz_r``, which no reference with a force part can meet; it is
read in the projected form (35), ``M dz_r = (alpha, beta, gamma)``, whose M is square and invertible.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.linalg import Array, frozen
from synergrip.statics.response import Response
from synergrip.statics.subspaces import Subspaces
from synergrip.values import Value


@dataclass(frozen=True, eq=False, repr=False)
class Coordinates(Value):
    """The change of coordinates between synergy references and (alpha, beta, gamma)."""

    M: Array
    """(n_z, n_z) rows E_s^+ dlambda/dz_r [N], Gamma_ucs^+ du/dz_r [m], Gamma_zr^+ [synergy units]."""
    inverse: Array  # (n_z, n_z)
    dimensions: tuple[int, int, int]

    @property
    def condition(self) -> float:
        """2-norm condition number of M."""
        return float(np.linalg.cond(self.M)) if self.M.size else 1.0

    def references(self, alpha: Array, beta: Array, gamma: Array) -> Array:
        """Return dz_r (..., n_z) for alpha (..., dim E_s), beta (..., dim Gamma_ucs), gamma (..., dim Gamma_zr)."""
        return np.asarray(np.concatenate([alpha, beta, gamma], axis=-1) @ self.inverse.T)

    def coordinates(self, dz_r: Array) -> tuple[Array, Array, Array]:
        """Return alpha, beta, gamma (..., dim) of references (..., n_z)."""
        forces, motions, _ = self.dimensions
        result = np.asarray(dz_r) @ self.M.T
        return result[..., :forces], result[..., forces : forces + motions], result[..., forces + motions :]


def coordinates(response: Response, spaces: Subspaces) -> Coordinates:
    """Return M of (35) and its inverse; the pseudo-inverses are taken in the scaled metric.

    All three bases are orthonormal there, so each pseudo-inverse is a transpose.
    """
    scale = response.scale
    forces = (scale.force[:, None] * spaces.E_s).T @ (scale.force[:, None] * response.dlambda_dzr)
    motions = (scale.motion @ spaces.Gamma_ucs).T @ (scale.motion @ response.du_dzr)
    M = np.vstack([forces, motions, spaces.Gamma_zr.T])
    rows = np.linalg.norm(M, axis=1, keepdims=True)  # N, m and 1 in one matrix: equilibrate before inverting
    inverse = np.linalg.inv(M / rows) / rows.T
    return Coordinates(frozen(M), frozen(inverse), spaces.dimensions)


def motion_coordinates(response: Response, spaces: Subspaces, motion: Array) -> tuple[Array, Array]:
    """Project object motions (..., 6) on Gamma_ucs.

    Returns:
        beta (..., dim Gamma_ucs) [m] and the part outside Gamma_ucs (..., 6) [m, rad].
    """
    scaled_basis = response.scale.motion @ spaces.Gamma_ucs
    beta = response.scale.twist(motion) @ scaled_basis
    return beta, np.asarray(motion) - beta @ spaces.Gamma_ucs.T
