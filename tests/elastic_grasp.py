"""The statics of a grasp written down anew for tests: one elastic system, the friction formulas, sizes of motions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from made_kinds import spin_of

from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array

AXES = ("x", "y", "z", "rx", "ry", "rz")


@dataclass(frozen=True)
class Course:
    """What references and loads do over time."""

    times: Array  # (T,)
    dz_r: Array  # (T, n_z)
    wrench: Array  # (T, 6)
    forces: Array  # (T, n_l)
    torques: Array  # (T, n_q)
    efforts: Array  # (T, n_z)
    du: Array  # (T, 6)
    sag: Array  # (T, 6)
    dq: Array  # (T, n_q)
    dz: Array  # (T, n_z)


def course(grasp: Grasp, times: Array, dz_r: Array, wrench: Array) -> Course:
    """Solve ``C dlambda + G' du = J S dz_r`` and ``G dlambda = -dw``, C the compliances of contacts, joints, synergies.

    Forces at the start are given, or the elastic answer to the load then.
    """
    J, S, G = grasp.J, grasp.S, grasp.G
    C = grasp.C_s + J @ (grasp.C_q + S @ grasp.C_z @ S.T) @ J.T
    n_l, stiffness = len(C), 1e3  # 1 N/mm brings the two halves of the system to one size
    system = np.block([[stiffness * C, stiffness * G.T], [G, np.zeros((6, 6))]])

    def answer(moved: Array, load: Array) -> tuple[Array, Array]:
        right = np.hstack([stiffness * moved, -load]).T
        found = np.linalg.solve(system, right)
        found += np.linalg.solve(system, right - system @ found)
        return found[:n_l].T, found[n_l:].T

    still = np.zeros((len(times), n_l))
    start = grasp.lambda_0 if grasp.lambda_0 is not None else answer(still[:1], grasp.w_0[None])[0][0]
    change, du = answer(dz_r @ (J @ S).T, wrench - grasp.w_0)
    _, sag = answer(still, wrench - grasp.w_0)
    forces, d_torques = start + change, change @ J
    dz = dz_r - d_torques @ S @ grasp.C_z.T
    dq = dz @ S.T - d_torques @ grasp.C_q.T
    return Course(times, dz_r, wrench, forces, forces @ J, forces @ J @ S, du, sag, dq, dz)


def slip_margins(grasp: Grasp, forces: Array) -> Array:
    """Return ``mu n - ||(t, o, mu m / nu)||`` (T, n_c) [N]."""
    found = []
    for contact, rows in zip(grasp.contacts, grasp.rows, strict=True):
        part = np.array(forces[:, rows])
        if part.shape[1] == 4:
            part[:, 3] *= contact.friction / spin_of(contact)
        found.append(contact.friction * part[:, 0] - np.linalg.norm(part[:, 1:], axis=1))
    return np.column_stack(found)


def normal_forces(grasp: Grasp, forces: Array) -> Array:
    """Return the normal forces (T, n_c) [N]."""
    return forces[:, [rows.start for rows in grasp.rows]]


def length_of(grasp: Grasp) -> tuple[float, Array]:
    """Return the mean distance of the contacts from their centroid, and the centroid (3,) [m]."""
    points = np.array([contact.point for contact in grasp.contacts])
    middle = points.mean(axis=0)
    return float(np.linalg.norm(points - middle, axis=1).mean()), middle


def motion_at_centroid(grasp: Grasp, u: Array) -> Array:
    """Return small motions (T, 6): of the centroid of the contacts, and rotations times length [m]."""
    length, middle = length_of(grasp)
    return np.hstack([u[:, :3] + np.cross(u[:, 3:], middle), length * u[:, 3:]])


def held_motions(grasp: Grasp) -> Array:
    """Return object motions (6, r) about B that contacts see, at right angles to those that none sees.

    Right angles are those of motions of the centroid and of rotations times length.
    """
    length, _ = length_of(grasp)
    scaled = motion_at_centroid(grasp, np.eye(6)).T
    rows = np.array([length if component == "m" else 1.0 for _, component in grasp.components])
    _, values, motions = np.linalg.svd((rows * grasp.G).T @ np.linalg.inv(scaled))
    rank = int(np.sum(values > 1e-8 * values[0]))
    return np.eye(6) if rank == 6 else np.linalg.solve(scaled, motions[:rank].T)


def sizes_on(grasp: Grasp, axes: tuple[str, ...], u: Array) -> Array:
    """Return sizes (T,) of small motions (T, 6) on some axes about B, rotations times length [m]."""
    length, _ = length_of(grasp)
    return np.linalg.norm((u * ([1.0] * 3 + [length] * 3))[:, [AXES.index(axis) for axis in axes]], axis=1)
