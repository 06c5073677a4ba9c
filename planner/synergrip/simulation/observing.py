"""What is seen of the contacts: forces in their frames, margins, and how far they have slipped."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from synergrip.linalg import Array, frozen
from synergrip.simulation.model import Model, PadModel
from synergrip.values import Value


@dataclass(frozen=True, eq=False, repr=False)
class Touch(Value):
    """One contact at an instant."""

    force: Array  # (rows,) as the plan counts them
    sliding: Array  # (3,) velocity of the pad over the object, axes of the object [m/s]
    spinning: float  # [rad/s] about the normal


def touches(model: Model, data: Any, frames: Array) -> list[Touch | None]:
    """Return the contacts of a `mujoco.MjData` after a step; None for a pad that does not touch.

    Args:
        model: the model.
        data: of the engine.
        frames: (n, 3, 3) of the contacts, columns n, t, o, axes of the object.
    """
    found: list[Touch | None] = [None] * len(model.pads)
    contacts, of = data.contact, {each.geom: number for number, each in enumerate(model.pads)}
    turned = data.xmat[model.body].reshape(3, 3)
    # all at once: what the engine tells of a single contact is made anew each time it is asked for
    addresses, dims, pairs = contacts.efc_address.tolist(), contacts.dim.tolist(), contacts.geom.tolist()
    frames_of, forces, speeds = contacts.frame, data.efc_force, data.efc_vel
    for i, (address, dim, (first, second)) in enumerate(zip(addresses, dims, pairs, strict=True)):
        number, sign = (of[first], 1.0) if first in of else (of[second], -1.0)
        if address >= 0:
            rows, axes = slice(address, address + dim), sign * frames_of[i].reshape(3, 3)
            found[number] = _touch(model.pads[number], forces[rows], speeds[rows], axes, turned, frames[number])
    return found


def _touch(pad: PadModel, pushed: Array, moved: Array, axes: Array, turned: Array, frame: Array) -> Touch:
    """Return the contact of a pad by forces and speeds (dim,) along axes: normal toward the object, tangents."""
    forces, speeds = np.zeros(4), np.zeros(4)
    forces[: len(pushed)], speeds[: len(moved)] = pushed, moved
    force = forces[:3] @ axes
    sliding = -turned.T @ (speeds[1:3] @ axes[1:])
    every = np.array([*(force @ turned @ frame), forces[3]])
    return Touch(frozen(every[: pad.pad.contact.n_rows]), frozen(sliding), float(speeds[3]))
