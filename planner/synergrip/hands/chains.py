"""Forward kinematics of a tree of links at many joint values at once: all postures of a motion in one go."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from synergrip.hands.point_motion import PointMotions
from synergrip.linalg import Array, Places
from synergrip.values import Value
from synergrip.vectors import skews


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
        moved = rotations[:, self.moved]
        axes = (moved @ self.axes[:, :, None])[..., 0].mT.copy()  # (T, 3, n)
        anchors = (places[:, self.moved] + (moved @ self.anchors[:, :, None])[..., 0]).mT
        carried = self._carries[bodies][:, None]  # (m, 1, n)
        jacobian = np.empty((len(q), len(points), 2, 3, len(self.moved)))
        linear, angular = jacobian[:, :, 0], jacobian[:, :, 1]
        np.multiply(axes[:, None], carried * (1 - self.slides), out=angular)
        arms = found[..., None] - anchors[:, None]
        for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
            linear[:, :, i] = angular[:, :, j] * arms[:, :, k] - angular[:, :, k] * arms[:, :, j]
        if self.slides.any():
            linear += axes[:, None] * (carried * self.slides)
        return PointMotions(found, turned, jacobian)

    def _poses(self, q: Array) -> tuple[Array, Array]:
        """Return rotations (T, B, 3, 3) and places (T, B, 3) of the bodies."""
        whole = self._steps(q)
        for bodies in self._levels:
            above = whole[self.parents[bodies]]
            there = above[..., :3] @ whole[bodies]
            there[..., 3] += above[..., 3]
            whole[bodies] = there
        whole = whole.swapaxes(0, 1)
        return whole[..., :3], whole[..., 3]

    def _steps(self, q: Array) -> Array:
        """Return rotations and places (B, T, 3, 4) of the bodies in their parents, beside each other."""
        angles = (q * (1 - self.slides)).T[..., None, None]
        sines, versines = np.sin(angles), 2 * np.sin(angles / 2) ** 2
        held, sideways, back = self._turning
        whole = np.empty((len(self.parents), len(q), 3, 4))
        whole[..., :3], whole[..., 3] = self.rotations[:, None], self.places[:, None]
        turned = sines * sideways[:, None] + versines * back[:, None]  # beyond what a body is turned at 0
        whole[self.moved, :, :, :3] += turned
        slid = (q * self.slides).T[..., None] * (held @ self.axes[:, :, None])[:, None, :, 0]
        swung = -(turned @ self.anchors[:, None, :, None])[..., 0]  # the anchor stays where it is
        whole[self.moved, :, :, 3] += slid + swung
        return whole

    @cached_property
    def _turning(self) -> tuple[Array, Array, Array]:
        """How bodies that joints move (n, 3, 3) are turned with them at 0, and with their sines and versines beyond."""
        held, skew = self.rotations[self.moved], skews(self.axes)
        return held, held @ skew, held @ skew @ skew

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
