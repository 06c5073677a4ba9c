"""States of hand and object at several instants, and the loads there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from synergrip.documents.judging import Arguments
from synergrip.documents.naming import naming_arguments
from synergrip.documents.places import places_of
from synergrip.linalg import Array
from synergrip.values import Value
from synergrip.vectors import rotation_matrices, rotation_vectors


@dataclass(frozen=True, eq=False, repr=False)
class States(Value):
    """Joints, object and contact forces at T instants; palm frame, SI units."""

    q: Array  # (T, n_q) [rad or m]
    position: Array  # (T, 3) of the object frame B [m]
    rotation: Array  # (T, 3, 3) of the object from the start
    forces: Array  # (T, n_l) of the hand on the object, in the contact frames [N, N m]

    def __len__(self) -> int:
        """Return T."""
        return len(self.q)

    def taken(self, places: Any) -> States:
        """Return those at some of the instants: whole numbers, a slice, or True or False for each.

        Raises:
            UnknownPlaceError: there are no such instants.
        """
        places = places_of("places", places, len(self))
        return States(*(getattr(self, field.name)[places] for field in fields(self)))

    def between(self, other: States, share: Array) -> States:
        """Return states about on the way to others, at shares (T,) of it: for Newton's method to begin at."""
        turns = share[:, None] * rotation_vectors(other.rotation @ self.rotation.mT)
        q, position, forces = (
            straight(getattr(self, name), getattr(other, name), share) for name in ("q", "position", "forces")
        )
        return States(q, position, rotation_matrices(turns) @ self.rotation, forces)

    @classmethod
    def joined(cls, parts: Sequence[States]) -> States:
        """Return states one after the other."""
        names = [field.name for field in fields(cls)]
        return cls(*(np.concatenate([getattr(part, name) for part in parts]) for name in names))


@naming_arguments
@dataclass(frozen=True, eq=False, repr=False)
class Loads(Value):
    """What acts on the object at T instants, axes of the palm.

    Args:
        wrench: (T, 6) forces and moments about the origin of the object frame B while the object is not turned; both
            go with that origin wherever it moves [N, N m].
        points: (m, 3) points of the object, from B at the start, at which forces act that are in the wrench [m].
        at_points: (T, m, 3) these forces; they keep their direction, their points turn with the object [N].

    Raises:
        InputError: values that are none, or shapes that do not fit each other.

    Example:
        >>> weight = Loads.of(np.tile([0, 0, -2.0, 0, 0, 0], (5, 1)))
        >>> len(weight), weight.points.shape
        (5, (0, 3))
    """

    wrench: Array
    points: Array
    at_points: Array

    def __post_init__(self) -> None:
        """Judge the values."""
        judge = Arguments("Loads")
        wrench = judge.numbers("wrench", self.wrench, "wrenches (T, 6)")
        if wrench is not None and (wrench.ndim != 2 or wrench.shape[1] != 6):
            judge.refuse("wrench", f"expected wrenches (T, 6), 3 forces and 3 moments in each row; got {wrench.shape}")
        points = judge.numbers("points", self.points, "points (m, 3)")
        if points is not None and (points.ndim != 2 or points.shape[1] != 3):
            judge.refuse("points", f"expected points (m, 3), got {points.shape}; np.zeros((0, 3)) for none")
        at_points = judge.numbers("at_points", self.at_points, "forces (T, m, 3)")
        if not judge.issues and wrench is not None and points is not None and at_points is not None:
            shape = (len(wrench), len(points), 3)
            if at_points.shape != shape:
                why = f", a force for each of {shape[0]} wrenches at each of {shape[1]} points; got {at_points.shape}"
                judge.refuse("at_points", f"expected shape {shape}{why}")
        judge.finish()
        for name, value in (("wrench", wrench), ("points", points), ("at_points", at_points)):
            object.__setattr__(self, name, value)

    def __len__(self) -> int:
        """Return T."""
        return len(self.wrench)

    @classmethod
    def of(cls, wrench: Array) -> Loads:
        """Return loads that act at the origin of B, wherever it is.

        Args:
            wrench: (T, 6) [N, N m].

        Raises:
            InputError: no wrenches.
        """
        count = 0 if np.ndim(wrench) == 0 else len(wrench)
        return cls(wrench, np.zeros((0, 3)), np.zeros((count, 0, 3)))

    def taken(self, places: Any) -> Loads:
        """Return those at some of the instants: whole numbers, a slice, or True or False for each.

        Raises:
            UnknownPlaceError: there are no such instants.
        """
        places = places_of("places", places, len(self))
        return Loads(self.wrench[places], self.points, self.at_points[places])

    @classmethod
    def joined(cls, parts: Sequence[Loads]) -> Loads:
        """Return loads of the same points one after the other."""
        wrench, at_points = (
            np.concatenate([getattr(part, name) for part in parts]) for name in ("wrench", "at_points")
        )
        return cls(wrench, parts[0].points, at_points)

    def acting(self, rotation: Array) -> Array:
        """Return the wrench (T, 6) on an object that is turned (T, 3, 3): points of it turn with it."""
        if not len(self.points):
            return self.wrench
        moved = np.einsum("tij,mj->tmi", rotation, self.points)
        moment = np.cross(moved - self.points, self.at_points).sum(axis=1)
        return np.asarray(self.wrench + np.hstack([np.zeros_like(moment), moment]))

    def turning(self, rotation: Array) -> Array:
        """Return how its moment changes with a small rotation of the object, (T, 3, 3) [N m/rad]."""
        if not len(self.points):
            return np.zeros((len(self.wrench), 3, 3))
        moved = np.einsum("tij,mj->tmi", rotation, self.points)
        f_r = np.einsum("tmi,tmi->t", self.at_points, moved)
        outer = np.einsum("tmi,tmj->tij", moved, self.at_points)
        return np.asarray(outer - f_r[:, None, None] * np.eye(3))  # (theta x r) x f = r (theta . f) - theta (r . f)

    def between(self, other: Loads, share: float | Array) -> Loads:
        """Return loads on the straight way to others, of the same points: at one share of it, or one for each (T,)."""
        wrench = straight(self.wrench, other.wrench, share)
        return Loads(wrench, other.points, straight(self.at_points, other.at_points, share))


def straight(one: Array, other: Array, share: float | Array) -> Array:
    """Return values (T, ...) on the straight way from some to others: at one share of it, or one for each (T,)."""
    own = np.reshape(share, (-1, *[1] * (one.ndim - 1)))
    return np.asarray((1 - own) * one + own * other)
