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
    palm, carriers = palm_of(hand, touching)
    rows = zip(hand.joint_names, synergies.S, strict=True)
    arm = [name for name, row in rows if name in carriers and np.any(row)]
    if arm:
        carry = "carries" if len(arm) == 1 else "carry"
        yield (
            f"the synergies move {', '.join(map(repr, arm))}, which {carry} all contacts: the arm moves the object; "
            f'when only the hand is to move it, write hand.palm = "{palm}" (an argument of load_hand in code)'
        )


def palm_of(hand: Hand, touching: Collection[str]) -> tuple[str, tuple[str, ...]]:
    """Return the nearest link that carries all of some links, and the joints that carry it.

    Both are empty when no joint moves these links against each other or against that link: they are one body then.
    """
    chains = [list(hand.carriers(link)) for link in touching]
    common = [link for link in chains[0] if all(link in chain for chain in chains)] if chains else []
    below = {link for chain in chains for link in chain} - set(common)
    if not any(joint.link in below for joint in hand.joints):
        return "", ()
    return common[0], tuple(joint.name for joint in hand.joints if joint.link in common)
