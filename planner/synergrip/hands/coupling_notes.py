"""Joints that a posture parts although they are rigidly coupled."""

from __future__ import annotations

from collections.abc import Iterator

from synergrip.documents.quantities import SHOWN_IN
from synergrip.hands.hand import Hand
from synergrip.hands.synergies.matrix import coupling_map, drivers
from synergrip.hands.units import SI_UNITS
from synergrip.linalg import Array

PARTED = 1e-6
"""Distance from what a coupling says that is no rounding [rad or m]."""


def parted_notes(hand: Hand, q: Array) -> Iterator[str]:
    """Yield a note for each rigid coupling that joint values `q` (n_q,) do not keep."""
    E, e = coupling_map(hand.joint_names, hand.couplings)
    for i, (joint, said) in enumerate(zip(hand.joints, E @ q + e, strict=True)):
        coupling = hand.couplings.get(joint.name)
        if coupling is not None and coupling.rigid and abs(q[i] - said) > PARTED:
            factor, unit = SHOWN_IN[SI_UNITS[joint.kind]]
            yield (
                f"joint '{joint.name}' is at {factor * q[i]:.4g} {unit}, its rigid coupling to {drivers(coupling)} "
                f"says {factor * said:.4g} {unit}: the hand cannot take this posture"
            )
