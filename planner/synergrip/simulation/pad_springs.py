"""The springs of pads as a plan has them: in the frame of the contact, which turns and rolls, preload and all.

Springs of the engine stand in the axes of the link. Two things differ where a link turns against the contact: the
preload, and a stiffness that is not the same in all directions. So what the plan's law makes of where the pads are,

    lambda = lambda_0 + C_s^-1 stretch        along n, t, o of the contact as it is now, and about n,

is worked out, and what the springs in the model lack of it is applied to the joints of the pads: at each step, with
the axes of links and contacts of some steps ago. A spring whose frame turns with the contact has a line of action, too:
in a plan the force acts at the point where the link would have its pad, had it not given way; by what that turns link
and object in opposite ways, they are turned here.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from synergrip.equilibrium.rolling import carried_along
from synergrip.linalg import Array
from synergrip.simulation.model import Model, PadModel
from synergrip.vectors import crossed, times

FLIPPED = -0.5
"""Cosine of the angle by which a normal turns between two looks below which no frame is carried along with it."""


class PadSprings:
    """The springs of the n pads of a model while it is played."""

    def __init__(self, model: Model) -> None:
        """All are as they are at the start."""
        mujoco, pads = model.mujoco, model.pads
        self.frames = np.array([pad.frame_o for pad in pads])
        """(n, 3, 3) of the contacts, columns n, t, o, axes of the object."""
        geoms = np.array([pad.geom for pad in pads])
        self._body, self._links = model.body, mujoco.body_parentid[mujoco.geom_bodyid[geoms]]
        self._number = np.full(mujoco.ngeom, -1)  # of the pad, by its geom
        self._number[geoms] = np.arange(len(pads))
        places = [_places(pad) for pad in pads]
        self._at = tuple(np.array([(i, j) for i, own in enumerate(places) for j in own]).T)
        self._dofs = np.concatenate([pad.dofs for pad in pads])
        self._joints = mujoco.dof_jntid[self._dofs]
        self._coordinates = mujoco.jnt_qposadr[self._joints]
        self._own, self._rest, self._moved = np.zeros((3, len(pads), 4))
        self._own[self._at] = np.concatenate([pad.stiffness for pad in pads])
        self._rest[self._at] = mujoco.qpos_spring[self._coordinates]
        self._radius = np.array([pad.radius for pad in pads])[:, None]
        laws = [_law(pad, 3 in own) for pad, own in zip(pads, places, strict=True)]
        self._preload, self._stiffness = (np.array(part) for part in zip(*laws, strict=True))
        self._hinges, self._spun, self._along = np.zeros((3, len(pads)))
        """Angles of the hinges, how far they turned the pads about the normals [rad], cosines between these."""
        self._rolled, self._rolls = np.zeros((2, len(pads), 3))
        """How far pads rolled as they turned about their hinges, which no tip of a plan does, and how far they roll for
        an angle; axes of the object."""
        self._base, self._less, self._couple = np.zeros((len(pads), 4)), np.zeros((len(pads), 4, 4)), np.zeros(3)

    def apply(self, data: Any) -> None:
        """Set the forces of the pads' joints, and add to the torque on the object."""
        self._moved[self._at] = data.qpos[self._coordinates]
        data.qfrc_applied[self._dofs] = (self._base - times(self._less, self._moved))[self._at]
        data.xfrc_applied[self._body, 3:] += self._couple

    def follow(self, data: Any) -> None:
        """Go on to where a `mujoco.MjData` has links and contacts now."""
        self._moved[self._at] = data.qpos[self._coordinates]
        turned = self._moved[:, 3] - self._hinges
        self._hinges = self._moved[:, 3].copy()
        self._spun += self._along * turned
        self._rolled += self._rolls * turned[:, None]
        palm = data.xmat[self._body].reshape(3, 3)  # axes of the object
        self._carry(data.contact, palm)
        axes, frames = np.zeros((len(self.frames), 4, 3)), palm @ self.frames
        axes[self._at] = data.xaxis[self._joints]
        normals, slides, hinges = frames[..., 0], axes[:, :3], axes[:, 3]
        rolls = crossed(hinges, self._radius * normals)
        self._along, self._rolls = (hinges * normals).sum(axis=1), rolls @ palm
        # what a force along n, t, o, and a moment about n, make of forces of slides and hinge
        driven = np.zeros((len(frames), 4, 4))
        driven[:, :3, :3], driven[:, 3, :3], driven[:, 3, 3] = slides @ frames, times(frames.mT, rolls), self._along
        rolled = self._rolled @ palm.T
        before = self._preload - times(self._stiffness, np.column_stack([times(frames.mT, rolled), self._spun]))
        whole = driven @ self._stiffness @ driven.mT
        self._base = times(driven, before) + whole[:, :, 3] * self._hinges[:, None] - self._own * self._rest
        self._less = whole - self._own[:, :, None] * np.eye(4)
        slid = np.column_stack([self._moved[:, :3], np.zeros(len(frames))])
        forces = times(frames, (before - times(self._stiffness @ driven.mT, slid))[:, :3])
        couples = -crossed(times(slides.mT, self._moved[:, :3]) + rolled, forces)
        data.xfrc_applied[self._links] = 0.0
        np.subtract.at(data.xfrc_applied[:, 3:], self._links, couples)
        self._couple = couples.sum(axis=0)

    def _carry(self, contacts: Any, palm: Array) -> None:
        """Carry the frames of what touches along to the normals of now."""
        if not len(contacts.geom):
            return
        number = self._number[contacts.geom].max(axis=1)
        sign = np.where(self._number[contacts.geom[:, 0]] >= 0, 1.0, -1.0)[:, None]
        normals = (sign * contacts.frame[:, :3]) @ palm
        follows = (self.frames[number, :, 0] * normals).sum(axis=1) > FLIPPED
        number, normals = number[follows], normals[follows]
        before = self.frames[number]
        self.frames[number] = carried_along(before[..., 0], normals) @ before


def _law(pad: PadModel, hinged: bool) -> tuple[Array, Array]:
    """Return preload (4,) and stiffness (4, 4) along n, t, o and about n; 0 where there is nothing."""
    preload, stiffness = np.zeros(4), np.zeros((4, 4))
    compliance, linear = pad.pad.compliance, slice(0, min(len(pad.preload), 3))
    preload[: len(pad.preload)] = pad.preload
    stiffness[linear, linear] = np.linalg.inv(compliance[linear, linear])
    if hinged:
        stiffness[3, 3] = 1 / compliance[3, 3]
    return preload, stiffness


def _places(pad: PadModel) -> list[int]:
    """Return the place of each joint of a pad among three slides and a hinge."""
    slides = min(len(pad.preload), 3)
    return [*range(slides), *[3] * (len(pad.dofs) - slides)]
