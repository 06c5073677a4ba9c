"""Directions across the normal that were chosen where the friction depends on them."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from synergrip.errors import shortened
from synergrip.grasps.contacts.elliptic_soft_finger import EllipticSoftFinger
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array

MOST_NAMED = 4
"""Contacts that a note names."""


def tangent_notes(grasp: Grasp) -> Iterator[str]:
    """Yield a note on contacts with two frictions of which nobody says which way the first one acts.

    The frame is then chosen by the axes of the palm: the same grasp, with its palm frame turned, has other friction.
    """
    held = grasp.held
    if held is None:
        return
    links = held.hand.kinematics.at(held.q, [(touch.pad.link, touch.pad.point) for touch in held.touches])
    told = [
        f"{shortened(contact.name)} [{_written(link.rotation.T @ contact.frame[:, 1])}] of link '{touch.pad.link}'"
        for contact, touch, link in zip(grasp.contacts, held.touches, links, strict=True)
        if isinstance(contact.kind, EllipticSoftFinger)
        and contact.kind.friction != contact.kind.cross_friction
        and touch.tangent is None
    ]
    if told:
        more = f", and {len(told) - MOST_NAMED} more" if len(told) > MOST_NAMED else ""
        yield (
            "friction acts along t and cross_friction along o, and no tangent says which way t is: it is chosen by the "
            f"axes of the palm, along {', '.join(told[:MOST_NAMED])}{more}. Another choice gives another answer; write "
            'tangent = "x", "y", "z" or 3 numbers in each [[contact]], axes of the link'
        )


def _written(direction: Array) -> str:
    return ", ".join(f"{each:.3g}" for each in np.round(direction, 3) + 0.0)  # no -0
