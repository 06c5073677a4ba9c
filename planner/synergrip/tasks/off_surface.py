"""Contacts that are off the surface that they are said to touch, and what that is worth."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from synergrip.documents.quantities import in_mm
from synergrip.errors import Issue
from synergrip.grasps.ball import WRITTEN
from synergrip.grasps.grasp import Grasp
from synergrip.statics.shifts import normal_stiffness
from synergrip.tasks.timed_task import TimedTask

ROUNDING = 1e-9  # [m]


def off_surface(timed: TimedTask, grasp: Grasp) -> Iterator[Issue]:
    """Yield one issue with all contacts that are farther off the object than is allowed for.

    The plan takes them to touch. To first order the force of one that is outside by g is smaller by g times its
    stiffness in the grasp.

    Args:
        timed: what is asked, with what it allows.
        grasp: of whom.
    """
    held, allowed = grasp.held, timed.allowed
    if held is None:
        return
    gaps = np.array([0.0 if gap is None else gap for gap in held.gaps])
    known = np.maximum(WRITTEN, np.zeros(grasp.n_c) if allowed is None else allowed.gaps) + ROUNDING
    off = np.flatnonzero(np.abs(gaps) > known).tolist()
    if not off:
        return
    force, names = normal_stiffness(grasp) * gaps, grasp.contact_names
    told = ", ".join(
        f"'{names[i]}' {in_mm(abs(gaps[i]))} {'outside' if gaps[i] > 0 else 'inside'} (about {abs(force[i]):.2g} N "
        f"{'less' if gaps[i] > 0 else 'more'} than planned)"
        for i in off
    )
    allow = ", ".join(f'"{names[i]}" = "{in_mm(np.ceil(1e6 * abs(gaps[i])) / 1e6)}"' for i in off)
    message = (
        f"taken to touch the {held.body.title}, though off its surface: {told}; allow.contact_gap = "
        f"{{ {allow} }} asks for a plan that bears that; or change posture or position"
    )
    yield Issue(message, key=held.touches[off[0]].key or "contacts")
