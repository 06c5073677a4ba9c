"""Friction cones of all contacts of a grasp, those of one size together, and the slip margins that they say."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from synergrip.grasps.contacts.contact import Contact
from synergrip.linalg import Array, sealed
from synergrip.values import Value

SLIPPERY = 0.1
"""Friction below which a cone as it stands, to a tolerance e, allows a pull of more than ten times e."""


@dataclass(frozen=True, eq=False, repr=False)
class Cones(Value):
    """The cones of one size of all contacts of a grasp: ``W lambda``, cones below one another."""

    size: int
    contacts: NDArray[np.intp]
    """(cones,) which contact each belongs to."""
    W: Array  # (cones * size, n_l)
    names: tuple[tuple[str, str], ...]
    """Contact and side of each."""

    @cached_property
    def unit(self) -> Array:
        """(cones,) what rows are divided by where there is little friction."""
        return cone_units(np.abs(self.W[:: self.size]).max(axis=-1))

    @cached_property
    def heads(self) -> Array:
        """(cones * size,) 1 over its unit at the first row of each cone, 0 elsewhere."""
        found = np.zeros((len(self.contacts), self.size))
        found[:, 0] = 1.0 / self.unit
        return sealed(found.ravel())

    @cached_property
    def in_units(self) -> Array:
        """(cones * size, n_l) the rows W of each cone over its unit."""
        return sealed(self.W / np.repeat(self.unit, self.size)[:, None])

    def images(self, forces: Array) -> Array:
        """Return ``W lambda`` (N, cones, size) [N] of contact forces (N, n_l)."""
        return (forces @ self.W.T).reshape(len(forces), len(self.contacts), self.size)


def cone_units(friction: Array) -> Array:
    """Return what cones of friction (...) are divided by: this factor of the normal force, where there is little.

    The first row is then the normal force itself, so that the contact pushes to the same tolerance as others.
    """
    return np.where((friction > 0) & (friction < SLIPPERY), friction, 1.0)


def cone_unit(friction: float) -> float:
    """Return what one cone of friction is divided by, as of `cone_units`."""
    return float(cone_units(np.asarray(friction)))


def cones_of(contacts: Sequence[Contact], rows: Sequence[slice]) -> tuple[Cones, ...]:
    """Return the cones of contacts whose forces are at `rows` of lambda, the smallest cones first."""
    every = [
        ((contact.name, side), W, i)
        for i, contact in enumerate(contacts)
        for side, W in zip(contact.kind.sides, contact.cones, strict=True)
    ]
    found = []
    for size in sorted({len(W) for _, W, _ in every}):
        chosen = [each for each in every if len(each[1]) == size]
        whole = np.zeros((len(chosen), size, rows[-1].stop))
        for own, (_, W, contact) in zip(whole, chosen, strict=True):
            own[:, rows[contact]] = W
        places, names = np.array([contact for *_, contact in chosen]), tuple(name for name, *_ in chosen)
        found.append(Cones(size, places, sealed(whole.reshape(len(chosen) * size, -1)), names))
    return tuple(found)


class Images(Protocol):
    """Cones of one size, as far as margins go by them."""

    @property
    def contacts(self) -> NDArray[np.intp]:
        """(cones,) which contact each belongs to."""

    def images(self, forces: Array) -> Array:
        """Return ``W lambda`` (N, cones, size) [N] of contact forces (N, n_l)."""


def slip_margins(cones: Sequence[Images], normal: Array, forces: Array) -> Array:
    """Return slip margins (N, n_c) [N] of contact forces (N, n_l) by the contacts' own formula, from their cones.

    ``(W lambda)_0 - ||(W lambda)_1..||``, the smallest of the cones of a contact, and no more than a pull.

    Args:
        cones: of all contacts.
        normal: (N, n_c) normal forces [N].
        forces: (N, n_l) contact forces [N, N m].
    """
    margins = np.full(normal.shape, np.inf)
    for each in cones:
        image = each.images(forces)
        inside = image[..., 0] - np.sqrt((image[..., 1:] ** 2).sum(axis=-1))
        for k, contact in enumerate(each.contacts.tolist()):
            np.minimum(margins[:, contact], inside[:, k], out=margins[:, contact])
    return np.where(normal < 0, np.minimum(margins, normal), margins)
