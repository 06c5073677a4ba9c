"""A contact: where it is, which of its motions it constrains, and what it can hold.

A kind of contact is one file beside this one: it names its force components, selects the rows of
the contact twist that it constrains (the H of (3)), and describes its friction cone by one matrix.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from synergrip.linalg import Array, frozen


class ContactKind(Protocol):
    """What one kind of contact transmits and withstands."""

    @property
    def name(self) -> str:
        """Name in files: "hard", "soft", "frictionless"."""

    @property
    def title(self) -> str:
        """Name in text."""

    @property
    def components(self) -> tuple[str, ...]:
        """Force components in row order: "n", "t", "o" in newtons, "m" (spin about n) in N m."""

    @property
    def selection(self) -> Array:
        """(rows, 6) selection of the contact twist (v_n, v_t, v_o, w_n, w_t, w_o) that is constrained."""

    def cone(self, friction: float, spin_friction: float) -> Array:
        """Return W (d, rows): slip margin = (W lambda)_0 - ||(W lambda)_1..|| in newtons."""


@dataclass(frozen=True)
class Contact:
    """One contact of a grasp. The normal points toward the object: lambda_n >= 0 is pushing."""

    name: str
    kind: ContactKind
    friction: float
    """Coulomb coefficient mu; 0 for a frictionless contact."""
    spin_friction: float
    """nu [m]: spin moment carried for each newton of normal force; 0 unless soft."""
    point: Array
    """(3,) position from the object frame B, axes of N [m]."""
    frame: Array
    """(3, 3) columns n, t, o."""
    normal_at: str = ""
    """Where a user states the normal, for advice; empty when it follows from the object."""

    @property
    def n_rows(self) -> int:
        """Number of force components."""
        return len(self.kind.components)

    @property
    def cone(self) -> Array:
        """(d, rows) cone matrix W of this contact."""
        return self.kind.cone(self.friction, self.spin_friction)

    def slip_margin(self, force: Array) -> Array:
        """Return the slip margin [N] of forces (..., rows): shape (...).

        Hard finger ``mu n - ||(t, o)||``, soft finger ``mu n - sqrt(t^2 + o^2 + (mu m / nu)^2)``;
        a frictionless contact cannot slip, its margin is the normal force itself. A contact that would have to pull
        is missed by that pull at least, however little friction it has.
        """
        image, normal = np.asarray(force) @ self.cone.T, np.asarray(force)[..., 0]
        margin = image[..., 0] - np.linalg.norm(image[..., 1:], axis=-1)
        return np.asarray(np.where(normal < 0, np.minimum(margin, normal), margin))


def contact_frame(normal: Array) -> Array:
    """Return (3, 3) columns n, t, o for a normal (3,); t is chosen from the axis farthest from n."""
    n = np.asarray(normal, dtype=float) / np.linalg.norm(normal)
    axis = np.zeros(3)
    axis[int(np.argmin(np.abs(n) > np.abs(n).min() + 1e-9))] = 1.0
    t = axis - (axis @ n) * n
    t /= np.linalg.norm(t)
    return frozen(np.column_stack([n, t, np.cross(n, t)]))
