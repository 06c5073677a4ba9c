"""Grasps small enough for closed forms, given as matrices: a pinch, three fingers on or below a ball's equator."""

from __future__ import annotations

import numpy as np
from made_kinds import made_kind

from synergrip.grasps.contacts.contact import Contact, contact_frame
from synergrip.grasps.grasp import Grasp, grasp_matrix
from synergrip.linalg import frozen


def pinch(
    mu: float = 0.5, nu: float = 0.005, compliance: tuple[float, float] = (1e-3, 1e-3), joint_compliance: float = 0.0
) -> Grasp:
    """Two soft fingers 40 mm apart on x; one synergy closes both by 1 m per unit.

    Each contact row has a joint of its own, J = I. Compliances of the left and the right contact in m/N.
    """
    contacts = tuple(
        Contact(name=name, kind=made_kind("soft", mu, nu), point=frozen(point), frame=contact_frame(normal))
        for name, point, normal in (("left", [-0.02, 0, 0], [1, 0, 0]), ("right", [0.02, 0, 0], [-1, 0, 0]))
    )
    S = np.zeros((8, 1))
    S[[0, 4], 0] = 1
    return Grasp(
        title="pinch",
        contacts=contacts,
        G=grasp_matrix(contacts),
        J=frozen(np.eye(8)),
        S=frozen(S),
        C_s=frozen(np.diag(np.repeat(compliance, 4))),
        C_q=frozen(joint_compliance * np.eye(8)),
        C_z=frozen(np.zeros((1, 1))),
        lambda_0=None,
        w_0=frozen(np.zeros(6)),
        joints=tuple(f"q{i}" for i in range(8)),
        synergies=("squeeze",),
    )


def tripod(mu: float = 0.8, below: float = 0.0) -> Grasp:
    """Three hard fingers at 120 degrees on a ball of 40 mm, `below` its equator [rad], each with its own synergy."""
    contacts = []
    for i in range(3):
        angle = 2 * np.pi * i / 3
        out = np.array([np.cos(below) * np.cos(angle), np.cos(below) * np.sin(angle), -np.sin(below)])
        contacts.append(
            Contact(name=f"C{i}", kind=made_kind("hard", mu, 0), point=frozen(0.04 * out), frame=contact_frame(-out))
        )
    S = np.zeros((9, 3))
    S[[0, 3, 6], [0, 1, 2]] = 1
    return Grasp(
        title="tripod",
        contacts=tuple(contacts),
        G=grasp_matrix(contacts),
        J=frozen(np.eye(9)),
        S=frozen(S),
        C_s=frozen(1e-3 * np.eye(9)),
        C_q=frozen(np.zeros((9, 9))),
        C_z=frozen(np.zeros((3, 3))),
        lambda_0=None,
        w_0=frozen(np.zeros(6)),
        joints=tuple(f"q{i}" for i in range(9)),
        synergies=("a", "b", "c"),
    )
