"""Grasps small enough for closed forms, given as matrices: a pinch, three fingers on or below a ball's equator."""

from __future__ import annotations

import numpy as np

from synergrip.grasps.contacts.contact import Contact, contact_frame
from synergrip.grasps.contacts.kinds import contact_kind
from synergrip.grasps.grasp import Grasp, grasp_matrix
from synergrip.linalg import frozen


def pinch(
    mu: float = 0.5, nu: float = 0.005, compliance: tuple[float, float] = (1e-3, 1e-3), joint_compliance: float = 0.0
) -> Grasp:
    """Two soft fingers 40 mm apart on x; one synergy closes both by 1 m per unit.

    Each contact row has a joint of its own, J = I. Compliances of the left and the right contact in m/N.
    """
    contacts = tuple(
        Contact(name, contact_kind("soft"), mu, nu, frozen(point), contact_frame(normal))
        for name, point, normal in (("left", [-0.02, 0, 0], [1, 0, 0]), ("right", [0.02, 0, 0], [-1, 0, 0]))
    )
    S = np.zeros((8, 1))
    S[[0, 4], 0] = 1
    return Grasp(
        "pinch", contacts, grasp_matrix(contacts), frozen(np.eye(8)), frozen(S),
        frozen(np.diag(np.repeat(compliance, 4))), frozen(joint_compliance * np.eye(8)), frozen(np.zeros((1, 1))),
        None, frozen(np.zeros(6)), tuple(f"q{i}" for i in range(8)), ("squeeze",),
    )  # fmt: skip


def tripod(mu: float = 0.8, below: float = 0.0) -> Grasp:
    """Three hard fingers at 120 degrees on a ball of 40 mm, `below` its equator [rad], each with its own synergy."""
    contacts = []
    for i in range(3):
        angle = 2 * np.pi * i / 3
        out = np.array([np.cos(below) * np.cos(angle), np.cos(below) * np.sin(angle), -np.sin(below)])
        contacts.append(Contact(f"C{i}", contact_kind("hard"), mu, 0, frozen(0.04 * out), contact_frame(-out)))
    S = np.zeros((9, 3))
    S[[0, 3, 6], [0, 1, 2]] = 1
    return Grasp("tripod", tuple(contacts), grasp_matrix(contacts), frozen(np.eye(9)), frozen(S),
                 frozen(1e-3 * np.eye(9)), frozen(np.zeros((9, 9))), frozen(np.zeros((3, 3))), None,
                 frozen(np.zeros(6)), tuple(f"q{i}" for i in range(9)), ("a", "b", "c"))  # fmt: skip
