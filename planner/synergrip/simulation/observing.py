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
    of = {each.geom: number for number, each in enumerate(model.pads)}
    turned = data.xmat[model.body].reshape(3, 3)
    for contact in data.contact[: data.ncon]:
        first, second = (int(geom) for geom in contact.geom)
        number, sign = (of[first], 1.0) if first in of else (of[second], -1.0)
        if contact.efc_address >= 0:
            found[number] = _touch(model.pads[number], data, contact, sign, turned, frames[number])
    return found


def _touch(pad: PadModel, data: Any, contact: Any, sign: float, turned: Array, frame: Array) -> Touch:
    rows = slice(contact.efc_address, contact.efc_address + contact.dim)
    axes = sign * contact.frame.reshape(3, 3)  # normal toward the object, tangents
    forces, speeds = np.zeros(4), np.zeros(4)
    forces[: contact.dim], speeds[: contact.dim] = data.efc_force[rows], data.efc_vel[rows]
    force = forces[:3] @ axes
    sliding = -turned.T @ (speeds[1:3] @ axes[1:])
    every = np.array([*(force @ turned @ frame), forces[3]])
    return Touch(frozen(every[: pad.pad.contact.n_rows]), frozen(sliding), float(speeds[3]))
