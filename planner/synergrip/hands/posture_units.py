"""Postures whose angles were read in another unit than they are in: degrees as radians, or the reverse."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from synergrip.hands.hand import Joint
from synergrip.linalg import Array

IN_DEGREES = 180 / math.pi
SMALL = math.radians(3.2)
"""[rad] Angles that all are within this of 0 are more likely radians read as degrees, which half a turn bounds."""
HALF_TURN = math.pi
"""[rad] Beyond it hardly any joint goes."""
TURN = 2 * math.pi


def posture_doubt(joints: Sequence[Joint], q: Array) -> str:
    """Return why the angles of a posture can hardly be in the unit that they were read in; empty when they can.

    Args:
        joints: those of the hand.
        q: (n_q,) the posture [rad or m].
    """
    angles = [(joint, float(value)) for joint, value in zip(joints, q, strict=True) if joint.kind == "hinge"]
    bent = [(joint, value) for joint, value in angles if value]
    if not bent:
        return ""
    far, most = max(bent, key=lambda each: abs(each[1]))
    if abs(most) > TURN:
        return (
            f"joint '{far.name}' is at {most:.4g} rad, more than a turn ({most * IN_DEGREES:.4g} deg); if {most:.4g} "
            "is meant in degrees, give them as degrees"
        )
    if abs(most) <= SMALL and all(_inside(joint, value * IN_DEGREES) for joint, value in bent):
        return (
            f"all joints that turn are within {abs(most) * IN_DEGREES:.4g} deg of 0 ('{far.name}' the farthest), which "
            f"hardly bends a hand; if {abs(most) * IN_DEGREES:.4g} is meant in radians, give it as radians"
        )
    return ""


def unit_hint(joint: Joint, value: float) -> str:
    """Return what to add where a joint is outside its range at a value [rad] that would be inside in degrees."""
    if joint.kind != "hinge" or abs(value) <= HALF_TURN or not _inside(joint, value / IN_DEGREES):
        return ""
    return f"; {value:.4g} deg would be inside: {value:.4g} was read in radians"


def _inside(joint: Joint, value: float) -> bool:
    return bool(joint.lower <= value <= joint.upper) and bool(np.isfinite(value))
