"""How far a grasp is from one that holds less: the smallest singular values of G, J S and the parts of J S.

The smallest singular value of a matrix is its distance, in the spectral norm, from the nearest one of lower rank
(Eckart and Young), so each is told beside the largest one: a share that small of the matrix decides.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from synergrip.grasps.grasp import Grasp
from synergrip.grasps.scale import Scale
from synergrip.linalg import Array, Decision, singular_values, split
from synergrip.statics.null_spaces import motion_size, scaled_motion
from synergrip.values import ByName, Value

SINGULAR_VALUE = "Li and Sastry, Task-oriented optimal grasping by multifingered robot hands, IEEE J-RA 4(1), 1988"


@dataclass(frozen=True, eq=False, repr=False)
class SingularityDistance(Value):
    """How far a matrix is from one of lower rank."""

    name: str
    formula: str
    meaning: str
    """What is lost there."""
    unit: str
    source: str
    full: int
    """The rank that it can have."""
    largest: float
    """What the singular values are told beside, in the unit."""
    decision: Decision
    """The rank that it has, and its singular values as shares of `largest`."""

    @property
    def relative(self) -> float:
        """The smallest singular value through the largest; 0 where the rank is not full."""
        return float(self.decision.singular_values[self.full - 1]) if self.decision.rank >= self.full > 0 else 0.0

    @property
    def smallest(self) -> float:
        """The smallest singular value, in the unit; 0 where the rank is not full."""
        return self.relative * self.largest


def singularity_distances(grasp: Grasp, scale: Scale) -> Mapping[str, SingularityDistance]:
    """Return the distances of a grasp to the singularities of its matrices, by their names."""
    of_object, of_hand = scale.scaled_grasp(grasp.G), scaled_motion(grasp, scale, synergies=True)
    size = motion_size(grasp, scale, of_hand, synergies=True)
    balanced = split(of_object.T)
    along, internal = balanced.row_space.T, balanced.null_space.T
    of_G, largest = singular_values(of_object), float(np.linalg.norm(of_object, 2))
    per, n_z = "m per unit", grasp.n_z
    found = (
        SingularityDistance("restraint", "G", "the contacts resist every motion of the object", "1", SINGULAR_VALUE, 6,
                            largest, Decision.of(of_G, largest)),
        _part("synergies", "J S", "every synergy moves contacts in its own way", per, of_hand, n_z, size),
        _part("motion by synergies", "part of J S in range(G')", "each has a part that the object follows",
              per, along @ of_hand, n_z, size),
        _part("squeeze by synergies", "part of J S in null(G)", "each squeezes in its own way", per, internal @ of_hand,
              n_z, size),
    )  # fmt: skip
    return ByName("singularity", {each.name: each for each in found})


def _part(
    name: str, formula: str, meaning: str, unit: str, matrix: Array, n_z: int, size: float
) -> SingularityDistance:
    full = min(len(matrix), n_z)
    decision = Decision.of(singular_values(matrix), size)
    return SingularityDistance(name, formula, meaning, unit, SINGULAR_VALUE, full, size, decision)
