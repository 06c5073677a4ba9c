"""Forward kinematics of a tree of links at many joint values at once: all postures of a motion in one go."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from synergrip.hands.point_motion import PointMotions
from synergrip.linalg import Array, Places, crossed, skews
from synergrip.values import Value


@dataclass(frozen=True, eq=False, repr=False)
class Chains(Value):
    """B bodies, parents before their children, each held by one joint at most, in a frame that stands still."""

    parents: Places  # (B,) 0, the frame itself, is its own
    places: Array  # (B, 3) in the parent, with all joints at 0 [m]
    rotations: Array  # (B, 3, 3)
    moved: Places  # (n,) the body that each joint moves
    axes: Array  # (n, 3) in that body
    anchors: Array  # (n, 3) a point of the axis there [m]
    slides: Array  # (n,) 1 for a joint that slides, 0 for one that turns

    def motions(self, q: Array, bodies: Sequence[int], points: Array) -> PointMotions:
        """Return how points (m, 3) of bodies [m] move at joint values (T, n)."""
        rotations, places = self._poses(q)
        turned = rotations[:, bodies]
        found = places[:, bodies] + (turned @ points[:, :, None])[..., 0]
        axes = (rotations[:, self.moved] @ self.axes[:, :, None])[..., 0]
        anchors = places[:, self.moved] + (rotations[:, self.moved] @ self.anchors[:, :, None])[..., 0]
        carried = self._carries[bodies]  # (m, n)
        jacobian = np.empty((len(q), len(points), 2, 3, len(self.moved)))
        arms = found[:, :, None] - anchors[:, None]
        linear = (1 - self.slides[:, None]) * crossed(axes[:, None], arms) + (self.slides[:, None] * axes)[:, None]
        jacobian[:, :, 0] = (carried[..., None] * linear).mT
        jacobian[:, :, 1] = (carried * (1 - self.slides))[:, None] * axes.mT[:, None]
        return PointMotions(found, turned, jacobian)

    def _poses(self, q: Array) -> tuple[Array, Array]:
        """Return rotations (T, B, 3, 3) and places (T, B, 3) of the bodies."""
        local, shifted = self._steps(q)
        rotations, places = local.copy(), shifted.copy()
        for bodies in self._levels:
            above = rotations[:, self.parents[bodies]]
            rotations[:, bodies] = above @ local[:, bodies]
            places[:, bodies] = places[:, self.parents[bodies]] + (above @ shifted[:, bodies, :, None])[..., 0]
        return rotations, places

    def _steps(self, q: Array) -> tuple[Array, Array]:
        """Return rotations (T, B, 3, 3) and places (T, B, 3) of the bodies in their parents."""
        angles = q * (1 - self.slides)
        sines, versines = np.sin(angles)[..., None, None], 2 * np.sin(angles / 2)[..., None, None] ** 2
        skew, held = skews(self.axes), self.rotations[self.moved]
        local = np.broadcast_to(self.rotations, (len(q), *self.rotations.shape)).copy()
        local[:, self.moved] = held + sines * (held @ skew) + versines * (held @ skew @ skew)
        shifted = np.broadcast_to(self.places, (len(q), *self.places.shape)).copy()
        slid = (q * self.slides)[..., None] * (held @ self.axes[:, :, None])[..., 0]
        swung = ((held - local[:, self.moved]) @ self.anchors[:, :, None])[..., 0]  # the anchor stays where it is
        shifted[:, self.moved] += slid + swung
        return local, shifted

    @cached_property
    def _levels(self) -> tuple[Places, ...]:
        """The bodies by how many are between them and the frame, which is left out."""
        depth = np.zeros(len(self.parents), dtype=int)
        for body in range(1, len(self.parents)):
            depth[body] = depth[self.parents[body]] + 1
        return tuple(np.flatnonzero(depth == level) for level in range(1, depth.max() + 1))

    @cached_property
    def _carries(self) -> Array:
        """(B, n) 1 where a joint moves a body."""
        above = np.eye(len(self.parents))
        for body in range(1, len(self.parents)):
            above[body] += above[self.parents[body]]
        return above[:, self.moved]
