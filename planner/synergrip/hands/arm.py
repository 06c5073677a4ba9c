"""Joints that carry the whole grasp: an arm, or a wrist."""

from __future__ import annotations

from collections.abc import Collection, Iterator

import numpy as np

from synergrip.hands.hand import Hand, SynergySet


def arm_notes(hand: Hand, synergies: SynergySet, touching: Collection[str]) -> Iterator[str]:
    """Yield a note when synergies move joints that carry all contacts, and other joints carry some of them.

    Args:
        hand: the hand.
        synergies: the chosen set.
        touching: the links that touch the object.
    """
    chains = [list(hand.carriers(link)) for link in touching]
    common = [link for link in chains[0] if all(link in chain for chain in chains)] if chains else []
    if not common:
        return
    below = {link for chain in chains for link in chain} - set(common)
    moving = {joint.link for joint in hand.joints}
    arm = [
        joint.name for joint, row in zip(hand.joints, synergies.S, strict=True) if joint.link in common and np.any(row)
    ]
    if arm and below & moving:
        names = ", ".join(f"'{name}'" for name in arm)
        yield (
            f"the synergies move {names}, which carr{'ies' if len(arm) == 1 else 'y'} all contacts: the arm moves the "
            f'object; when only the hand is to move it, write hand.palm = "{common[0]}"'
        )
