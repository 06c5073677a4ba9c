"""A contact that is elsewhere on link and object, or has another normal: G and J as they are then."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from synergrip.grasps.contacts.contact import Contact
from synergrip.grasps.grasp import Grasp, grasp_matrix, hand_jacobian
from synergrip.grasps.placing import moved_to
from synergrip.linalg import Array, frozen
from synergrip.vectors import rotation_matrices

SAME = 1e-9
"""How far J may be from that of the posture, relative to its largest entry: beyond it somebody has set it."""
POINT = ("n", "t", "o")
"""The components of a contact whose frame can be turned without kinematics."""


def jacobians(grasp: Grasp, contacts: tuple[Contact, ...]) -> Array | None:
    """Return J (n_l, n_q) of contacts on the links that touch now; None for a grasp given as matrices."""
    held = grasp.held
    if held is None:
        return None
    motions = held.hand.kinematics.at(held.q, [(touch.pad.link, touch.pad.point) for touch in held.touches])
    spots = (contact.point + held.body.position for contact in contacts)
    return hand_jacobian(contacts, [moved_to(*pair).jacobian for pair in zip(motions, spots, strict=True)])


def has_kinematics(grasp: Grasp) -> bool:
    """Return whether G and J are those of contacts on a hand in its posture."""
    J = jacobians(grasp, grasp.contacts)
    if J is None or grasp.lambda_0 is not None:
        return False
    known = ((J, grasp.J), (grasp_matrix(grasp.contacts), grasp.G))
    return all(np.abs(one - other).max() <= SAME * np.abs(other).max(initial=1e-300) for one, other in known)


def moved(grasp: Grasp, index: int, by: Array) -> Grasp:
    """Return a grasp on a hand with one contact elsewhere: by (3,) along its n, t and o, on link and object [m].

    Its frame stays as it is: the surface is the plane that touches it there.
    """
    contact = grasp.contacts[index]
    return _with(grasp, index, replace(contact, point=frozen(contact.point + contact.frame @ by)))


def turned(grasp: Grasp, index: int, by: Array) -> Grasp:
    """Return a grasp with the frame of one contact turned: by (3,) about its n, t and o [rad]; its springs go along.

    Of a grasp given as matrices the contact has force components n, t, o only.
    """
    contact, own = grasp.contacts[index], rotation_matrices(by)  # in the contact's axes
    new = replace(contact, frame=frozen(contact.frame @ own))
    if grasp.held is not None:
        return _with(grasp, index, new)
    rows, G, J = grasp.rows[index], np.array(grasp.G), np.array(grasp.J)
    G[:, rows], J[rows] = G[:, rows] @ own, own.T @ J[rows]
    start = None if grasp.lambda_0 is None else np.array(grasp.lambda_0)
    if start is not None:
        start[rows] = own.T @ start[rows]
    return replace(grasp, contacts=_replaced(grasp, index, new), G=G, J=J, lambda_0=start)


def _with(grasp: Grasp, index: int, contact: Contact) -> Grasp:
    contacts = _replaced(grasp, index, contact)
    J = jacobians(grasp, contacts)
    assert J is not None
    return replace(grasp, contacts=contacts, G=grasp_matrix(contacts), J=J)


def _replaced(grasp: Grasp, index: int, contact: Contact) -> tuple[Contact, ...]:
    return (*grasp.contacts[:index], contact, *grasp.contacts[index + 1 :])
