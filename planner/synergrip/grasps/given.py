"""A grasp given as matrices, made into the same value as any other grasp."""

from __future__ import annotations

import numpy as np

from synergrip.grasps.contact import Contact, contact_frame
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.kinds import contact_kind
from synergrip.grasps.matrices import ContactData, Matrices
from synergrip.linalg import Array, frozen


def given(matrices: Matrices) -> Grasp:
    """Return the grasp of validated matrices. Joints and synergies are numbered, w_0 follows from lambda_0."""
    w_0 = np.zeros(6)
    if matrices.w_0 is not None:
        w_0 = np.asarray(matrices.w_0)
    elif matrices.lambda_0 is not None:
        w_0 = -matrices.G @ matrices.lambda_0
    contacts, start = [], 0
    for data in matrices.contacts:
        kind = contact_kind(data.kind)
        contacts.append(_contact(data, matrices.G[:, start : start + len(kind.components)]))
        start += len(kind.components)
    return Grasp(
        matrices.title, tuple(contacts), matrices.G, matrices.J, matrices.S,
        matrices.C_s, matrices.C_q, matrices.C_z, matrices.lambda_0, frozen(w_0),
        tuple(f"q{i + 1}" for i in range(matrices.J.shape[1])), tuple(f"z{i + 1}" for i in range(matrices.S.shape[1])),
    )  # fmt: skip


def _contact(data: ContactData, columns: Array) -> Contact:
    """Return a contact whose frame and point, where not given, are read from its columns of G."""
    force = columns[:3, : min(columns.shape[1], 3)]
    if data.normal is not None:
        normal = np.asarray(data.normal)
    else:
        normal = force[:, 0] if np.any(force[:, 0]) else np.array([0.0, 0.0, 1.0])
    square = force.shape[1] == 3 and np.allclose(force.T @ force, np.eye(3), atol=1e-6)
    frame = frozen(force) if square else contact_frame(normal)
    f, m = columns[:3, 0], columns[3:, 0]
    point = np.cross(f, m) / (f @ f) if np.any(f) else np.zeros(3)
    if square:  # p x force = moment, column by column
        moved = columns[3:, :3] @ force.T
        point = np.array([moved[2, 1] - moved[1, 2], moved[0, 2] - moved[2, 0], moved[1, 0] - moved[0, 1]]) / 2
    return Contact(data.name, contact_kind(data.kind), data.friction, data.spin_friction, frozen(point), frame)
