"""Does every contact direction yield? The refusal when contact, joints and synergies are all rigid in one."""

from __future__ import annotations

import numpy as np

from synergrip.errors import Issue, RigidContactError
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.scale import Scale
from synergrip.linalg import SINGULAR, canonical


def refuse_rigid_contacts(grasp: Grasp, scale: Scale) -> None:
    """Refuse a grasp whose total compliance has a null space.

    The compliances are positive semidefinite, so what their sum leaves rigid each of them leaves rigid. Each is
    measured against itself: contacts may be as much stiffer than joints as they like.

    Raises:
        RigidContactError: naming the contact component that comes nearest to the rigid direction.
    """
    J, S = grasp.J / scale.force[:, None], grasp.S
    parts = (grasp.C_s / np.outer(scale.force, scale.force), grasp.C_q @ J.T, grasp.C_z @ S.T @ J.T)
    sizes = (0.0, _norm(grasp.C_q) * _norm(J), _norm(grasp.C_z) * _norm(S) * _norm(J))
    norms = [_norm(part) for part in parts]
    yielding = [part / norm for part, norm, size in zip(parts, norms, sizes, strict=True) if norm > SINGULAR * size]
    _, values, directions = np.linalg.svd(np.vstack([np.zeros((grasp.n_l, grasp.n_l)), *yielding]), full_matrices=False)
    rigid = directions[values <= SINGULAR]
    if len(rigid):
        raise _rigid(grasp, int(np.argmax(np.abs(canonical(rigid.T)[:, 0]))))


def _norm(matrix: np.ndarray) -> float:
    return float(np.linalg.norm(matrix))


def _rigid(grasp: Grasp, row: int) -> RigidContactError:
    contact, component = grasp.components[row]
    message = (
        f"the force component {component} of contact {contact} has no compliance: contact, joints and synergies are "
        "all rigid in that direction, so the force along it is undetermined (hyperstatic); let the contact yield there"
    )
    return RigidContactError([Issue(message, key="C_s")], contact, component)
