"""Which contacts push away from the middle of all contacts: fingers that spread, or normals the wrong way round."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from synergrip.grasps.contacts.contact import Contact
from synergrip.linalg import Array

CLEARLY = 0.1
"""Cosine of the angle from which on a direction is told from one across."""


def away(contacts: Sequence[Contact]) -> Array:
    """Return whether each contact (n_c,) pushes away from the middle of all of them."""
    points = np.array([contact.point for contact in contacts])
    normals = np.array([contact.frame[:, 0] for contact in contacts])
    inward = points.mean(axis=0) - points
    return np.asarray(np.sum(inward * normals, axis=1) < -CLEARLY * np.linalg.norm(inward, axis=1))


def facing_notes(contacts: Sequence[Contact]) -> Iterator[str]:
    """Yield a note when a user states all normals and all contacts push away from their middle.

    Friction and squeeze are the same with all normals reversed, so that such a grasp is planned as if fingers pulled,
    and nothing else would tell.
    """
    told = all(contact.normal_at and contact.n_rows >= 3 for contact in contacts)  # the place of others is a line
    if len(contacts) > 1 and told and np.all(away(contacts)):
        yield (
            "the normals of all contacts point away from the middle of the contacts; right for fingers that spread "
            "inside an object, but a grasp from outside has normals toward it, and would here be planned to pull"
        )
