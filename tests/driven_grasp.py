"""Grasps in which every component of every contact force has a synergy of its own: all internal forces are open."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from made_kinds import made_kind

from synergrip.grasps.contacts.contact import Contact, contact_frame
from synergrip.grasps.grasp import Grasp, grasp_matrix
from synergrip.linalg import Array, frozen


def touch(name: str, kind: str, point: Sequence[float] | Array, normal: Sequence[float] | Array, mu: float) -> Contact:
    """A contact; a soft one carries 10 mm of spin moment for each newton."""
    spin = 0.01 if kind == "soft" else 0.0
    return Contact(
        name=name,
        kind=made_kind(kind, mu, spin),
        point=frozen(point),
        frame=contact_frame(np.asarray(normal, dtype=float)),
    )


def driven(contacts: Sequence[Contact], stiffness: float = 1e3) -> Grasp:
    """The contacts, each component moved by a joint and a synergy of its own; stiffness in N/m."""
    G = grasp_matrix(contacts)
    n_l = G.shape[1]
    eye, zero = frozen(np.eye(n_l)), frozen(np.zeros((n_l, n_l)))
    names = tuple(f"q{i}" for i in range(n_l))
    return Grasp(
        title="driven",
        contacts=tuple(contacts),
        G=G,
        J=eye,
        S=eye,
        C_s=frozen(np.eye(n_l) / stiffness),
        C_q=zero,
        C_z=zero,
        lambda_0=None,
        w_0=frozen(np.zeros(6)),
        joints=names,
        synergies=names,
    )


def nose_cone() -> Grasp:
    """Five hard fingers of friction 0.3 under the paraboloid z = x^2 + y^2.

    So in the AMPL model of the grasping example of Lobo, Vandenberghe, Boyd and Lebret (1998).
    """
    angles = 2 * np.pi * np.arange(1, 6) / 5
    points = np.column_stack([0.3 + np.cos(angles), np.sin(angles), np.zeros(5)])
    points[:, 2] = (points[:, :2] ** 2).sum(axis=1)
    inward = np.column_stack([-2 * points[:, :2], np.ones(5)])
    return driven([touch(f"C{i + 1}", "hard", points[i], inward[i], 0.3) for i in range(5)])
