"""Small motions put into words: a screw axis, a translation, the contacts that an axis runs through."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from synergrip.documents.quantities import in_mm
from synergrip.grasps.contacts.contact import Contact
from synergrip.linalg import Array

MINOR = 0.4
"""Share of a motion that a shift or a turn in it has at least to be told of."""
NEAR = 0.99
"""Cosine of the angle up to which a direction is that of an axis: 8 deg."""


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
        through = on_axis[0] if on_axis else f"({_numbers(1e3 * point, 1e3 * length)}) mm from B"
        line = f"the axis {_direction(axis)} through {through}"
    turn = f"rotation about {line}"
    return turn if abs(pitch) < 1e-6 * length else f"{turn}, advancing {in_mm(pitch)} per radian"


def describe_kind(twist: Array, length: float) -> str:
    """Return what kind of motion a twist (6,) about B is, to about a tenth: ``a shift along z of the palm``.

    Args:
        twist: v [m] and omega [rad], axes of the palm; its size does not matter.
        length: characteristic length [m], by which a turn is a length.
    """
    shift, turn = np.asarray(twist[:3]), length * np.asarray(twist[3:])
    size = float(np.hypot(np.linalg.norm(shift), np.linalg.norm(turn)))
    parts = (("a shift along", shift), ("a turn about", turn))
    told = [f"{what} {_about(part)}" for what, part in parts if np.linalg.norm(part) > MINOR * size]
    axes = "of the palm" if told[-1][-1] in "xyz" else "in axes of the palm"
    return f"{' with '.join(told)} {axes}"


def describe_displacement(twist: Array, length: float) -> str:
    """Return a small displacement (6,) in parts: ``(0, 0, 10) mm and (5, 0, 0) deg``; zero parts are left out."""
    v, omega = 1e3 * np.asarray(twist[:3]), np.degrees(twist[3:])
    size = max(float(np.linalg.norm(twist[:3])), length * float(np.linalg.norm(twist[3:])))
    parts = []
    if np.linalg.norm(twist[:3]) > 1e-6 * size:
        parts.append(f"({_numbers(v, 1e3 * size)}) mm")
    if length * np.linalg.norm(twist[3:]) > 1e-6 * size:
        parts.append(f"({_numbers(omega, float(np.degrees(size / length)))}) deg")
    return " and ".join(parts) or "nothing"


def _numbers(values: Array, size: float) -> str:
    """Return the numbers to four digits of `size`, so that rounding noise reads as 0."""
    return ", ".join(f"{round(x / size, 6) * size + 0.0:.4g}" for x in values)


def _about(vector: Array) -> str:
    """Return about which way a vector points: an axis that it is near to, or its components, of either sign."""
    unit = vector / np.linalg.norm(vector)
    largest = int(np.argmax(np.abs(unit)))
    if abs(unit[largest]) > NEAR:
        return "xyz"[largest]
    return "({})".format(", ".join(f"{round(x, 2) + 0.0:g}" for x in unit * np.sign(unit[largest])))


def _direction(vector: Array) -> str:
    unit = vector / np.linalg.norm(vector)
    for name, axis in (("x", 0), ("y", 1), ("z", 2)):
        if abs(abs(unit[axis]) - 1) < 1e-9:
            return name
    return f"({_numbers(unit, 1.0)})"
