"""Theorem 1: forces alpha, rigid motion beta and redundancy gamma fix the synergy references. Equation (35).

(33) as printed asks ``Gamma_zr gamma = dz_r``, which no reference with a force part can meet; it is
read in the projected form (35), ``M dz_r = (alpha, beta, gamma)``, whose M is square and invertible.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from synergrip.documents.judging import as_numbers, described, expected
from synergrip.documents.naming import naming_arguments
from synergrip.errors import InputError
from synergrip.grasps.scale import Metric
from synergrip.linalg import Array, frozen, inverse_of
from synergrip.statics.response import Maps, Response
from synergrip.statics.subspaces import Bases, Subspaces
from synergrip.values import Value


@dataclass(frozen=True, eq=False, repr=False)
class Coordinates(Value):
    """The change of coordinates between synergy references and (alpha, beta, gamma), of one grasp or of each of many.

    Of many (leading axes ...) the references are (..., T, n_z), T for each grasp, and so are the coordinates.
    """

    M: Array
    """(..., n_z, n_z) rows E_s^+ dlambda/dz_r [N], Gamma_ucs^+ du/dz_r [m], Gamma_zr^+ [synergy units]."""
    inverse: Array  # (..., n_z, n_z)
    dimensions: tuple[int, int, int]

    @property
    def condition(self) -> float:
        """2-norm condition number of M; the largest, of many."""
        return float(np.linalg.cond(self.M).max(initial=1.0)) if self.M.size else 1.0

    @cached_property
    def row_sizes(self) -> Array:
        """(..., n_z) the lengths of the rows of M."""
        return np.asarray(np.linalg.norm(self.M, axis=-1))

    @cached_property
    def reach(self) -> tuple[Array, Array]:
        """How large (..., n_z) each reference is at most for forces up to 1 N; (..., n_z, dim Gamma_ucs) for beta."""
        forces, motions, _ = self.dimensions
        size = np.abs(self.inverse)
        return size[..., :forces].sum(axis=-1), size[..., forces : forces + motions]

    def references(self, alpha: Array, beta: Array, gamma: Array) -> Array:
        """Return dz_r (..., n_z) for alpha (..., dim E_s), beta (..., dim Gamma_ucs), gamma (..., dim Gamma_zr)."""
        given = {"alpha": alpha, "beta": beta, "gamma": gamma}
        parts = [_judged(name, given[name], self.M, size) for name, size in zip(given, self.dimensions, strict=True)]
        for name, part in zip(given, parts, strict=True):
            if part.shape[:-1] != parts[0].shape[:-1]:
                what = f"as many rows as alpha, {parts[0].shape[:-1]} before the last axis; got {part.shape[:-1]}"
                raise InputError.at(name, f"expected {what}")
        return np.asarray(np.concatenate(parts, axis=-1) @ self.inverse.mT)

    def coordinates(self, dz_r: Array) -> tuple[Array, Array, Array]:
        """Return alpha, beta, gamma (..., dim) of references (..., n_z)."""
        forces, motions, _ = self.dimensions
        result = _judged("dz_r", dz_r, self.M, self.M.shape[-1]) @ self.M.mT
        return result[..., :forces], result[..., forces : forces + motions], result[..., forces + motions :]


def _judged(name: str, value: object, M: Array, size: int) -> Array:
    """Return numbers (..., size) of the grasp or grasps of M.

    Raises:
        InputError: something else.
    """
    found, many = as_numbers(value), M.ndim - 2
    if found is None or found.ndim <= many or found.shape[-1:] != (size,) or (many and len(found) not in (1, len(M))):
        shape = f"({len(M)}, ..., {size}), a row for each grasp" if many else f"(..., {size})"
        raise InputError.at(name, f"expected numbers of shape {shape}; got {described(value)}")
    return found


@naming_arguments
def coordinates(response: Response, spaces: Subspaces) -> Coordinates:
    """Return M of (35) and its inverse; the pseudo-inverses are taken in the scaled metric.

    Args:
        response: of the grasp, from `respond`.
        spaces: of the same grasp, from `subspaces`.

    Returns:
        what tells alpha, beta and gamma of references, and back.

    Raises:
        InputError: no response, or no subspaces.

    Example:
        >>> response = respond(grasp)
        >>> coordinates(response, subspaces(response)).M.shape
        (4, 4)
    """
    expected("response", response, Response, "respond(grasp)")
    expected("spaces", spaces, Subspaces, "subspaces(response)")
    return coordinates_of(response, spaces, response.scale)


def coordinates_of(maps: Maps, bases: Bases, metric: Metric) -> Coordinates:
    """Return M of (35) and its inverse for one grasp, or for each of many (leading axes).

    All three bases are orthonormal in the scaled metric, so each pseudo-inverse is a transpose.
    """
    force, motion = metric.force[..., None], metric.motion
    forces = (force * bases.E_s).mT @ (force * maps.dlambda_dzr)
    motions = (motion @ bases.Gamma_ucs).mT @ (motion @ maps.du_dzr)
    M = np.concatenate([forces, motions, bases.Gamma_zr.mT], axis=-2)
    rows = np.linalg.norm(M, axis=-1, keepdims=True)  # N, m and 1 in one matrix: equilibrate before inverting
    sizes = np.where(rows > 0, rows, 1.0)  # 0, and M without inverse, where an equilibrium is about to be lost
    return Coordinates(frozen(M), frozen(inverse_of(M / sizes) / sizes.mT), bases.dimensions)


def motion_coordinates(response: Response, spaces: Subspaces, motion: Array) -> tuple[Array, Array]:
    """Project object motions (..., 6) on Gamma_ucs.

    Returns:
        beta (..., dim Gamma_ucs) [m] and the part outside Gamma_ucs (..., 6) [m, rad].
    """
    scaled_basis = response.scale.motion @ spaces.Gamma_ucs
    beta = response.scale.twist(motion) @ scaled_basis
    return beta, np.asarray(motion) - beta @ spaces.Gamma_ucs.T
