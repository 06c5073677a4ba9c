"""What each contact is stretched by, where its force acts and along which axes: fixed, rolling and sliding contacts.

A contact looks at B trial states at once (leading axis) and knows the state that was last settled. All vectors with
the suffix `_o` are in the axes of the object.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from scipy.spatial.transform import Rotation
from second.surfaces import Face, face_at

Array = np.ndarray

ROWS = {
    "frictionless": (0,), "hard": (0, 1, 2), "soft": (0, 1, 2, 3), "soft-elliptic": (0, 1, 2, 3),
    "patch": (0, 1, 2, 3, 4, 5),
}  # fmt: skip
"""Which of forces along n, t, o and moments about n, t, o a contact transmits."""
ROLLING_STEPS = 8
"""Parts of one step into which the rolling of a tip is divided, each a step of Runge and Kutta."""


@dataclass(frozen=True)
class Stretched:
    """One contact in B states."""

    stretch: Array  # (B, 6) along and about n, t, o: [m], [rad]
    point: Array  # (B, 3) where the hand pushes, palm frame
    frame: Array  # (B, 3, 3) columns n, t, o in the palm frame
    settled: Any = None
    """What the contact will have to remember of each state."""


class Touching(Protocol):
    """A contact between a link and the object."""

    def stretched(self, link: Array, p: Array, R: Array, settled: Any) -> Stretched:
        """Return the contact at poses of link (B, 4, 4) and object (B, 3), (B, 3, 3) after the settled state."""

    def start(self) -> Any:
        """Return what it remembers of the start."""

    def beyond(self, settled: Any) -> float:
        """Return how far beyond its face it is [m], <= 0 where it is on it."""


def rotation_vector(turned: Array) -> Array:
    """Return the rotation vectors (B, 3) of rotation matrices (B, 3, 3)."""
    return np.asarray(Rotation.from_matrix(turned).as_rotvec())


def _transposed(matrices: Array) -> Array:
    return np.swapaxes(matrices, -1, -2)


def _times(matrices: Array, vectors: Array) -> Array:
    return np.asarray((matrices @ vectors[..., None])[..., 0])


def _cross(a: Array, b: Array) -> Array:
    """Return a x b of (B, 3) each; NumPy's own takes longer than the rest of rolling."""
    (x, y, z), (u, v, w) = a.T, b.T
    return np.stack([y * w - z * v, z * u - x * w, x * v - y * u], axis=-1)


def _turn_between(before: Array, after: Array) -> Array:
    """Return the smallest rotations (B, 3, 3) that turn unit vectors into others."""
    axis = _cross(before, after)
    cosine = np.sum(before * after, axis=-1)
    cross = np.zeros((*axis.shape, 3))
    cross[..., 0, 1], cross[..., 0, 2], cross[..., 1, 2] = -axis[..., 2], axis[..., 1], -axis[..., 0]
    cross -= _transposed(cross)
    return np.asarray(np.eye(3) + cross + cross @ cross / (1 + cosine)[..., None, None])


@dataclass(frozen=True)
class Fixed:
    """A point of the link sticks to a point of the object; the frame goes with the object."""

    hand_point: Array  # (3,) in the frame of the link
    point_o: Array  # (3,)
    frame_o: Array  # (3, 3) columns n, t, o
    link_0: Array  # (3, 3) rotation of the link at the start

    def start(self) -> Any:
        return None

    def beyond(self, settled: Any) -> float:
        return -np.inf

    def stretched(self, link: Array, p: Array, R: Array, settled: Any) -> Stretched:
        point = _times(link[:, :3, :3], self.hand_point) + link[:, :3, 3]
        frame = R @ self.frame_o
        apart = _times(_transposed(frame), point - p - _times(R, self.point_o))
        turned = rotation_vector(_transposed(R) @ link[:, :3, :3] @ self.link_0.T) @ self.frame_o
        return Stretched(np.hstack([apart, turned]), point, frame)


@dataclass(frozen=True)
class Sliding:
    """A frictionless round (or pointed) pad: what counts is how far it is from the surface."""

    centre: Array  # (3,) of the pad, in the frame of the link
    face: Face
    height: float  # of the centre above the surface at the start

    def start(self) -> Any:
        return np.zeros((1, 3))

    def beyond(self, settled: Any) -> float:
        return float(self.face.beyond(settled)[0])

    def stretched(self, link: Array, p: Array, R: Array, settled: Any) -> Stretched:
        centre = _times(link[:, :3, :3], self.centre) + link[:, :3, 3]
        centre_o = _times(_transposed(R), centre - p)
        outward = _times(R, self.face.normal(centre_o))
        stretch = np.zeros((len(p), 6))
        stretch[:, 0] = self.height - self.face.distance(centre_o)
        frame = np.stack([-outward, np.zeros_like(outward), np.zeros_like(outward)], axis=-1)
        return Stretched(stretch, centre - self.height * outward, frame, centre_o)


@dataclass(frozen=True)
class Rolled:
    """What a rolling contact remembers (B, ...): the centre of its tip, its frame, how the link is turned, and how far
    it has turned about the axes of the frame, which went along."""

    centre_o: Array
    frame_o: Array
    turned_o: Array
    spun: Array


@dataclass(frozen=True)
class Rolling:
    """A rigid round tip rolls on the surface; the link holds it by springs that it is at rest in at the start."""

    centre: Array  # (3,) of the pad, in the frame of the link
    face: Face
    height: float
    centre_o: Array
    frame_o: Array
    link_0: Array

    def start(self) -> Any:
        return Rolled(self.centre_o[None], self.frame_o[None], self.link_0[None], np.zeros((1, 3)))

    def beyond(self, settled: Any) -> float:
        return float(self.face.beyond(settled.centre_o)[0])

    def stretched(self, link: Array, p: Array, R: Array, settled: Any) -> Stretched:
        turned_o = _transposed(R) @ link[:, :3, :3]
        theta = rotation_vector(turned_o @ _transposed(settled.turned_o))
        centre_o, carried, mean = self._roll(np.broadcast_to(settled.centre_o, p.shape), theta)
        frame_o = carried @ settled.frame_o
        centre = _times(link[:, :3, :3], self.centre) + link[:, :3, 3]
        frame = R @ frame_o
        apart = _times(_transposed(frame), centre - p - _times(R, centre_o))
        spun = settled.spun + _times(_transposed(mean @ settled.frame_o), theta)
        point = centre - self.height * _times(R, self.face.normal(centre_o))
        return Stretched(np.hstack([apart, spun]), point, frame, Rolled(centre_o, frame_o, turned_o, spun))

    def _roll(self, centre: Array, theta: Array) -> tuple[Array, Array, Array]:
        """Return where the tip is after it turned by theta (B, 3) at a constant rate, and what that did to the frame.

        At the end, and in the mean over the way.
        The point of the tip that touches is at rest, so that its centre moves with theta x (height normal).
        """

        def rate(at: Array) -> Array:
            return _cross(theta, self.height * self.face.normal(at))

        h, carried = 1 / ROLLING_STEPS, np.tile(np.eye(3), (len(theta), 1, 1))
        before, mean = self.face.normal(centre), np.zeros((len(theta), 3, 3))
        for _ in range(ROLLING_STEPS):
            k1 = rate(centre)
            k2 = rate(centre + h / 2 * k1)
            k3 = rate(centre + h / 2 * k2)
            k4 = rate(centre + h * k3)
            centre = centre + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
            normal = self.face.normal(centre)
            centre = centre + (self.height - self.face.distance(centre))[:, None] * normal
            was, carried = carried, _turn_between(before, normal) @ carried
            mean, before = mean + h * (was + carried) / 2, normal
        return centre, carried, mean


def touching(contact: dict[str, Any], document: dict[str, Any], link: Array, model: str) -> Touching:
    """Return a contact of plan.json at the pose (4, 4) of its link at the start; the model is "rolling" or "fixed".

    A patch transmits what keeps a tip from rolling, and is always fixed.
    """
    origin, shape = np.array(document["position_m"]), document["shape"]
    frame, point_o = np.array(contact["frame"]).T, np.array(contact["point_m"]) - origin
    centre = np.array(contact["pad_centre_m"])
    rotation, place = link[:3, :3], link[:3, 3]
    centre_o = rotation @ centre + place - origin
    radius, kind = contact["pad_radius_m"], contact["kind"]
    if shape is not None and (kind == "frictionless" or (model == "rolling" and radius > 0 and kind != "patch")):
        face = face_at(shape, centre_o)
        height = float(face.distance(centre_o[None])[0])
        if kind == "frictionless":
            return Sliding(centre, face, height)
        return Rolling(centre, face, height, centre_o, frame, rotation)
    return Fixed(rotation.T @ (point_o + origin - place), point_o, frame, rotation)
