"""What textbooks name of a grasp, from the definitions: NumPy and SciPy, nothing of the package but its numbers."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from scipy.linalg import null_space

from synergrip.grasps.grasp import Grasp
from synergrip.statics.grasp_properties import GraspProperties, grasp_properties

SMALL = 1e-8
"""Share of the largest singular value from which on one counts."""


class Plain:
    """The same from the definitions, with NumPy alone and nothing of the package but the numbers of the grasp."""

    def __init__(self, grasp: Grasp) -> None:
        points = np.array([contact.point for contact in grasp.contacts])
        centre = points.mean(axis=0)
        length = np.linalg.norm(points - centre, axis=1).mean()
        spin = np.array([component == "m" for _, component in grasp.components])
        x, y, z = centre
        moved = np.eye(6)
        moved[:3, 3:] = [[0, z, -y], [-z, 0, x], [y, -x, 0]]  # velocity of the centre
        self.motion = np.diag([1, 1, 1, length, length, length]) @ moved
        self.force = np.where(spin, 1 / length, 1.0)
        self.G = np.linalg.inv(self.motion).T @ grasp.G / self.force
        self.J, self.S = grasp.J / self.force[:, None], grasp.S
        self.C_s = grasp.C_s / np.outer(self.force, self.force)
        K = np.linalg.inv(self.C_s + self.J @ grasp.C_q @ self.J.T + self.J @ self.S @ grasp.C_z @ self.S.T @ self.J.T)
        self.stiffness = self.G @ K @ self.G.T
        self.U = np.linalg.pinv(self.stiffness, rcond=SMALL, hermitian=True) @ self.G @ K @ self.J @ self.S
        self.F = K @ (self.J @ self.S - self.G.T @ self.U)

    def spaces(self, J: np.ndarray) -> dict[str, np.ndarray]:
        size = np.linalg.norm(J, 2)
        both = np.vstack([J.T / size, self.G])
        given = {"redundant": J / size, "indeterminate": self.G.T, "graspable": self.G, "defective": J.T / size,
                 "hyperstatic": both}  # fmt: skip
        return {name: null_space(matrix, rcond=1e-8) for name, matrix in given.items()}


def same_space(one: np.ndarray, other: np.ndarray) -> bool:
    """Tell whether orthonormal columns span the same space."""
    return one.shape == other.shape and bool(np.allclose(one @ one.T, other @ other.T, atol=1e-8))


def disagreements(grasp: Grasp) -> list[str]:
    """Return what the package says otherwise than the definitions."""
    found, plain = grasp_properties(grasp), Plain(grasp)
    return [*_classes(found, plain), *_numbers(found, plain), *_effects(found, plain)]


def _classes(found: GraspProperties, plain: Plain) -> Iterator[str]:
    for by, spaces, J in (("J", found.of_joints, plain.J), ("J S", found.of_synergies, plain.J @ plain.S)):
        for name, expected in plain.spaces(J).items():
            scaled = {"indeterminate": plain.motion, "redundant": np.eye(J.shape[1])}.get(name, np.diag(plain.force))
            if not same_space(scaled @ spaces[name].basis, expected):
                yield f"{name} by {by}"


def _numbers(found: GraspProperties, plain: Plain) -> Iterator[str]:
    stiffness = np.linalg.eigvalsh(plain.stiffness)
    of_hand = np.linalg.svd(plain.J @ plain.S, compute_uv=False)
    counted = np.where(of_hand > SMALL * of_hand[0], of_hand, 0.0)
    held = np.linalg.svd(plain.G, compute_uv=False)
    least = held[5] if len(held) == 6 and held[5] > SMALL * held[0] else 0.0
    pairs = {
        "stiffness": (found.ellipsoids["stiffness"].values, stiffness[::-1]),
        "compliance": (1 / found.ellipsoids["compliance"].values, stiffness),
        "motion": (found.ellipsoids["motion by references"].values, np.linalg.svd(plain.U, compute_uv=False)),
        "force": (found.ellipsoids["force by references"].values, np.linalg.svd(plain.F, compute_uv=False)),
        "distance of G": (found.singularity["restraint"].smallest, least),
        "distance of J S": (found.singularity["synergies"].smallest, counted[-1]),
        "relative distance of J S": (found.singularity["synergies"].relative, counted[-1] / counted[0]),
        "matrix": (found.stiffness, plain.motion.T @ plain.stiffness @ plain.motion),
    }
    for name, (ours, theirs) in pairs.items():
        if not np.allclose(ours, theirs, rtol=1e-7, atol=1e-8 * np.abs(theirs).max()):
            yield name


def _effects(found: GraspProperties, plain: Plain) -> Iterator[str]:
    dimension = {name: each.dimension for name, each in found.effects.items()}
    still = null_space(plain.U / np.linalg.norm(plain.J @ plain.S, 2), rcond=SMALL).shape[1]
    pushes = np.linalg.matrix_rank(plain.F, SMALL * np.linalg.norm(plain.F))
    expected = {
        "pure squeeze": still - dimension["redundant motion"],
        "spurious squeeze": pushes - still + dimension["redundant motion"],
        "motion without force": plain.S.shape[1] - pushes - dimension["redundant motion"],
    }
    yield from (name for name, count in expected.items() if dimension[name] != count)
    if sum(dimension.values()) != plain.S.shape[1]:
        yield "sum of the dimensions"
