"""Small motions put into words: a screw axis, a translation, the contacts that an axis runs through."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from synergrip.grasps.contact import Contact
from synergrip.linalg import Array


def describe_twist(twist: Array, contacts: Sequence[Contact], length: float) -> str:
    """Return words for a twist (6,) about B, for example ``rotation about the line through C1 and C2``.

    Args:
        twist: v [m] and omega [rad]; its size does not matter.
        contacts: contacts whose points the rotation axis may run through.
        length: characteristic length [m], used to tell a translation from a far rotation.
    """
    v, omega = np.asarray(twist[:3]), np.asarray(twist[3:])
    if length * np.linalg.norm(omega) < 1e-6 * np.linalg.norm(v):
        return f"translation along {_direction(v)}"
    axis = omega / np.linalg.norm(omega)
    point = np.cross(omega, v) / (omega @ omega)
    pitch = float(omega @ v / (omega @ omega))
    on_axis = [c.name for c in contacts if np.linalg.norm(np.cross(c.point - point, axis)) < 1e-6 * length]
    if len(on_axis) >= 2:
        line = f"the line through {' and '.join(on_axis)}"
    else:
        through = on_axis[0] if on_axis else "(" + ", ".join(f"{1e3 * x + 0.0:.4g}" for x in point) + ") mm from B"
        line = f"the axis {_direction(axis)} through {through}"
    turn = f"rotation about {line}"
    return turn if abs(pitch) < 1e-6 * length else f"{turn}, advancing {1e3 * pitch:.3g} mm per radian"


def _direction(vector: Array) -> str:
    unit = vector / np.linalg.norm(vector)
    for name, axis in (("x", 0), ("y", 1), ("z", 2)):
        if abs(abs(unit[axis]) - 1) < 1e-9:
            return name
    return "(" + ", ".join(f"{x + 0.0:.3f}" for x in np.round(unit, 3)) + ")"
