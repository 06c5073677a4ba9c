"""Contact forces as vectors in space, at the places where they act."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from synergrip.grasps.contacts.contact import Contact
from synergrip.grasps.grasp import Grasp, grasp_matrix
from synergrip.linalg import Array, frozen


@dataclass(frozen=True)
class ContactForces:
    """Forces of the hand on the object at each contact, in palm axes."""

    points: Array
    """(n_c, 3) where they act, from B [m]."""
    forces: Array  # (n_c, 3) [N]
    spins: Array
    """(n_c,) moments about the contact normals [N m]; 0 where the contact carries none."""

    @property
    def largest(self) -> float:
        """The size of the largest force [N]."""
        return float(np.linalg.norm(self.forces, axis=1).max(initial=0.0))

    @property
    def largest_spin(self) -> float:
        """The size of the largest spin moment [N m]."""
        return float(np.abs(self.spins).max(initial=0.0))


def contact_forces(contacts: Sequence[Contact], values: Array) -> ContactForces:
    """Return the forces of contact-force components `values` (n_l,), the rows of each contact those of its kind."""
    parts = np.split(values, np.cumsum([contact.n_rows for contact in contacts])[:-1])
    every = [part @ contact.kind.selection for contact, part in zip(contacts, parts, strict=True)]
    forces = [contact.frame @ six[:3] for contact, six in zip(contacts, every, strict=True)]
    return ContactForces(frozen([c.point for c in contacts]), frozen(forces), frozen([six[3] for six in every]))


def places_known(grasp: Grasp) -> bool:
    """Return whether points and frames of the contacts account for G, so that forces can be drawn at them."""
    return bool(np.allclose(grasp_matrix(grasp.contacts), grasp.G, rtol=0, atol=1e-6 * np.abs(grasp.G).max()))
