"""States of hand and object at several instants, and the loads there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from synergrip.linalg import Array
from synergrip.values import Value


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
        """Return some of them."""
        return States(*(getattr(self, field.name)[places] for field in fields(self)))

    @classmethod
    def joined(cls, parts: Sequence[States]) -> States:
        """Return states one after the other."""
        names = [field.name for field in fields(cls)]
        return cls(*(np.concatenate([getattr(part, name) for part in parts]) for name in names))


@dataclass(frozen=True, eq=False, repr=False)
class Loads(Value):
    """What acts on the object at T instants, axes of the palm."""

    wrench: Array
    """(T, 6) about the origin of B when the object is not turned; force and moment move with that origin [N, N m]."""
    points: Array
    """(m, 3) points of the object, from B, at which forces act that are in the wrench [m]."""
    at_points: Array  # (T, m, 3) these forces [N]

    @classmethod
    def of(cls, wrench: Array) -> Loads:
        """Return loads that act at the origin of B, wherever it is."""
        return cls(wrench, np.zeros((0, 3)), np.zeros((len(wrench), 0, 3)))

    def taken(self, places: Any) -> Loads:
        """Return those at some of the instants."""
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

    def between(self, other: Loads, share: float) -> Loads:
        """Return loads on the straight way to others, of the same points."""
        wrench, at_points = (
            (1 - share) * one + share * two
            for one, two in ((self.wrench, other.wrench), (self.at_points, other.at_points))
        )
        return Loads(wrench, other.points, at_points)
