"""Does every contact direction yield? The refusal when contact, joints and synergies are all rigid in one."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from synergrip.errors import Issue, RigidContactError
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.scale import Metric
from synergrip.grasps.stack import Matrices
from synergrip.linalg import SINGULAR, Array, canonical

PLAINLY = 1e-9
"""Contacts that yield in every direction at least so much, of what they yield in all, need no singular values."""


def refuse_rigid_contacts(grasp: Grasp, metric: Metric) -> None:
    """Refuse a grasp whose total compliance has a null space.

    Raises:
        RigidContactError: naming the contact component that comes nearest to the rigid direction.
    """
    matrices = Matrices.of(grasp)
    if not is_rigid(matrices, metric):
        return
    _, values, directions = np.linalg.svd(_yielding(matrices, metric), full_matrices=False)
    rigid = directions[values <= SINGULAR]
    raise _rigid(grasp, int(np.argmax(np.abs(canonical(rigid.T)[:, 0]))))


def is_rigid(matrices: Matrices, metric: Metric) -> NDArray[np.bool_]:
    """Return of which grasps (...) the total compliance has a null space."""
    rigid = np.array(~_contacts_yield_plainly(matrices.C_s, metric))
    if np.any(rigid):
        values = np.linalg.svd(_yielding(matrices.taken(rigid), metric.taken(rigid)), compute_uv=False)
        rigid[rigid] = values[..., -1] <= SINGULAR
    return rigid


def _contacts_yield_plainly(C_s: Array, metric: Metric) -> NDArray[np.bool_]:
    """Return where scaled C_s has no small eigenvalue, by bounds that cost less than eigenvalues.

    Its diagonal alone shows it (Gershgorin) where contacts yield in each direction mostly by themselves.
    """
    force = metric.force[..., None]
    diagonal = np.diagonal(C_s, axis1=-2, axis2=-1)[..., None] / force**2
    rows = np.abs(C_s) @ (1 / force) / force
    size = _norm(rows)  # at least that of the matrix
    plain = np.array((2 * diagonal - rows).min(axis=(-2, -1)) > PLAINLY * size)
    if not np.all(plain):
        least = diagonal[~plain].min(axis=(-2, -1))
        plain[~plain] = least * smallest_of_unit_diagonal(C_s[~plain]) > PLAINLY * size[~plain]
    return plain


def smallest_of_unit_diagonal(matrices: Array) -> Array:
    """Return what no eigenvalue of matrices is smaller than once they are scaled to a diagonal of ones; or 0.

    Their n eigenvalues have the sum n: the least of them is the determinant through the product of the others, which
    is at most ``(n / (n - 1))^(n - 1) < e``. The determinant is that of the matrix through its diagonal.
    """
    try:
        factors = np.linalg.cholesky(matrices)
    except np.linalg.LinAlgError:  # of one of them or more
        return np.array([smallest_of_unit_diagonal(each) for each in matrices]) if matrices.ndim > 2 else np.array(0.0)
    squares = np.diagonal(factors, axis1=-2, axis2=-1) ** 2 / np.diagonal(matrices, axis1=-2, axis2=-1)
    return np.asarray(squares.prod(axis=-1) / np.e)


def _yielding(matrices: Matrices, metric: Metric) -> Array:
    """Return (..., m, n_l), the parts of the total compliance on top of each other; its null space leaves all rigid.

    The compliances are positive semidefinite, so what their sum leaves rigid each of them leaves rigid. Each is
    measured against itself: contacts may be as much stiffer than joints as they like.
    """
    J, S, C_q, C_z = metric.scaled_rows(matrices.J), matrices.S, matrices.C_q, matrices.C_z
    C_s = metric.scaled_rows(matrices.C_s) / metric.force[..., None, :]
    parts = (C_s, C_q @ J.mT, C_z @ S.mT @ J.mT)
    sizes = (np.zeros(C_s.shape[:-2]), _norm(C_q) * _norm(J), _norm(C_z) * _norm(S) * _norm(J))
    return np.concatenate([_measured(part, size) for part, size in zip(parts, sizes, strict=True)], axis=-2)


def _measured(part: Array, size: Array) -> Array:
    """Return a part in units of itself; 0 where it is rounding beside the `size` of what it is a product of."""
    norm = _norm(part)
    counts = norm > SINGULAR * size
    return np.asarray(part * np.where(counts, 1 / np.where(counts, norm, 1.0), 0.0)[..., None, None])


def _norm(matrix: Array) -> Array:
    return np.asarray(np.linalg.norm(matrix, axis=(-2, -1)))


def _rigid(grasp: Grasp, row: int) -> RigidContactError:
    contact, component = grasp.components[row]
    message = (
        f"the force component {component} of contact {contact} has no compliance: contact, joints and synergies are "
        "all rigid in that direction, so the force along it is undetermined (hyperstatic); let the contact yield there"
    )
    return RigidContactError([Issue(message, key="C_s")], contact, component)
