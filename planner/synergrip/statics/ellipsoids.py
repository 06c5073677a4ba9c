"""How much the object yields, and how much it is moved and squeezed by references, direction by direction.

Lengths and angles are made comparable by the characteristic length; translation and rotation are told by themselves,
too, about B and in their own units. The stiffness is that of the linear model, with the references fixed: C_s, C_q
and C_z yield, and what contact forces do as they turn with the object is left out.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from synergrip.linalg import RANK_TOLERANCE, SINGULAR, Array, frozen
from synergrip.statics.response import Response
from synergrip.values import ByName, Value

STIFFNESS = "Cutkosky and Kao, Computing and controlling the compliance of a robotic hand, IEEE T-RA 5(2), 1989"
MANIPULABILITY = (
    "Prattichizzo, Malvezzi, Gabiccini and Bicchi, On the manipulability ellipsoids of underactuated robotic hands "
    "with compliance, Robotics and Autonomous Systems 60(3), 2012"
)
PER = "per unit"
"""Of the synergies."""


@dataclass(frozen=True, eq=False, repr=False)
class Ellipsoid(Value):
    """What a map makes of all inputs of size 1: principal values with their axes, the largest first."""

    name: str
    formula: str
    unit: str
    """Of the values."""
    source: str
    values: Array
    """(k,) lengths of the half axes."""
    axes: Array
    """(n, k) directions in SI units: twists about B [m, rad] of scaled length 1 (6), unit vectors (3), or contact
    forces [N, N m] of scaled length 1 (n_l). Where values are equal, any of their plane would do."""
    references: Array | None = None
    """(n_z, k) unit vectors that the map sends there; None where the inputs are no references."""

    @property
    def isotropy(self) -> float:
        """The smallest value through the largest; 1 for a sphere, and 0 where nothing happens in some direction."""
        largest = float(self.values.max(initial=0.0))
        if not len(self.values) or largest == 0:
            return 0.0
        return 0.0 if np.isinf(largest) else float(self.values.min()) / largest


def object_stiffness(response: Response) -> tuple[Array, Array | None]:
    """Return stiffness ``G K G'`` and compliance (6, 6) of the object about B; no compliance where it is free to move.

    Returns:
        the wrench for each displacement [N/m, N, N m/rad], and the displacement for each wrench.
    """
    held, values, vectors = _principal(response)
    scaled = (vectors[:, :held] / values[:held]) @ vectors[:, :held].T
    stiffness = response.scale.motion.T @ scaled @ response.scale.motion
    return frozen((stiffness + stiffness.T) / 2), response.du_dw if response.restrained else None


def ellipsoids(response: Response, forces: int, motions: int) -> Mapping[str, Ellipsoid]:
    """Return stiffness, compliance and manipulability by name.

    Args:
        response: of the grasp.
        forces: rank of the force map, the dimension of E_s; what is beyond it is rounding and told as 0.
        motions: rank of the motion map, likewise.
    """
    found = (*_of_stiffness(response), *_of_references(response, forces, motions))
    return ByName("ellipsoids", {each.name: each for each in found})


def _principal(response: Response) -> tuple[int, Array, Array]:
    """Return how many motions are resisted, principal compliances (6,) [m/N] and scaled twists (6, 6) as columns.

    The compliances of those that are resisted come first, the largest of them last; the others are infinite.
    """
    motion, free = response.scale.motion, response.free
    held = 6 - free.shape[1]
    kept = np.linalg.svd(free, full_matrices=True)[0][:, 6 - held :] if free.size else np.eye(6)
    values, vectors = np.linalg.eigh(kept.T @ motion @ response.du_dw @ motion.T @ kept)
    return held, np.concatenate([values, np.full(6 - held, np.inf)]), np.hstack([kept @ vectors, free])


def _of_stiffness(response: Response) -> Iterator[Ellipsoid]:
    _, values, vectors = _principal(response)
    twists = np.linalg.solve(response.scale.motion, _signed(vectors))
    K, C = object_stiffness(response)
    yield Ellipsoid("stiffness", "G K G'", "N/m", STIFFNESS, frozen(1 / values), frozen(twists))
    yield Ellipsoid("compliance", "(G K G')^-1", "m/N", STIFFNESS, frozen(values[::-1]), frozen(twists[:, ::-1]))
    yield _block("stiffness to translation", "G K G', translation", "N/m", K[:3, :3])
    yield _block("stiffness to rotation", "G K G', rotation about B", "N m/rad", K[3:, 3:])
    if C is not None:
        yield _block("compliance in translation", "(G K G')^-1, translation", "m/N", C[:3, :3])
        yield _block("compliance in rotation", "(G K G')^-1, rotation", "rad/(N m)", C[3:, 3:])


def _block(name: str, formula: str, unit: str, block: Array) -> Ellipsoid:
    """Return the ellipsoid of a symmetric block (3, 3), which is positive semidefinite but for rounding."""
    values, axes = np.linalg.eigh(block)
    values = np.where(values > SINGULAR * values[-1], values, 0.0)
    return Ellipsoid(name, formula, unit, STIFFNESS, frozen(values[::-1]), frozen(_signed(axes[:, ::-1])))


def _of_references(response: Response, forces: int, motions: int) -> Iterator[Ellipsoid]:
    scale, U = response.scale, response.du_dzr
    force, moved = scale.force[:, None], scale.motion @ response.du_dzr
    turned = RANK_TOLERANCE * np.linalg.norm(moved, 2) if U.size else 0.0
    made = (
        ("motion by references", "U", f"m {PER}", moved, motions, 0.0),
        ("translation by references", "U, translation", f"m {PER}", U[:3], motions, turned),
        ("rotation by references", "U, rotation", f"rad {PER}", U[3:], motions, turned / scale.length),
        ("force by references", "F", f"N {PER}", force * response.dlambda_dzr, forces, 0.0),
    )  # fmt: skip
    for name, formula, unit, matrix, rank, least in made:
        axes, values, inputs = np.linalg.svd(matrix, full_matrices=False)
        values = np.where((np.arange(len(values)) < rank) & (values > least), values, 0.0)
        signs = _signs(inputs.T)
        axes = axes * signs
        if formula == "U":
            axes = np.linalg.solve(scale.motion, axes)
        elif formula == "F":
            axes = axes / force
        yield Ellipsoid(name, formula, unit, MANIPULABILITY, frozen(values), frozen(axes), frozen(inputs.T * signs))


def _signed(columns: Array) -> Array:
    return columns * _signs(columns)


def _signs(columns: Array) -> Array:
    """Return 1 or -1 for each column, which makes its largest entry positive (the first of those that are as large)."""
    if not columns.size:
        return np.ones(columns.shape[1])
    sizes = np.abs(columns)
    first = np.argmax(sizes > sizes.max(axis=0) - 1e-9, axis=0)
    return np.where(columns[first, range(columns.shape[1])] < 0, -1.0, 1.0)
