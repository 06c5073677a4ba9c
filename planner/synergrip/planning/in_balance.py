"""A plan counts where springs that no motor holds are in balance when it begins, and not where they push the object.

Forces of a plan begin at none, where nothing presses. Springs that the posture bends away from their balance press from
the start: what the plan says of margins and of the object's place is then not what the hand does.
"""

from __future__ import annotations

import numpy as np

from synergrip.documents.quantities import in_mm, plain
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array
from synergrip.planning.outcome import Check, Outcome, Plan, Unknown
from synergrip.statics.unbalanced_springs import Unbalanced, unbalanced_springs

MOVES = 1e-4
"""How far springs may push the object [m]."""
PRESSES = 0.01
"""How much they may add to contact forces, of the largest one."""
BALANCE = "balance of the springs at the start"
"""Name of the check."""


def spring_checks(grasp: Grasp, forces: Array) -> tuple[Check, ...]:
    """Return whether springs that no motor holds are in balance at the start, as shares of what they may do.

    Args:
        grasp: at the start.
        forces: (T, n_l) contact forces of the plan.
    """
    found = unbalanced_springs(grasp)
    return () if found is None else (_check(found, forces),)


def in_balance(outcome: Outcome) -> Outcome:
    """Return the answer; of a plan that begins with springs out of balance, that it is not known what the hand does."""
    found = unbalanced_springs(outcome.grasp) if isinstance(outcome, Plan) else None
    if found is None or not isinstance(outcome, Plan) or _check(found, outcome.motion.forces).passed:
        return outcome
    why = f"{out_of_balance(found, outcome.grasp)}. What is found keeps all limits without them"
    return Unknown(
        outcome.task, outcome.analysis, why, outcome.decisions, "execution", executed=outcome.executed,
        motion=outcome.motion, usages=outcome.usages, passes=outcome.passes, notes=outcome.notes,
    )  # fmt: skip


def out_of_balance(found: Unbalanced, grasp: Grasp) -> str:
    """Return that springs of a grasp are out of balance, and what they would do to it."""
    return (
        "springs of the model file that no motor holds are not in balance where the grasp begins, and no plan counts "
        f"them: they would push the object by about {in_mm(found.moved)} and change normal forces by up to "
        f"{plain(found.pressed(grasp))} N"
    )


def _check(found: Unbalanced, forces: Array) -> Check:
    """Return what springs do to the object, and add to the largest of forces (T, n_l), as a share of what they may."""
    largest = float(np.abs(forces).max(initial=0.0))
    pressed = float(np.abs(found.forces).max()) / (PRESSES * largest) if largest else 0.0
    return Check(BALANCE, max(found.moved / MOVES, pressed), 1.0)
