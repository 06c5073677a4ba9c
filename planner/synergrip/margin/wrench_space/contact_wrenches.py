"""What one contact can do to the object with a normal force of one newton: a set of wrenches, and pyramids about it.

Where the normal force is 1, a cone ``(W lambda)_0 >= ||(W lambda)_1..||`` leaves the other components an ellipsoid; of
several cones that speak of different components, the product of these. Points on the ellipsoids are the edges of a
pyramid inside the cone; divided by the radius of the ball inside their hull, of one around it.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from itertools import product

import numpy as np

from synergrip.errors import InputError
from synergrip.grasps.contacts.contact import Contact
from synergrip.linalg import Array, frozen
from synergrip.values import Value

FEWEST = 3
"""Edges of a pyramid."""


@dataclass(frozen=True, eq=False, repr=False)
class UnitForces(Value):
    """The forces (rows) of a contact whose normal force is 1: ``e_n + sum_j C_j u_j`` with every ``||u_j|| <= 1``."""

    axes: tuple[Array, ...]
    """C_j (rows, k_j): the semi-axes of each ellipsoid."""
    rows: int

    @classmethod
    def of(cls, contact: Contact) -> UnitForces:
        """Return those of a contact.

        Raises:
            InputError: a kind of contact of one's own, several cones of which speak of the same component.
        """
        axes, used = [], np.zeros(contact.n_rows, dtype=bool)
        for W in contact.cones:
            tail = W[1:]
            columns = np.any(tail != 0, axis=0)
            if np.any(columns & used) or columns[0]:
                message = f"the cones of contact '{contact.name}' share components; of these nothing is known"
                raise InputError.at("grasp", message)
            used |= columns
            if np.any(columns):
                own = np.zeros((contact.n_rows, int(columns.sum())))
                own[columns] = W[0, 0] * np.linalg.inv(tail[:, columns])
                axes.append(frozen(own))
        return cls(tuple(axes), contact.n_rows)

    def points(self, edges: int, *, outside: bool = False) -> Array:
        """Return the edges (p, rows) of a pyramid inside the cones, or of one around them.

        Args:
            edges: of the pyramid of a hard finger, 3 or more.
            outside: around them.
        """
        parts = []
        for C in self.axes:
            points, inner = sphere_points(C.shape[1], edges)
            parts.append(points / (inner if outside else 1.0) @ C.T)
        normal = np.eye(self.rows)[0]
        return frozen([normal + sum(chosen) for chosen in product(*parts)])

    def farthest(self, along: Array) -> Array:
        """Return the force (rows,) that goes farthest along a direction (rows,) of forces."""
        force = np.eye(self.rows)[0]
        for C in self.axes:
            inner = C.T @ along
            size = float(np.linalg.norm(inner))
            if size > 0:
                force = force + C @ (inner / size)
        return np.asarray(force)


def _rings(edges: int) -> Array:
    """Return points (p, 3) of a unit sphere: its poles, and rings as far apart as the points on the equator are."""
    quarter = max(round(edges / 4), 1)
    found = [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]]
    for ring in range(1 - quarter, quarter):
        latitude = np.pi / 2 * ring / quarter
        count = max(round(edges * np.cos(latitude)), FEWEST)
        for angle in 2 * np.pi * (np.arange(count) + ring % 2 / 2) / count:
            found.append([np.cos(latitude) * np.cos(angle), np.cos(latitude) * np.sin(angle), np.sin(latitude)])
    return np.array(found)


@cache
def sphere_points(dimension: int, edges: int) -> tuple[Array, float]:
    """Return points (p, dimension) of a unit sphere and the radius of the ball inside their hull."""
    from scipy.spatial import ConvexHull

    if dimension == 1:
        return frozen([[-1.0], [1.0]]), 1.0
    angles = 2 * np.pi * np.arange(edges) / edges
    ring = np.column_stack([np.cos(angles), np.sin(angles)])
    if dimension == 2:
        return frozen(ring), float(np.cos(np.pi / edges))
    if dimension == 3:
        points = _rings(edges)
    else:
        corner = np.array(list(product((-1.0, 1.0), repeat=dimension))) / np.sqrt(dimension)
        points = np.vstack([np.eye(dimension), -np.eye(dimension), corner])
    return frozen(points), float(-ConvexHull(points).equations[:, -1].max())
