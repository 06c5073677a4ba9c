"""The controlled subspaces and Theorem 1 of many grasps at once, those of like dimensions together."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from synergrip.documents.judging import expected
from synergrip.documents.naming import naming_arguments
from synergrip.documents.places import place_of
from synergrip.linalg import Decisions, Places, frozen
from synergrip.statics.responses import Responses
from synergrip.statics.restraint import free_directions, supported
from synergrip.statics.subspaces import (
    Bases,
    ContactMotions,
    Moving,
    Subspaces,
    controllable_forces,
    free_motions,
    internal_forces,
)
from synergrip.statics.theorem1 import Coordinates, coordinates_of
from synergrip.values import ByName


@dataclass(frozen=True, eq=False, repr=False)
class SubspaceGroup(Bases):
    """The bases of N grasps whose subspaces have the same dimensions: leading axis N."""

    responses: Responses
    """Of these N grasps."""
    decisions: Mapping[str, Decisions]
    """(N,) each: the decisions of `Subspaces`."""

    @property
    def places(self) -> Places:
        """(N,) where each of them stood among the grasps asked about."""
        return self.responses.places

    @property
    def ambiguous(self) -> NDArray[np.bool_]:
        """(N,) True when a singular value lies in the grey zone, or the force map disagrees with (34)."""
        return np.asarray(np.any([decision.ambiguous for decision in self.decisions.values()], axis=0))

    def at(self, index: int) -> Subspaces:
        """Return the subspaces of one of the N grasps, as `subspaces` would."""
        index = place_of("index", index, len(self.places))
        bases = {field.name: frozen(getattr(self, field.name)[index]) for field in fields(Bases)}
        decisions = {name: each.at(index) for name, each in self.decisions.items()}
        return Subspaces(**bases, decisions=ByName("decisions", decisions))


@naming_arguments
def subspaces_many(responses: Responses) -> tuple[SubspaceGroup, ...]:
    """Return the controlled subspaces of many grasps: the bases that `subspaces` returns, many times as fast.

    Args:
        responses: of the grasps, from `respond_many`.

    Returns:
        one group for each triple of dimensions that occurs, the largest dim E_s first, then the largest dim
        Gamma_ucs; within a group the grasps keep their order. Grasps that leave the object free motions stand in
        groups of their own, after those that leave fewer.

    Raises:
        InputError: no responses.

    Example:
        >>> for group in subspaces_many(respond_many(grasps)):
        ...     print(group.dimensions, group.places, group.E_s.shape)
        (3, 1, 0) [0 1] (2, 9, 3)
    """
    expected("responses", responses, Responses, "respond_many(grasps)")
    return groups_of(responses)


def groups_of(responses: Responses, *, told: bool = True) -> tuple[SubspaceGroup, ...]:
    """Return the groups; where nobody looks at it (not `told`), without the force map's own decision if that is work.

    It is where all internal forces can be controlled: they span E_s, whatever the singular values of the map.
    """
    groups: list[SubspaceGroup] = []
    for rank, alike in _by_rank(responses.restraint.ranks):
        groups += _alike(responses if isinstance(alike, slice) else responses.taken(alike), 6 - rank, told)
    return tuple(groups)


def _alike(responses: Responses, count: int, told: bool) -> Iterator[SubspaceGroup]:
    """Yield the groups of grasps each of which leaves its object so many free motions."""
    grasps = responses.grasps
    matrices, metric = supported(grasps.matrices, grasps.metric, free_directions(grasps.of_object, count))
    moved = ContactMotions.of(matrices, metric, metric.scaled_grasp(matrices.G) if count else grasps.of_object)
    for rank, alike in _by_rank(moved.rigid.ranks):
        same, theirs = moved.taken(alike), responses.taken(alike)
        moving = same.moving(rank)
        for moves, within in _by_rank(moving.ranks):
            yield _group(theirs.taken(within), same.taken(within), moving.taken(within), rank, moves, told)


@naming_arguments
def coordinates_many(group: SubspaceGroup) -> Coordinates:
    """Return M of (35) and its inverse for each grasp of a group, (N, n_z, n_z).

    Args:
        group: from `subspaces_many`.

    Raises:
        InputError: no group.

    Example:
        >>> alpha, beta, gamma = coordinates_many(group).coordinates(dz_r)  # dz_r (N, T, n_z)
        >>> alpha.shape, beta.shape, gamma.shape
        ((2, 3, 3), (2, 3, 1), (2, 3, 0))
    """
    expected("group", group, SubspaceGroup, "subspaces_many(responses)[0]")
    return coordinates_of(group.responses, group, group.responses.grasps.metric)


def _by_rank(ranks: Places) -> list[tuple[int, Any]]:
    """Return every rank, the largest first, and where it is; a slice where it is everywhere, which copies nothing."""
    found = np.unique(ranks)[::-1].tolist()
    return [(rank, slice(None) if len(found) == 1 else np.flatnonzero(ranks == rank)) for rank in found]


def _group(
    responses: Responses, moved: ContactMotions, moving: Moving, rank: int, moves: int, told: bool
) -> SubspaceGroup:
    metric, known = responses.grasps.metric, responses.figures[:, 0]  # of the force map: size, whole, lost, changed
    decisions = {"restraint": responses.restraint, "redundancy": moved.redundancy, "rigid": moved.rigid}
    if not told and rank == moved.internal.shape[-1] == metric.force.shape[-1] - 6:
        E_s = internal_forces(moved.internal, metric)
    else:
        unknown = known[:, 2:].max(axis=-1)
        E_s, decisions["forces"] = controllable_forces(responses.dlambda_dzr, unknown, moved, metric, rank)
    Gamma_ucs, Gamma_zcs, Gamma_zr = free_motions(moved, moving, metric, moves)
    return SubspaceGroup(E_s, Gamma_ucs, Gamma_zcs, Gamma_zr, responses, decisions)
