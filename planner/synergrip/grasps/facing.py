"""Contact frames that are seldom meant: normals away from the middle of all contacts, and left-handed ones."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from synergrip.errors import shortened
from synergrip.grasps.contacts.contact import Contact
from synergrip.grasps.grasp import Grasp
from synergrip.linalg import Array

CLEARLY = 0.1
"""Cosine of the angle from which on a direction is told from one across."""


def away(contacts: Sequence[Contact]) -> Array:
    """Return whether each contact (n_c,) pushes away from the middle of all of them."""
    points = np.array([contact.point for contact in contacts])
    frames = np.array([contact.frame for contact in contacts])
    inward = points.mean(axis=0) - points
    return np.asarray(np.sum(inward * frames[:, :, 0], axis=1) < -CLEARLY * np.linalg.norm(inward, axis=1))


def facing_notes(grasp: Grasp) -> Iterator[str]:
    """Yield a note when a user states all normals and all contacts push away from their middle.

    Friction and squeeze are the same with all normals reversed, so that such a grasp is planned as if fingers pulled,
    and nothing else would tell.
    """
    contacts, without_hand = grasp.contacts, grasp.held is None
    told = all((contact.normal_at or without_hand) and contact.n_rows >= 3 for contact in contacts)
    if len(contacts) > 1 and told and np.all(away(contacts)):  # where only n is known, the place is a line
        yield (
            "the normals of all contacts point away from the middle of the contacts; right for fingers that spread "
            "inside an object, but a grasp from outside has normals toward it, and would here be planned to pull"
        )


def frame_notes(grasp: Grasp) -> Iterator[str]:
    """Yield what is odd about the contact frames that a user states: normals outward, or n, t, o left-handed.

    Neither is wrong by itself: G and J say the same of every frame, as long as both mean the same one.
    """
    outward = list(facing_notes(grasp))
    yield from outward
    turns = np.linalg.det(np.array([contact.frame for contact in grasp.contacts]))
    left = [shortened(contact.name) for contact, turn in zip(grasp.contacts, turns, strict=True) if turn < 0]
    if left and not outward:  # which reversed normals alone explain
        yield (
            f"the frame (n, t, o) of {', '.join(left)} is left-handed, o is -n x t: right when G, J and C_s all have "
            "it so; a wrong sign in one of them would look the same"
        )
