"""What is seen of a hand in three dimensions, frame by frame: links, pads, object, contacts and their forces.

Numbers only: where they come from and how they are drawn is the business of others.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.grasps.shapes.shape import Shape
from synergrip.linalg import Array
from synergrip.reports.pictures.bones import SHORTEST
from synergrip.values import Value

THICK, THICKEST = 0.12, 0.05
"""Radius of bones where no pad has one, as a share of their median length, and at most of the whole hand."""
SLIM = 0.7
"""Radius of bones as a share of the median radius of the pads."""
HELD = 0.2
"""How large what is held is taken to be where nothing is, as a share of the hand."""


@dataclass(frozen=True, eq=False, repr=False)
class Frame(Value):
    """One instant of a scene; SI units, palm frame."""

    caption: str
    bones: Array  # (n, 2, 3)
    links: Array  # (l, 3) origins of the links
    turned: Array  # (l, 3, 3) their axes, in columns
    pads: Array  # (p, 3) middles
    pushing: Array  # (p, 3) unit vectors in which the pads push, 0 where none is known
    position: Array  # (3,) of the object
    rotation: Array  # (3, 3) of its shape
    tips: Array  # (m, 3) the pads' points, from which contacts are looked for
    places: Array  # (m, 3) of the contacts
    normals: Array  # (m, 3) into the object
    forces: Array  # (m, 3) on the object [N]
    labels: tuple[str, ...]
    """What stands beside each contact."""
    up: Array  # (3,) against gravity


@dataclass(frozen=True, eq=False, repr=False)
class Scene(Value):
    """F frames of m contacts; SI units, axes of the palm, which stands still here: what else would turn is gravity."""

    times: Array  # (F,) [s]
    left_out: int
    """How many knots are not shown."""
    bones: Array  # (F, n, 2, 3) from a joint to the next, or to a pad [m]
    thickness: float  # [m] radius of bones
    link_names: tuple[str, ...]
    links: Array  # (F, l, 3) origins [m]
    turned: Array  # (F, l, 3, 3)
    pad_names: tuple[str, ...]
    pads: Array  # (F, p, 3) their middles [m]
    pushing: Array  # (F, p, 3) where each pad pushes; 0 where nobody knows
    radii: Array  # (p,) of the pads, 0 for points [m]
    shape: Shape | None
    position: Array  # (F, 3) of the object [m]
    rotation: Array  # (F, 3, 3) of its shape
    contacts: tuple[str, ...]
    places: Array  # (F, m, 3) where the contacts are [m]
    normals: Array  # (F, m, 3) into the object
    forces: Array  # (F, m, 3) on the object [N]
    margins: Array | None  # (F, m) [N]; None where no force is known
    friction: Array  # (m,) 0 where there is none
    up: Array  # (F, 3) against gravity, or the palm's z where none is known
    gravity: bool = True
    """Whether it is known."""

    @property
    def size(self) -> float:
        """[m] How large what is held is: half the side of the box around contacts and object."""
        points = self.places[0] if self.shape is None else np.vstack([self.places[0], self._corners])
        if len(points) < 2:
            return HELD * self.hand_size or 0.05
        return float(np.ptp(points, axis=0).max() / 2) or 0.05

    @property
    def hand_size(self) -> float:
        """[m] The longest side of the box around links and pads; 0 where all of them are at one place."""
        return float(np.ptp(np.vstack([self.links[0], self.pads[0]]), axis=0).max())

    @property
    def middle(self) -> Array:
        """(3,) what is looked at: the object at the start, or the hand where nothing is held."""
        return np.asarray(self.position[0])

    def frame(self, k: int) -> Frame:
        """Return one of its instants."""
        sizes = np.linalg.norm(self.forces[k], axis=1)
        labels = (f"{name} {size:.3g} N" if size > 0 else name for name, size in zip(self.contacts, sizes, strict=True))
        least = "the posture of the start"
        if self.margins is not None:
            i = int(np.argmin(self.margins[k]))
            least = f"least margin {self.margins[k, i]:.3g} N at {self.contacts[i]}"
        return Frame(
            caption=f"t = {self.times[k]:.2f} s, {least}", bones=self.bones[k], links=self.links[k],
            turned=self.turned[k], pads=self.pads[k], pushing=self.pushing[k], position=self.position[k],
            rotation=self.rotation[k], tips=self.places[k], places=self.places[k], normals=self.normals[k],
            forces=self.forces[k], labels=tuple(labels), up=self.up[k],
        )  # fmt: skip

    @property
    def _corners(self) -> Array:
        """(6, 3) the farthest points of the object along the axes of the palm, at the start."""
        assert self.shape is not None
        turned, axes = self.rotation[0], np.vstack([np.eye(3), -np.eye(3)])
        farthest = [turned @ self.shape.farthest(turned.T @ axis) for axis in axes]
        return np.asarray(self.position[0] + np.array(farthest))


def thickness_of(bones: Array, radii: Array) -> float:
    """Return the radius of bones (n, 2, 3) beside pads of some radii (p,) [m]."""
    if np.any(radii > 0):
        return SLIM * float(np.median(radii[radii > 0]))
    lengths = np.linalg.norm(bones[:, 1] - bones[:, 0], axis=1)
    lengths = lengths[lengths > SHORTEST]
    if not len(lengths):
        return 0.005
    return min(THICK * float(np.median(lengths)), THICKEST * float(np.ptp(bones.reshape(-1, 3), axis=0).max()))
