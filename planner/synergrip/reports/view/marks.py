"""Frames of links and pads in a viewer, with their names and where they are."""

from __future__ import annotations

from typing import Any

import numpy as np

from synergrip.grasps.contacts.contact import contact_frames
from synergrip.linalg import Array
from synergrip.reports.view.scene import Frame, Scene
from synergrip.vectors import quaternions

AXES, SHARE, SEEN = 3.5, 0.12, 2.0
"""Length of the axes of links: in radii of the bones, but no larger share of a hand that is small beside its bones, if
that leaves them so many radii to be seen; those of pads are half as long."""


class Marks:
    """Axes and labels at links and pads: red x, green y, blue z; red at a pad is where it pushes."""

    def __init__(self, nodes: Any, scene: Scene, *, names: bool) -> None:
        """Draw those of a scene on nodes (`viser.SceneApi`); `names` of pads are seen from the start, or not."""
        self.scene, self.named, long = scene, names, axes_length(scene)
        self.links = _axes(nodes, "/palm/link_frames", len(scene.link_names), long)
        self.pads = _axes(nodes, "/palm/pad_frames", len(scene.pad_names), long / 2)
        self.names = [nodes.add_label(f"/palm/link_names/{i}", name, font_screen_scale=0.8)
                      for i, name in enumerate(scene.link_names)]  # fmt: skip
        self.places = [nodes.add_label(f"/palm/pad_names/{i}", name, font_screen_scale=0.8)
                       for i, name in enumerate(scene.pad_names)]  # fmt: skip
        self.let(self.names, seen=False)
        self.let(self.places, seen=names)

    def show(self, frame: Frame) -> None:
        """Move all to where they are in a frame."""
        _put(self.links, frame.links, frame.turned)
        _put(self.pads, frame.pads, pad_axes(frame.pushing))
        for labels, places, names in ((self.names, frame.links, self.scene.link_names),
                                      (self.places, frame.pads, self.scene.pad_names)):  # fmt: skip
            for label, place, name in zip(labels, places, names, strict=True):
                label.text, label.position = f"{name} {millimetres(place)}", tuple(place)

    def let(self, what: Any, *, seen: bool) -> None:
        """Show or hide some of it."""
        for each in what if isinstance(what, list) else [what]:
            if each is not None:
                each.visible = seen


def axes_length(scene: Scene) -> float:
    """Return how long the axes of links are [m]."""
    thick, small = scene.thickness, SHARE * scene.hand_size
    return max(SEEN * thick, min(AXES * thick, small)) if small > 0 else AXES * thick


def pad_axes(pushing: Array) -> Array:
    """Return axes (p, 3, 3), in columns, whose x is where pads push (p, 3); those of the palm where nobody knows."""
    known = np.linalg.norm(pushing, axis=1) > 0.5
    frames = np.tile(np.eye(3), (len(pushing), 1, 1))
    if known.any():
        frames[known] = contact_frames(pushing[known])
    return frames


def millimetres(place: Array) -> str:
    """Return a place (3,) [m] in millimetres."""
    return f"({', '.join(f'{round(1e3 * float(value), 1) + 0.0:.1f}' for value in place)})"


def _axes(nodes: Any, name: str, count: int, long: float) -> Any:
    if not count:
        return None
    turns = np.tile(np.array([1.0, 0.0, 0.0, 0.0], dtype=np.float32), (count, 1))
    places = np.zeros((count, 3), dtype=np.float32)
    return nodes.add_batched_axes(name, turns, places, axes_length=long, axes_radius=long / 40)


def _put(node: Any, places: Array, turned: Array) -> None:
    if node is not None:
        node.batched_positions = places.astype(np.float32)
        node.batched_wxyzs = quaternions(turned).astype(np.float32)
