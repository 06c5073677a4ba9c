"""The springs of pads as a plan has them: in the frame of the contact, which turns and rolls, preload and all.

Springs of the engine stand in the axes of the link. Two things differ where a link turns against the contact: the
preload, and a stiffness that is not the same in all directions. So what the plan's law makes of where the pads are,

    lambda = lambda_0 + C_s^-1 stretch        along n, t, o of the contact as it is now, and about n,

is worked out at each step, and what the springs in the model lack of it is applied to the joints of the pads. A spring
whose frame turns with the contact has a line of action, too: in a plan the force acts at the point where the link would
have its pad, had it not given way; by what that turns link and object in opposite ways, they are turned here.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from synergrip.equilibrium.rolling import carried_along
from synergrip.linalg import Array
from synergrip.simulation.model import Model, PadModel
from synergrip.vectors import crossed, times

FLIPPED = -0.5
"""Cosine of the angle by which a normal turns within a step below which no frame is carried along with it."""


class PadSprings:
    """The springs of the n pads of a model while it is played."""

    def __init__(self, model: Model) -> None:
        mujoco, pads = model.mujoco, model.pads
        self.body = model.body
        self.frames = np.array([pad.frame_o for pad in pads])
        """(n, 3, 3) of the contacts, columns n, t, o, axes of the object."""
        self._radius = np.array([pad.radius for pad in pads])[:, None]
        self._links = mujoco.body_parentid[mujoco.geom_bodyid[[pad.geom for pad in pads]]]
        self._number = np.full(mujoco.ngeom, -1)
        self._number[[pad.geom for pad in pads]] = np.arange(len(pads))
        self._hinges, self._turned = np.zeros(len(pads)), np.zeros(len(pads))
        self._rolled = np.zeros((len(pads), 3))
        places = [_places(pad) for pad in pads]
        dofs = np.concatenate([pad.dofs for pad in pads])
        self._at = tuple(np.array([(i, j) for i, own in enumerate(places) for j in own]).T)
        self._dofs, self._joints = dofs, mujoco.dof_jntid[dofs]
        self._coordinates = mujoco.jnt_qposadr[self._joints]
        self._own = np.concatenate([pad.stiffness for pad in pads])
        self._rest = mujoco.qpos_spring[self._coordinates].copy()
        self._preload = np.zeros((len(pads), 4))
        self._stiffness = np.zeros((len(pads), 4, 4))
        for i, pad in enumerate(pads):
            rows, C = pad.pad.contact.n_rows, pad.pad.compliance
            linear = min(rows, 3)
            self._preload[i, :rows] = pad.preload
            self._stiffness[i, :linear, :linear] = np.linalg.inv(C[:linear, :linear])
            if 3 in places[i]:
                self._stiffness[i, 3, 3] = 1 / C[3, 3]

    def follow(self, data: Any) -> None:
        """Carry the frames along to where a `mujoco.MjData` has the contacts now."""
        contacts = data.contact
        if not len(contacts.geom):
            return
        number = self._number[contacts.geom].max(axis=1)
        sign = np.where(self._number[contacts.geom[:, 0]] >= 0, 1.0, -1.0)[:, None]
        normals = (sign * contacts.frame[:, :3]) @ data.xmat[self.body].reshape(3, 3)
        before = self.frames[number]
        turned = carried_along(before[..., 0], normals) @ before
        kept = (before[..., 0] * normals).sum(axis=1) < FLIPPED
        self.frames[number] = np.where(kept[:, None, None], before, turned)

    def apply(self, data: Any) -> None:
        """Set the forces of the pads' joints, and add to the torques on links and object."""
        object_turned = data.xmat[self.body].reshape(3, 3)
        frames = object_turned @ self.frames
        normals = frames[..., 0]
        arms = self._radius * normals  # from the pads' centres
        axes, moved = np.zeros((len(frames), 4, 3)), np.zeros((len(frames), 4))
        axes[self._at], moved[self._at] = data.xaxis[self._joints], data.qpos[self._coordinates]
        given = (moved[:, None, :3] @ axes[:, :3])[:, 0]  # how the pads have given way, palm axes
        turns = (moved[:, 3] - self._hinges)[:, None] * axes[:, 3]
        self._hinges = moved[:, 3]
        self._turned += (turns * normals).sum(axis=1)
        self._rolled -= crossed(turns, arms) @ object_turned
        given -= self._rolled @ object_turned.T
        stretch = -np.column_stack([times(frames.mT, given), self._turned])
        pushed = self._preload + times(self._stiffness, stretch)
        forces = times(frames, pushed[:, :3])
        moments = pushed[:, 3:] * normals + crossed(arms, forces)
        wanted = np.column_stack([times(axes[:, :3], forces), (axes[:, 3] * moments).sum(axis=1)])
        data.qfrc_applied[self._dofs] = wanted[self._at] - self._own * (self._rest - moved[self._at])
        couples = -crossed(given, forces)
        data.xfrc_applied[self._links, 3:] = 0.0
        np.subtract.at(data.xfrc_applied[:, 3:], self._links, couples)
        data.xfrc_applied[self.body, 3:] += couples.sum(axis=0)




def _places(pad: PadModel) -> list[int]:
    """Return the place of each joint of a pad among three slides and a hinge."""
    slides = min(pad.pad.contact.n_rows, 3)
    return [*range(slides), *[3] * (len(pad.dofs) - slides)]
