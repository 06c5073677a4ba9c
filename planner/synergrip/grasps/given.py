"""A grasp given as matrices, made into the same value as any other grasp."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from synergrip.documents.documents import read_document
from synergrip.documents.quantities import in_mm
from synergrip.documents.words import listed
from synergrip.errors import InputError, Issue
from synergrip.grasps.contacts.contact import Contact, contact_frame
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.matrices import GivenContact, Matrices, read_matrices
from synergrip.linalg import Array, frozen
from synergrip.vectors import skews

AGREEMENT = 1e-6
"""Relative difference up to which given points and frames agree with G."""
CONTRADICTION = 1e-2
"""Difference from G, relative or in radians, from which given points and normals are refused."""
ORTHONORMAL = 1e-3
"""How far the force columns of G may be from unit vectors normal to each other to be a contact frame."""


def read_given(path: Path, key: str = "") -> Grasp:
    """Return the grasp of a file of matrices.

    Args:
        path: the JSON file.
        key: the key of the problem file that names it, as for `read_matrices`.

    Raises:
        InputError: everything that is wrong with the file, each with its place.
    """
    matrices = read_matrices(path, key)
    try:
        return given(matrices)
    except InputError as error:
        raise error.located(read_document(path, numbers=True).locate) from None


def given(matrices: Matrices) -> Grasp:
    """Return the grasp of validated matrices. Joints and synergies are numbered, w_0 follows from lambda_0.

    Raises:
        InputError: points or normals that contradict G, or a normal force that makes no force on the object.
    """
    w_0 = np.zeros(6)
    if matrices.w_0 is not None:
        w_0 = np.asarray(matrices.w_0)
    elif matrices.lambda_0 is not None:
        w_0 = -matrices.G @ matrices.lambda_0
    columns = _columns(matrices)
    if issues := [*_directions(matrices, columns), *_places(matrices, columns)]:
        raise InputError(issues)
    points = _points(matrices, columns)
    contacts = tuple(
        _contact(data, column, point, _normal_at(matrices, k))
        for k, (data, column, point) in enumerate(zip(matrices.contacts, columns, points, strict=True))
    )
    return Grasp(
        title=matrices.title, contacts=contacts, G=matrices.G, J=matrices.J, S=matrices.S,
        C_s=matrices.C_s, C_q=matrices.C_q, C_z=matrices.C_z, lambda_0=matrices.lambda_0, w_0=frozen(w_0),
        joints=numbered("q", matrices.J.shape[1]), synergies=numbered("z", matrices.S.shape[1]),
    )  # fmt: skip


def numbered(letter: str, count: int) -> tuple[str, ...]:
    """Return the names ``q1, q2, ...`` of joints, or ``z1, z2, ...`` of synergies, that have none."""
    return tuple(f"{letter}{i + 1}" for i in range(count))


def _columns(matrices: Matrices) -> list[Array]:
    """Return the columns of G of each contact."""
    widths = [len(data.kind.components) for data in matrices.contacts]
    return [np.asarray(part) for part in np.split(matrices.G, np.cumsum(widths)[:-1], axis=1)]


def _is_frame(forces: Array) -> bool:
    return bool(np.allclose(forces.T @ forces, np.eye(forces.shape[1]), rtol=0, atol=ORTHONORMAL))


def _directions(matrices: Matrices, columns: list[Array]) -> Iterator[Issue]:
    """Refuse normals that are not there, or differ from those in G."""
    for k, (data, forces) in enumerate(zip(matrices.contacts, (c[:3, :3] for c in columns), strict=True)):
        n = forces[:, 0]
        if not np.any(n):
            yield Issue(f"the normal force of contact {data.name} makes no force on the object", key="G")
        elif data.normal is not None and _is_frame(forces):
            angle = float(np.arctan2(np.linalg.norm(np.cross(n, data.normal)), n @ data.normal))
            if angle > CONTRADICTION:
                message = f"is {np.degrees(angle):.3g} deg from the normal force of contact {data.name} in G"
                yield Issue(f"{message}, ({', '.join(f'{part:.4g}' for part in n)})", key=f"contacts[{k}].normal")


def _places(matrices: Matrices, columns: list[Array]) -> Iterator[Issue]:
    """Refuse points that G contradicts, wherever the origin of B is."""
    if any(data.point is None for data in matrices.contacts):
        return
    judged = [
        (k, np.asarray(data.point), *_moment_system(c[:, :3]))
        for k, (data, c) in enumerate(zip(matrices.contacts, columns, strict=True))
        if _is_frame(c[:3, :3])
    ]
    if not judged:
        return
    off = [m - A @ p for _, p, A, m in judged]
    origin = np.linalg.lstsq(np.vstack([-A for _, _, A, _ in judged]), np.concatenate(off), rcond=None)[0]
    gaps = [
        float(np.linalg.norm(each + A @ origin) / np.linalg.norm(A, 2))
        for each, (_, _, A, _) in zip(off, judged, strict=True)
    ]
    size = max(max(float(np.linalg.norm(p - origin)), float(np.abs(m).max())) for _, p, _, m in judged)
    worst = int(np.argmax(gaps))
    if gaps[worst] > CONTRADICTION * size:
        k = judged[worst][0]
        message = f"is {in_mm(gaps[worst])} off the moments of contact {matrices.contacts[k].name} in G"
        yield Issue(f"{message}; no origin of B makes the points agree with G", key=f"contacts[{k}].point_m")


def _points(matrices: Matrices, columns: list[Array]) -> list[Array]:
    """Return the contact points (3,) from B: as given, when G agrees, else the least ones that G allows.

    Points may be given from another origin than B; G tells which, in the least-squares sense.
    """
    systems = [_moment_system(c[:, :3]) for c in columns]
    given_points = [data.point for data in matrices.contacts if data.point is not None]
    if len(given_points) == len(columns):
        A = np.vstack([-matrix for matrix, _ in systems])
        b = np.concatenate([m - matrix @ p for (matrix, m), p in zip(systems, given_points, strict=True)])
        origin = np.linalg.lstsq(A, b, rcond=None)[0]
        size = float(np.abs([p - origin for p in given_points]).max(initial=0.0))
        if np.abs(A @ origin - b).max(initial=0.0) <= AGREEMENT * size:
            return [p - origin for p in given_points]
    return [np.asarray(np.linalg.lstsq(matrix, m, rcond=None)[0]) for matrix, m in systems]


def _moment_system(columns: Array) -> tuple[Array, Array]:
    """Return matrix and right-hand side of ``p x f = m`` for all force columns (f, m) of a contact."""
    return np.vstack([-skews(f) for f in columns[:3].T]), columns[3:].T.ravel()


def _normal_at(matrices: Matrices, k: int) -> str:
    """Return everything in the file whose sign goes with the normal of contact `k`."""
    row = sum(len(data.kind.components) for data in matrices.contacts[:k])
    coupled = np.any(np.delete(matrices.C_s[row], row))
    places = [
        *([f"contacts[{k}].normal"] if matrices.contacts[k].normal is not None else []),
        f"column {row} of G (counted from 0)", f"row {row} of J",
        *([f"row and column {row} of C_s"] if coupled else []),
        *([f"lambda_0[{row}]"] if matrices.lambda_0 is not None else []),
    ]  # fmt: skip
    return listed(places)


def _contact(data: GivenContact, columns: Array, point: Array, normal_at: str) -> Contact:
    """Return a contact; its frame, where not given, is read from its columns of G."""
    force = columns[:3, :3]
    normal = np.array([0.0, 0.0, 1.0])
    if data.normal is not None:
        normal = np.asarray(data.normal)
    elif np.any(force[:, 0]):
        normal = force[:, 0]
    square = force.shape[1] == 3 and np.allclose(force.T @ force, np.eye(3), atol=AGREEMENT)
    frame = frozen(force) if square else contact_frame(normal)
    return Contact(name=data.name, kind=data.kind, point=frozen(point), frame=frame, normal_at=normal_at)
