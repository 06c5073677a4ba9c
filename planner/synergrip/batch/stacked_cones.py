"""Friction cones of many problems: one matrix for all, or one for each where friction or contacts differ."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from synergrip.conic.affine import Affine, times
from synergrip.grasps.friction_cones import cone_units
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.stacked_kinds import StackedKinds
from synergrip.linalg import Array, Places
from synergrip.values import Value


@dataclass(frozen=True, eq=False, repr=False)
class StackedCones(Value):
    """The cones of one size of all contacts, as `Cones` has them, in as few numbers as they take."""

    size: int
    contacts: NDArray[np.intp]
    """(cones,) which contact each belongs to."""
    n_l: int
    columns: NDArray[np.intp] | None
    """(cones * size,) the one force component that each row of W takes; None where there is a row that takes more."""
    entries: Array
    """What it takes of it (cones * size,), or W (cones * size, n_l); or (N, ...) with one for each problem."""

    @cached_property
    def W(self) -> Array:
        """(cones * size, n_l), or (N, ...) with one for each problem."""
        if self.columns is None:
            return self.entries
        whole = np.zeros((*self.entries.shape, self.n_l))
        whole[..., range(len(self.columns)), self.columns] = self.entries
        return whole

    @cached_property
    def unit(self) -> Array:
        """(cones,) or (N, cones): what rows are divided by where there is little friction."""
        if self.columns is not None:
            return cone_units(np.abs(self.entries[..., :: self.size]))
        return cone_units(np.abs(self.W[..., :: self.size, :]).max(axis=-1))

    def taken(self, places: Places) -> StackedCones:
        """Return those of the problems at some places."""
        one_for_all = self.entries.ndim == (1 if self.columns is not None else 2)
        return self if one_for_all else replace(self, entries=self.entries[places])

    def after(self, force: Affine) -> tuple[Affine, Array]:
        """Return ``W lambda`` of contact forces that are affine in something, but for a factor of each row.

        The factors (..., rows) are those of its matrix, and come with it, so that nobody multiplies twice.
        """
        if self.columns is None:
            whole = force.after(self.W)
            return whole, np.ones(whole.matrix.shape[-2])
        every = np.array_equal(self.columns, np.arange(force.matrix.shape[-2]))
        taken = force.matrix if every else force.matrix[..., self.columns, :]
        return Affine(taken, self.entries * force.constant[:, self.columns]), self.entries

    def images(self, forces: Array) -> Array:
        """Return ``W lambda`` (N, cones, size) [N] of contact forces (N, n_l)."""
        every = times(self.W, forces) if self.columns is None else self.entries * forces[:, self.columns]
        return every.reshape(len(forces), len(self.contacts), self.size)


def stacked_cones(first: Grasp, kinds: StackedKinds, friction: Array | None) -> tuple[StackedCones, ...]:
    """Return the cones of one grasp, or of N, with friction multiplied by (N,) factors; half-lines first.

    Args:
        first: the grasp, or the first of N.
        kinds: of the contacts of all.
        friction: factors; None for friction as it is.
    """
    every = [(i, W.shape[-2], W) for i, contact in enumerate(kinds.contacts) for W in contact.cones(friction)]
    leading = (len(kinds),) if len(kinds) > 1 else (() if friction is None else (len(friction),))
    found = []
    for size in sorted({size for _, size, _ in every}):
        chosen = [(contact, W) for contact, own, W in every if own == size]
        contacts, columns = np.array([contact for contact, _ in chosen]), _columns(first, chosen)
        shape = (len(chosen) * size,) if columns is not None else (len(chosen) * size, first.n_l)
        entries = np.zeros((*leading, *shape))
        for k, (contact, W) in enumerate(chosen):
            rows, own = slice(k * size, (k + 1) * size), first.rows[contact]
            if columns is None:
                entries[..., rows, own] = W
            else:
                entries[..., rows] = W[..., range(size), columns[rows] - own.start]
        found.append(StackedCones(size, contacts, first.n_l, columns, entries))
    return tuple(found)


def _columns(first: Grasp, chosen: Sequence[tuple[int, Array]]) -> NDArray[np.intp] | None:
    """Return (cones * size,) the one force component that rows of cones take; None where one takes more."""
    found = []
    for contact, W in chosen:
        there = (W != 0).reshape(-1, *W.shape[-2:]).any(axis=0)
        if not (there.sum(axis=1) == 1).all():
            return None
        found.append(first.rows[contact].start + there.argmax(axis=1))
    return np.concatenate(found)


def most(cones: Sequence[StackedCones], grasp: Grasp) -> Array:
    """Return (n_l,) or (N, n_l) the largest size of each force component for a newton of normal force, by the cones."""
    leading = cones[0].W.shape[:-2]
    result = np.ones((*leading, grasp.n_l))
    for contact, rows in enumerate(grasp.rows):
        tails, heads = [], []
        for each in cones:
            for k in np.flatnonzero(each.contacts == contact):
                own = each.W[..., k * each.size : (k + 1) * each.size, rows]
                tails.append(own[..., 1:, 1:])
                heads.append(np.broadcast_to(own[..., :1, 0], (*own.shape[:-2], each.size - 1)))
        result[..., rows.start + 1 : rows.stop] = _reached(np.concatenate(tails, -2), np.concatenate(heads, -1))
    return result


def _reached(tail: Array, head: Array) -> Array:
    """Return ``|pinv(tail)| head``; most tails are diagonal."""
    size = min(tail.shape[-2:])
    diagonal = np.diagonal(tail, axis1=-2, axis2=-1)
    if tail.shape[-2] == tail.shape[-1] and np.count_nonzero(tail) == np.count_nonzero(diagonal) == diagonal.size:
        return np.asarray(head / np.abs(diagonal))
    return np.asarray((np.abs(np.linalg.pinv(tail)) @ head[..., None])[..., 0]) if size else head[..., :0]
