"""What the synergies control: E_s, Gamma_ucs and Gamma_zr. Equations (29) and (31).

All ranks are decided on matrices that hold no compliance (the dimensions do not depend on it) and
no units. ``Gamma_zr`` and ``Gamma_zcs`` are cut from one null space, so (34) holds by construction,
and the rank of the force map is decided once more by itself as a check.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from synergrip.documents.judging import expected
from synergrip.documents.naming import naming_arguments
from synergrip.grasps.scale import Metric
from synergrip.grasps.stack import Matrices
from synergrip.linalg import (
    SINGULAR,
    Array,
    Decision,
    Decisions,
    Places,
    canonical,
    frozen,
    left_singular,
    right_singular,
    singular_values,
)
from synergrip.statics.response import Response
from synergrip.statics.restraint import supported
from synergrip.values import ByName, Value


@dataclass(frozen=True, eq=False, repr=False)
class Bases(Value):
    """Bases of the controlled subspaces of one grasp, or of each of many (leading axes ...).

    Each is determined by its subspace alone (fixed order and sign).
    """

    E_s: Array
    """(..., n_l, dim) controllable internal forces; orthonormal with spin moments divided by the length."""
    Gamma_ucs: Array
    """(..., 6, dim) rigid object motions about B; orthonormal in the scaled coordinates of `Scale` [m]."""
    Gamma_zcs: Array
    """(..., n_z, dim) the synergy motions that go with Gamma_ucs: ``J S Gamma_zcs = G' Gamma_ucs``."""
    Gamma_zr: Array
    """(..., n_z, dim) synergy motions that move no contact; orthonormal."""

    @property
    def dimensions(self) -> tuple[int, int, int]:
        """Dimensions of E_s, Gamma_ucs and Gamma_zr; their sum is n_z (34)."""
        return self.E_s.shape[-1], self.Gamma_ucs.shape[-1], self.Gamma_zr.shape[-1]


@dataclass(frozen=True, eq=False, repr=False)
class Subspaces(Bases):
    """The bases of one grasp, and how their dimensions were decided."""

    decisions: Mapping[str, Decision]
    """The singular values behind each dimension, relative to the size that counts as 1."""

    @property
    def ambiguous(self) -> bool:
        """True when a singular value lies in the grey zone, or the force map disagrees with (34)."""
        return any(decision.ambiguous for decision in self.decisions.values())

    def __repr__(self) -> str:
        """Return the dimensions."""
        forces, motions, redundant = self.dimensions
        doubt = ", ambiguous" * self.ambiguous
        return f"Subspaces(dim E_s {forces}, Gamma_ucs {motions}, Gamma_zr {redundant}{doubt})"


@naming_arguments
def subspaces(response: Response) -> Subspaces:
    """Return the controlled subspaces of a grasp (29), (31).

    Uses ``J S`` and not the print's ``J X S Y``: for C_s > 0 the null spaces agree, and for C_s = 0
    only ``J S`` gives the force-free motions (docs/theory.md).

    Args:
        response: of the grasp, from `respond`.

    Returns:
        bases of the forces that the synergies control, of the motions without a change of forces, and of what moves
        neither, with the rank decisions behind them.

    Raises:
        InputError: no response.

    Example:
        >>> subspaces(respond(grasp)).dimensions
        (3, 1, 0)
    """
    expected("response", response, Response, "respond(grasp)")
    scale = response.scale
    matrices, metric = supported(Matrices.of(response.grasp), scale, response.free)
    moved = ContactMotions.of(matrices, metric, metric.scaled_grasp(matrices.G))
    rank, known = int(moved.rigid.ranks), response.accuracy["dlambda_dzr"]
    moving = moved.moving(rank)
    E_s, forces = controllable_forces(response.dlambda_dzr, np.array(known.unknown), moved, response.scale, rank)
    Gamma_ucs, Gamma_zcs, Gamma_zr = free_motions(moved, moving, response.scale, int(moving.ranks))
    found = {"redundancy": moved.redundancy, "rigid": moved.rigid, "forces": forces}
    decisions = {"restraint": response.restraint, **{name: each.at(()) for name, each in found.items()}}
    return Subspaces(E_s, Gamma_ucs, Gamma_zcs, Gamma_zr, ByName("decisions", decisions))


@dataclass(frozen=True, eq=False, repr=False)
class Moving(Value):
    """Synergy motions that cost no force, split into those that move contacts and those that move none."""

    ranks: Places  # (...)
    directions: Array
    """(..., n_z, dim) orthonormal; as many as `ranks` says move contacts, the rest move none."""

    def taken(self, places: Any) -> Moving:
        """Return those of some grasps of a stack."""
        return Moving(self.ranks[places], self.directions[places])


@dataclass(frozen=True, eq=False, repr=False)
class ContactMotions(Value):
    """How object and synergies move the contacts, in scaled coordinates; leading axes (...) for many grasps."""

    along: Array
    """(..., 6, n_z) contact motion of synergies that a rigid object motion follows, in the basis of the range of G'."""
    triangle: Array
    """(..., 6, 6) contact motion of object motions in that basis."""
    internal: Array
    """(..., n_l, n_l - 6) orthonormal basis of the null space of G: internal forces; n_l counts supports, too."""
    sizes: Array
    """(...) The largest singular value of J S, or 0 where J S is nothing but rounding."""
    redundancy: Decisions
    """On J S."""
    rigid: Decisions
    """On contact motion of synergies that no rigid object motion follows."""
    directions: Array
    """(..., n_z, n_z) the synergy motions, orthonormal, behind the singular values of `rigid`."""

    @classmethod
    def of(cls, matrices: Matrices, metric: Metric, of_object: Array) -> ContactMotions:
        """Return those of one grasp or of many; `of_object` is the G' that `Metric.scaled_grasp` makes."""
        J = metric.scaled_rows(matrices.J)
        of_synergies = J @ matrices.S
        values = singular_values(of_synergies)
        largest = values.max(axis=-1, initial=0.0)
        rounding = SINGULAR * np.linalg.norm(J, axis=(-2, -1)) * np.linalg.norm(matrices.S, axis=(-2, -1))
        sizes = np.where(largest > rounding, largest, 0.0)
        basis, triangle = np.linalg.qr(of_object, mode="complete")
        internal, both = basis[..., 6:], basis.mT @ of_synergies
        against, directions = right_singular(both[..., 6:, :], sizes)
        redundancy, rigid = Decisions.of(values, sizes), Decisions.of(against, sizes)
        return cls(both[..., :6, :], triangle[..., :6, :], internal, sizes, redundancy, rigid, directions)

    def taken(self, places: Any) -> ContactMotions:
        """Return those of some grasps of a stack."""
        arrays = (self.along[places], self.triangle[places], self.internal[places], self.sizes[places])
        decisions = (self.redundancy.taken(places), self.rigid.taken(places))
        return ContactMotions(*arrays, *decisions, self.directions[places])

    def moving(self, rank: int) -> Moving:
        """Split what costs no force; `rank` synergy motions do, in every grasp of the stack."""
        free = self.directions[..., rank:]  # (..., n_z, dim Gamma_zcs + dim Gamma_zr)
        values, directions = right_singular(self.along @ free, self.sizes)
        return Moving(Decisions.of(values, self.sizes).ranks, free @ directions)


def free_motions(moved: ContactMotions, moving: Moving, metric: Metric, rank: int) -> tuple[Array, Array, Array]:
    """Return Gamma_ucs, Gamma_zcs and Gamma_zr, where `rank` of the motions that are free move contacts."""
    synergies, Gamma_zr = moving.directions[..., :rank], canonical(moving.directions[..., rank:])
    if rank == 0:
        return frozen(np.zeros((*metric.motion.shape[:-1], 0))), frozen(synergies), Gamma_zr
    motions = np.asarray(np.linalg.solve(moved.triangle, moved.along @ synergies), dtype=np.float64)
    basis = canonical(motions)
    coordinates = _least_squares(motions, basis)  # basis = motions @ coordinates
    return frozen(np.linalg.solve(metric.motion, basis)), frozen(synergies @ coordinates), Gamma_zr


def _least_squares(A: Array, B: Array) -> Array:
    """Return X of ``A X = B`` as nearly as may be; the columns of A (..., m, n) are independent."""
    q, r = np.linalg.qr(A)
    return np.asarray(np.linalg.solve(r, q.mT @ B))


def controllable_forces(
    dlambda_dzr: Array, unknown: Array, moved: ContactMotions, metric: Metric, rank: int
) -> tuple[Array, Decisions]:
    """Return E_s with the `rank` that the kinematics dictates, and the force map's own decision.

    A singular value of the map counts when the map is known that well; how far it is below the largest says nothing,
    because it comes with stiffnesses.

    Args:
        dlambda_dzr: (..., n_l, n_z) the force map.
        unknown: (...) by how much its largest entries may be wrong.
        moved: the contact motions of the same grasps.
        metric: their scaled coordinates.
        rank: dimension of E_s, in every grasp of the stack.
    """
    scaled = metric.force[..., None] * dlambda_dzr
    values, internal = left_singular(scaled, rank)
    size = np.abs(scaled).max(axis=(-2, -1), initial=0.0)
    noise = np.maximum(unknown, np.finfo(float).eps * size) * np.sqrt(scaled.shape[-2] * scaled.shape[-1])
    counted = np.sum(values > noise[..., None], axis=-1)
    relative = np.where(counted[..., None] > 0, values / np.where(values[..., :1] > 0, values[..., :1], 1.0), 0.0)
    # grey values are no news here: they come with stiff contacts, and (34) has settled the rank
    decision = Decisions(counted, relative, counted != rank)
    kept = moved.internal[..., : scaled.shape[-2], :]  # a support of free motions has no part in it
    internal = kept @ (kept.mT @ internal)  # G E_s = 0 to the last digit
    return internal_forces(internal, metric), decision


def internal_forces(basis: Array, metric: Metric) -> Array:
    """Return E_s (..., n_l, dim) of the scaled internal forces that a basis spans."""
    return frozen(canonical(basis) / metric.force[..., None])
