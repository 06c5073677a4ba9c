"""Grasp matrices and hand Jacobians of many grasps with contacts of the same kinds, from where their contacts are."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from synergrip.grasps.contacts.contact import Contact
from synergrip.grasps.contacts.kind import COMPONENTS
from synergrip.linalg import Array, Places
from synergrip.vectors import skews


def component_places(contacts: Sequence[Contact]) -> Places:
    """Return (n_l,) the place of each force component among n, t, o and moments about them of all contacts (6 n_c)."""
    pairs = enumerate(contact.kind.components for contact in contacts)
    return np.array([6 * i + COMPONENTS.index(name) for i, names in pairs for name in names])


def grasp_matrices(arms: Array, frames: Array, places: Places) -> Array:
    """Return G (N, 6, n_l) of (5), wrenches about the origin of B.

    Args:
        arms: (N, n_c, 3) from there to where the contacts' forces act [m].
        frames: (N, n_c, 3, 3) of the contacts.
        places: (n_l,) of `component_places`.
    """
    N, n_c = arms.shape[:2]
    whole = np.zeros((N, 2, 3, n_c, 2, 3))  # force and moment of each contact's force, and of its moment
    turned = frames.transpose(0, 2, 1, 3)
    whole[:, 0, :, :, 0] = whole[:, 1, :, :, 1] = turned
    whole[:, 1, :, :, 0] = (skews(arms) @ frames).transpose(0, 2, 1, 3)
    return np.asarray(whole.reshape(N, 6, 6 * n_c)[:, :, places])


def hand_jacobians(jacobians: Array, frames: Array, places: Places) -> Array:
    """Return J (N, n_l, n_q) of (5).

    Args:
        jacobians: (N, n_c, 2, 3, n_q) velocity of the point of the link where a force acts, and turning of the link.
        frames: (N, n_c, 3, 3) of the contacts.
        places: (n_l,) of `component_places`.
    """
    N, n_c = frames.shape[:2]
    whole = frames.mT[:, :, None] @ jacobians
    return np.asarray(whole.reshape(N, 6 * n_c, -1)[:, places])


def moved_points(jacobians: Array, arms: Array) -> Array:
    """Return the Jacobians (N, n_c, 2, 3, n_q) of other points of the same links, which are `arms` (N, n_c, 3) off."""
    moving, turning = jacobians[:, :, 0], jacobians[:, :, 1]
    return np.stack([moving - skews(arms) @ turning, turning], axis=2)
