"""What it does to a grasp that springs which no motor holds are bent away from their balance where it begins.

Contact forces of a plan begin where nothing presses; springs out of balance press there already. By the linear model of
the grasp, the way dq that the joints would go without contact shifts the springs of the contacts by J dq (`shifts`).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from synergrip.documents.quantities import SHOWN_IN, in_mm, plain
from synergrip.grasps.compliance import compliance_of
from synergrip.grasps.grasp import Grasp
from synergrip.hands.unbalanced import way_to_rest
from synergrip.hands.units import SI_UNITS, torque_unit
from synergrip.linalg import Array, frozen
from synergrip.statics.shifts import of_shifts

MOST_NAMED = 6
"""Joints that a note names."""
FINEST = 6
"""Digits after the point of forces [N] that are no rounding."""


@dataclass(frozen=True, eq=False)
class Unbalanced:
    """Springs that no motor holds, away from their balance."""

    way: Array
    """(n_q,) how far each joint would go without contact [rad or m]."""
    torques: Array
    """(n_q,) what would keep the joints from going [N m, of a slide N]."""
    push: Array
    """(6,) displacement of the object about the origin of the palm that they come to, by the linear model [m, rad]."""
    moved: float
    """How far it is pushed at its contacts [m]."""
    forces: Array
    """(n_l,) what is added to the contact forces."""

    def pressed(self, grasp: Grasp) -> float:
        """Return what is added to a normal force of the grasp at most [N], or taken from it."""
        return round(float(np.abs(self.forces[grasp.normal_rows]).max()), FINEST)


def unbalanced_springs(grasp: Grasp) -> Unbalanced | None:
    """Return the springs of a grasp that are out of balance; None where there are none."""
    held = grasp.held
    if held is None or held.hand.drives is None or held.hand.drives.stiffness is None:
        return None
    way = way_to_rest(held.hand, held.synergies, held.q, grasp.C_q)
    if not way.any():
        return None
    shift = (grasp.J @ way)[:, None]
    forces, push = (each[:, 0] for each in of_shifts(compliance_of(grasp), grasp.G, shift))
    spots = np.array([contact.point for contact in grasp.contacts])
    moved = float(np.linalg.norm(push[:3] + np.cross(push[3:], spots), axis=1).max())
    return Unbalanced(frozen(way), frozen(-held.hand.drives.stiffness @ way), frozen(push), moved, frozen(forces))


def unbalanced_notes(grasp: Grasp) -> Iterator[str]:
    """Yield a note on springs that pull where no motor holds them, with what that does to the grasp."""
    found = unbalanced_springs(grasp)
    if found is None or grasp.held is None:
        return
    told = list[str]()
    for joint, value, way, torque in zip(grasp.held.hand.joints, grasp.held.q, found.way, found.torques, strict=True):
        if way:
            factor, unit = SHOWN_IN[SI_UNITS[joint.kind]]
            told.append(
                f"'{joint.name}' is at {factor * value:.4g} {unit}, would go to {factor * (value + way):.4g} {unit} "
                f"without contact, and is kept from it by {torque:.3g} {torque_unit([joint.kind])}"
            )
    more = f"; and {len(told) - MOST_NAMED} more joints" if len(told) > MOST_NAMED else ""
    yield (
        "springs of the model file that no motor holds are out of balance where the grasp begins, and no plan counts "
        f"it: {'; '.join(told[:MOST_NAMED])}{more}. They would push the object by about {in_mm(found.moved)}, "
        f"({', '.join(in_mm(float(each)) for each in found.push[:3])}) along x, y, z of the palm, and change normal "
        f"forces by up to {plain(found.pressed(grasp))} N (linear). Place it where they settle, or give a "
        "posture in which they do"
    )
