"""What sliding pads add to the stiffness of an equilibrium: their normals turn with the surface below them."""

from __future__ import annotations

import numpy as np

from synergrip.equilibrium.meeting import Meeting, Placed, Slid
from synergrip.grasps.contact_maps import moved_points
from synergrip.linalg import Array
from synergrip.vectors import skews


def of_sliding(placed: Placed, meeting: Meeting, jacobians: Array, forces: Array, slid: Slid) -> Array:
    """Return what torques and, less, wrenches change by (T, n_q + 6, n_q + 6) with joints and pose, since pads slide.

    A pad without friction pushes along the normal from its centre p, with the energy of its distance a from the
    surface. Beyond the terms of a force that turns with B at a point of the link, its second derivative is
    ``lambda_n (a Omega' P Omega - V' D V)``: V how p moves against B, Omega how the link turns against it, D how the
    normal changes with p, P the plane across it.

    Args:
        placed: links and object.
        meeting: the contacts.
        jacobians: (T, n_c, 2, 3, n_q) of the points where the forces act.
        forces: (T, n_c, 3) of the contacts, palm axes.
        slid: which of them slide, and D.
    """
    apart, arms = meeting.place - placed.point, placed.point - placed.position[:, None]
    links, one = moved_points(jacobians, -apart), np.broadcast_to(np.eye(3), slid.bent.shape)
    V = np.concatenate([links[:, :, 0], -one, skews(arms)], axis=3)
    Omega = np.concatenate([links[:, :, 1], 0 * one, -one], axis=3)
    normals = meeting.frame[..., 0]
    P = one - normals[..., :, None] * normals[..., None, :]
    force, a = ((part * normals).sum(axis=-1)[..., None, None] for part in (forces, apart))
    each = force * (a * (Omega.mT @ P @ Omega) - V.mT @ slid.bent @ V)
    return np.asarray(each[:, slid.which].sum(axis=1))
