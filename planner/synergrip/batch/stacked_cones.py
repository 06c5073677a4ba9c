"""Friction cones of many problems: one matrix for all, or one for each where friction or contacts differ."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from synergrip.conic.limits.friction_cone import SLIPPERY
from synergrip.grasps.contacts.contact import Contact
from synergrip.grasps.contacts.kind import ContactKind
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array
from synergrip.values import Value

HALF = 0.5
"""Share of friction at which cones are looked at beside those as they are; they are linear in it."""


@dataclass(frozen=True, eq=False, repr=False)
class Cones(Value):
    """The cones of one size of all contacts: ``W lambda``, cones below one another."""

    size: int
    contacts: NDArray[np.intp]
    """(cones,) which contact each belongs to."""
    W: Array
    """(cones * size, n_l), or (N, ...) with one for each problem."""

    @property
    def unit(self) -> Array:
        """(cones,) or (N, cones): what rows are divided by where there is little friction (see `cone_unit`)."""
        largest = np.abs(self.W[..., :: self.size, :]).max(axis=-1)
        return np.where((largest > 0) & (largest < SLIPPERY), largest, 1.0)

    def images(self, forces: Array) -> Array:
        """Return ``W lambda`` (N, cones, size) [N] of contact forces (N, n_l)."""
        image = forces @ self.W.T if self.W.ndim == 2 else (self.W @ forces[:, :, None])[:, :, 0]
        return np.asarray(image.reshape(len(forces), len(self.contacts), self.size))


def stacked_cones(grasps: Sequence[Grasp], friction: Array | None) -> tuple[Cones, ...]:
    """Return the cones of one grasp, or of N, with friction multiplied by (N,) factors; half-lines first."""
    first = grasps[0]
    tables = [_tables([grasp.contacts[i] for grasp in grasps], friction is not None) for i in range(first.n_c)]
    every = [(i, len(plain), plain, by_friction) for i, pairs in enumerate(tables) for plain, by_friction in pairs]
    found = []
    for size in sorted({size for _, size, _, _ in every}):
        chosen = [each for each in every if each[1] == size]
        leading = (len(grasps),) if len(grasps) > 1 else (() if friction is None else (len(friction),))
        W = np.zeros((*leading, len(chosen) * size, first.n_l))
        for k, (contact, _, plain, by_friction) in enumerate(chosen):
            factor = 1.0 if friction is None else friction[:, None, None]
            rows = plain[..., 0] if len(grasps) == 1 else np.moveaxis(plain, -1, 0)
            more = by_friction[..., 0] if len(grasps) == 1 else np.moveaxis(by_friction, -1, 0)
            W[..., k * size : (k + 1) * size, first.rows[contact]] = rows + factor * more
        found.append(Cones(size, np.array([contact for contact, *_ in chosen]), W))
    return tuple(found)


def _tables(contacts: Sequence[Contact], by_factors: bool) -> list[tuple[Array, Array]]:
    """Return of each cone of one contact in N grasps what it is without friction, and what friction adds: (d, rows, N).

    Equal kinds are looked at once. Where no factors are asked for, friction adds nothing to what the cones are.
    """
    kinds: dict[ContactKind, int] = {}
    which = [kinds.setdefault(contact.kind, len(kinds)) for contact in contacts]
    every = [kind.cones for kind in kinds]
    halves = [kind.slippery(HALF).cones for kind in kinds] if by_factors else every
    found = []
    for cone in range(len(every[0])):
        whole, half = (np.stack([cones[cone] for cones in each], axis=-1) for each in (every, halves))
        by_friction = (whole - half) / (1 - HALF)
        found.append(((whole - by_friction)[..., which], by_friction[..., which]))
    return found


def most(cones: Sequence[Cones], grasp: Grasp) -> Array:
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


def slip_margins(cones: Sequence[Cones], normal: Array, forces: Array) -> Array:
    """Return slip margins (N, n_c) [N] of contact forces (N, n_l) by the contacts' own formula, from their cones.

    ``(W lambda)_0 - ||(W lambda)_1..||``, the smallest of the cones of a contact, and no more than a pull.
    """
    margins = np.full((len(forces), normal.shape[1]), np.inf)
    for each in cones:
        image = each.images(forces)
        inside = image[..., 0] - np.linalg.norm(image[..., 1:], axis=-1)
        for k, contact in enumerate(each.contacts):
            margins[:, contact] = np.minimum(margins[:, contact], inside[:, k])
    return np.where(normal < 0, np.minimum(margins, normal), margins)
