"""What references do: squeeze and leave the object at rest, squeeze and move it, move it without force, or nothing.

Every reference is a sum of the four, and their dimensions add up to n_z: the force map is 0 on the last two (they are
Gamma_zcs and Gamma_zr), the motion map on the first and the last. Which squeezes are pure depends on the compliances.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from synergrip.linalg import RANK_TOLERANCE, Array, Decision, canonical, frozen, split
from synergrip.statics.analysis import Analysis
from synergrip.values import ByName, Value

TASKS = (
    "Gabiccini, Farnioli and Bicchi, Grasp analysis tools for synergistic underactuated robotic hands, IJRR 32, 2013"
)


@dataclass(frozen=True, eq=False, repr=False)
class ReferenceEffect(Value):
    """References of one kind, and what they do with the load as it is; one column for each."""

    name: str
    """"pure squeeze", "spurious squeeze", "motion without force" or "redundant motion"."""
    formula: str
    meaning: str
    unit: str
    """What a column is of: of a squeeze 1 N of force, of a motion 1 m, both in scaled coordinates."""
    source: str
    references: Array
    """(n_z, dimension) of the synergies; of a squeeze those without a part along Gamma_zr and without rigid motion."""
    forces: Array
    """(n_l, dimension) change of the contact forces [N, N m]; of squeezes orthonormal with moments over the length."""
    motions: Array
    """(6, dimension) motion of the object about B [m, rad]."""
    decision: Decision
    """The rank decision behind the dimension."""

    @property
    def dimension(self) -> int:
        """How many independent ones there are."""
        return int(self.references.shape[1])


def reference_effects(analysis: Analysis) -> Mapping[str, ReferenceEffect]:
    """Return the four kinds of references by name."""
    spaces = analysis.spaces
    pure, spurious, decision = _squeezes(analysis)
    still, n_l = np.zeros((6, spaces.Gamma_zr.shape[1])), analysis.grasp.n_l
    moved = spaces.decisions["rigid"], spaces.decisions["redundancy"]
    found = (
        _squeeze(analysis, "pure squeeze", "F null(U)", "forces change, the object stays", pure, decision),
        _squeeze(analysis, "spurious squeeze", "rest of E_s", "forces change, and the object moves with them", spurious,
                 decision),
        ReferenceEffect("motion without force", "Gamma_zcs, Gamma_ucs", "the object moves, forces stay", "1 m", TASKS,
                        spaces.Gamma_zcs, frozen(np.zeros((n_l, spaces.Gamma_ucs.shape[1]))), spaces.Gamma_ucs,
                        moved[0]),
        ReferenceEffect("redundant motion", "Gamma_zr", "neither forces nor object change", "1 synergy unit", TASKS,
                        spaces.Gamma_zr, frozen(np.zeros((n_l, still.shape[1]))), frozen(still), moved[1]),
    )  # fmt: skip
    return ByName("effects", {each.name: each for each in found})


def _squeezes(analysis: Analysis) -> tuple[Array, Array, Decision]:
    """Return the coordinates alpha (dim E_s, k) of pure and of spurious squeezes, and the decision between them.

    The motion of the object counts beside that of the contacts: a squeeze is pure where the first is 0 as far as the
    second, and what is known of the map, can tell.
    """
    response, count = analysis.response, analysis.spaces.dimensions[0]
    references = analysis.coordinates.inverse[:, :count]
    moved = response.scale.motion @ response.du_dzr @ references  # scaled motion per newton
    by_hand = response.scale.scaled_rows(analysis.grasp.J @ analysis.grasp.S) @ references
    size = float(np.linalg.norm(by_hand, 2)) if count else 0.0
    found = split(moved, size)
    noise = response.accuracy["du_dzr"].unknown * np.sqrt(6 * len(references)) * float(np.linalg.norm(references))
    doubtful = bool(noise > RANK_TOLERANCE * size)
    decision = Decision(found.decision.rank, found.decision.singular_values, found.decision.ambiguous or doubtful)
    return np.asarray(canonical(found.null_space)), np.asarray(canonical(found.row_space)), decision


def _squeeze(
    analysis: Analysis, name: str, formula: str, meaning: str, alpha: Array, decision: Decision
) -> ReferenceEffect:
    """Return squeezes with coordinates alpha (dim E_s, k), without rigid motion and reconfiguration."""
    count = analysis.spaces.dimensions[0]
    references = analysis.coordinates.inverse[:, :count] @ alpha
    motions = analysis.response.du_dzr @ references
    if name == "pure squeeze":
        motions = np.zeros_like(motions)  # but for rounding
    return ReferenceEffect(name, formula, meaning, "1 N", TASKS, frozen(references),
                           frozen(analysis.spaces.E_s @ alpha), frozen(motions), decision)  # fmt: skip
