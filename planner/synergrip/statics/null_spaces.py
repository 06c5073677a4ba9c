"""The null spaces after which grasps are called redundant, indeterminate, graspable, defective and hyperstatic.

For a fully actuated hand they are those of J; for one that synergies drive, ``J S`` takes its place. No compliance has
a part in them, and the ranks are decided as everywhere: on matrices without units, beside their largest singular value.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from synergrip.grasps.grasp import Grasp
from synergrip.grasps.scale import Scale
from synergrip.linalg import SINGULAR, Array, Decision, canonical, frozen, split
from synergrip.values import ByName, Value

HANDBOOK = "Prattichizzo and Trinkle, Grasping, in: Springer Handbook of Robotics"
GRASPABILITY = "Prattichizzo and Bicchi, Dynamic analysis of mobility and graspability, IEEE T-RA 14(2), 1998"
FORCES, MOTION = "N, N m", "m, rad"


@dataclass(frozen=True, eq=False, repr=False)
class NullSpace(Value):
    """A null space, and what a grasp that has one is called."""

    name: str
    """What the grasp is called where the dimension is not 0: "redundant", "indeterminate", ..."""
    formula: str
    meaning: str
    """What the vectors of it are."""
    unit: str
    source: str
    basis: Array
    """(n, dimension) orthonormal in scaled coordinates (joints and synergies as they are), each column determined by
    the subspace alone."""
    decision: Decision
    """The rank decision behind the dimension."""

    @property
    def dimension(self) -> int:
        """How many independent vectors there are."""
        return int(self.basis.shape[1])

    @property
    def holds(self) -> bool:
        """Whether the grasp is what the name says."""
        return self.dimension > 0


def null_spaces(grasp: Grasp, scale: Scale, *, synergies: bool) -> Mapping[str, NullSpace]:
    """Return the five null spaces of a grasp by the names of what they make it.

    Args:
        grasp: the grasp.
        scale: its scaled coordinates.
        synergies: whether the synergies drive it, or every joint by itself.
    """
    moved = "J S" if synergies else "J"
    by, effort = ("synergies", "actuator effort") if synergies else ("joints", "joint torque")
    of_object, of_hand = scale.scaled_grasp(grasp.G), scaled_motion(grasp, scale, synergies=synergies)
    size = motion_size(grasp, scale, of_hand, synergies=synergies)
    twists, internal = split(of_object), split(of_object.T)
    idle, unfelt = split(of_hand, size), split(of_hand.T, size)
    unseen = split(of_hand.T @ internal.null_space, size)
    both = internal.null_space @ unseen.null_space
    force = scale.force[:, None]
    of_joints = "synergy units" if synergies else "rad, m"
    found = (
        NullSpace("redundant", f"null({moved})", f"{by} move and no contact does", of_joints, HANDBOOK,
                  canonical(idle.null_space), idle.decision),
        NullSpace("indeterminate", "null(G')", "the object moves and no contact does", MOTION, HANDBOOK,
                  frozen(np.linalg.solve(scale.motion, canonical(twists.null_space))), twists.decision),
        NullSpace("graspable", "null(G)", "contact forces in balance: internal forces", FORCES, HANDBOOK,
                  frozen(canonical(internal.null_space) / force), internal.decision),
        NullSpace("defective", f"null(({moved})')" if synergies else "null(J')", f"contact forces without {effort}",
                  FORCES, HANDBOOK, frozen(canonical(unfelt.null_space) / force), unfelt.decision),
        NullSpace("hyperstatic", f"null(({moved})') ∩ null(G)" if synergies else "null(J') ∩ null(G)",
                  f"internal forces without {effort}", FORCES, GRASPABILITY,
                  frozen(canonical(both) / force), unseen.decision),
    )  # fmt: skip
    return ByName("null spaces", {each.name: each for each in found})


def scaled_motion(grasp: Grasp, scale: Scale, *, synergies: bool) -> Array:
    """Return J S, or J, in scaled contact motions (n_l, n)."""
    J = scale.scaled_rows(grasp.J)
    return J @ grasp.S if synergies else J


def motion_size(grasp: Grasp, scale: Scale, of_hand: Array, *, synergies: bool) -> float:
    """Return the largest singular value of J S, or of J; 0 where it is nothing but rounding of its factors."""
    if not of_hand.size:
        return 0.0
    size = float(np.linalg.norm(of_hand, 2))
    factors = float(np.linalg.norm(scale.scaled_rows(grasp.J))) * (float(np.linalg.norm(grasp.S)) if synergies else 1.0)
    return size if size > SINGULAR * factors else 0.0
