"""A scene as nodes of a viewer, and the page that plays it without a network."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from synergrip.linalg import Array
from synergrip.reports.pictures.contact_colors import contact_colors
from synergrip.reports.view.labels import apart
from synergrip.reports.view.scene import Frame, Scene
from synergrip.reports.view.serving import serving
from synergrip.reports.view.solid import Solid, ball, cone, of_shape, ribs, rod
from synergrip.vectors import quaternions

HAND, OBJECT, WEIGHT = (182, 190, 201), (214, 196, 160), (90, 90, 90)
"""Colours of the hand, of what it holds, and of gravity."""
LONGEST = 0.9
"""Length of the longest force, of the size of the scene."""
CONE = 0.3
"""Height of the friction cones, of the size of the scene."""
CELL = 0.01
"""[m] The side of a square of the ground."""
FAR = 1.6
"""How far the camera is, in radii of what is seen."""
THREAD = 0.12
"""Radius of what joins a pad to where it would touch, in those of bones."""
SCALE = 0.35
"""How far to the left of the middle it is said how large squares of the ground are, in distances of the camera."""
STILL = 1.0
"""[s] How long a single frame is shown."""


def page(scene: Scene) -> str:
    """Return a page (HTML) that plays a scene and opens without a network."""
    with serving() as server:
        drawn = Drawn(server.scene, scene)
        drawn.look(server)
        recorder = server.get_scene_serializer()
        for k, wait in enumerate(np.diff(scene.times)):
            drawn.show(scene.frame(k))
            recorder.insert_sleep(float(wait))
        drawn.show(scene.frame(len(scene.times) - 1))
        recorder.insert_sleep(STILL if len(scene.times) == 1 else float(np.diff(scene.times)[-1]))
        return str(recorder.as_html())


class Drawn:
    """The nodes of a scene, which `show` moves to one of its frames."""

    def __init__(self, nodes: Any, scene: Scene) -> None:
        """Draw the first frame.

        Args:
            nodes: `viser.SceneApi`.
            scene: what is drawn.
        """
        self.scene, size = scene, scene.size
        largest = float(np.linalg.norm(scene.forces, axis=2).max(initial=0.0))
        self._force = LONGEST * size / largest if largest > 0 else 0.0
        colors = [_rgb(color) for color in contact_colors(scene.contacts).values()]
        nodes.set_up_direction(tuple(scene.up[0]))
        nodes.configure_default_lights(cast_shadow=False)
        nodes.add_frame("/palm", axes_length=0.35 * size, axes_radius=0.012 * size)
        self._ground(nodes)
        self._gravity = nodes.add_arrows(
            "/gravity", self._weight(scene.up[0]), _of_copies(WEIGHT), shaft_radius=0.015 * size,
            head_radius=0.04 * size, head_length=0.1 * size,
        )  # fmt: skip
        bones, joints = len(scene.bones[0]), 2 * len(scene.bones[0])
        self._bones = _several(nodes, "/palm/bones", rod(), bones, HAND)
        self._joints = _several(nodes, "/palm/joints", ball(), joints, HAND)
        self._pads = _several(nodes, "/palm/pads", ball(), len(scene.pad_names), HAND)
        self._object = _body(nodes, scene)
        self._cones = _several(nodes, "/palm/cones", cone(), len(scene.contacts), np.array(colors), opacity=0.3)
        self._ribs = _several(nodes, "/palm/ribs", ribs(), len(scene.contacts), np.array(colors))
        self._arrows = None if scene.margins is None else nodes.add_arrows(
            "/palm/forces", np.zeros((len(colors), 2, 3)), _of_copies(colors),
            shaft_radius=0.02 * size, head_radius=0.05 * size, head_length=0.12 * size,
        )  # fmt: skip
        apart = len(scene.contacts) if scene.margins is None else 0  # from pads to where the object is nearest
        self._apart = _several(nodes, "/palm/apart", rod(), apart, np.array(colors))
        self._labels = [nodes.add_label(f"/palm/names/{i}", name) for i, name in enumerate(scene.contacts)]
        self._g = nodes.add_label("/gravity_name", "g")
        self._g.visible = scene.gravity
        self._time = nodes.add_label("/time", "", anchor="bottom-center")
        self._time.position = tuple(self._above)
        self._gravity.visible = scene.gravity
        self.show(scene.frame(0))

    def look(self, server: Any) -> None:
        """Let everybody who opens the page look at it from where hand and object are seen."""
        server.initial_camera.position, server.initial_camera.look_at = self.camera
        server.initial_camera.up = tuple(self.scene.up[0])

    @property
    def camera(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Where one looks from, and at: hand and object are both seen."""
        up = self.scene.up[0]
        side = np.cross(up, [0.0, 0.0, 1.0] if abs(up[2]) < 0.9 else [1.0, 0.0, 0.0])
        side /= np.linalg.norm(side)
        from_there = 1.2 * np.cross(side, up) + 0.8 * side + 0.7 * up
        ends = np.vstack([self._around - self.scene.size, self._around + self.scene.size, self._above])
        middle = (ends.min(axis=0) + ends.max(axis=0)) / 2
        far = FAR * float(np.linalg.norm(ends - middle, axis=1).max())
        return tuple(middle + far * from_there / np.linalg.norm(from_there)), tuple(middle)

    @property
    def _around(self) -> Array:
        """(., 3) where the hand and the object are at the start."""
        return np.vstack([self.scene.bones[0].reshape(-1, 3), self.scene.places[0], self.scene.middle])

    @property
    def _above(self) -> Array:
        """(3,) where the time stands: above hand, object and gravity."""
        up, middle, size = self.scene.up[0], self.scene.middle, self.scene.size
        return np.asarray(middle + (max(float(((self._around - middle) @ up).max()), 1.8 * size) + 0.3 * size) * up)

    def _apart_from(self, places: Array, texts: Sequence[str]) -> Array:
        """Return the places (m, 3) of labels, so that none is over another where the view begins."""
        position, middle = self.camera
        return apart(places, texts, (np.array(position), np.array(middle)), self.scene.up[0])

    def show(self, frame: Frame) -> None:
        """Move everything to where it is in a frame."""
        scene = self.scene
        self._gravity.points = self._weight(frame.up)
        _lay(self._bones, frame.bones, scene.thickness)
        _put(self._joints, frame.bones.reshape(-1, 3), np.full(2 * len(frame.bones), scene.thickness))
        _put(self._pads, frame.pads, np.maximum(scene.radii, 0.5 * scene.thickness))
        if self._object is not None:
            turned = quaternions(frame.rotation[None])[0]
            self._object.position, self._object.wxyz = tuple(frame.position), tuple(turned)
        high = CONE * scene.size
        ends = np.stack([frame.places, frame.places + high * frame.normals], axis=1)
        for cones in (self._cones, self._ribs):
            _lay(cones, ends, high * scene.friction)
        forces = np.stack([frame.places, frame.places + self._force * frame.forces], axis=1)
        if self._arrows is not None:
            self._arrows.points = forces.astype(np.float32)
        _lay(self._apart, np.stack([frame.tips, frame.places], axis=1), THREAD * scene.thickness)
        away = frame.places - frame.position
        beside = frame.places + 0.25 * scene.size * away / np.maximum(np.linalg.norm(away, axis=1, keepdims=True), 1e-9)
        texts, places = (*frame.labels, "g"), np.vstack([beside, self._gravity.points[0, 0]])
        placed = self._apart_from(places, texts)
        for label, text, place in zip([*self._labels, self._g], texts, placed, strict=True):
            label.text, label.position = text, tuple(place)
        self._time.text = frame.caption

    def _ground(self, nodes: Any) -> None:
        """Draw squares of 10 mm below everything, across gravity at the start."""
        scene, up = self.scene, self.scene.up[0]
        points = np.vstack([self._around, [self.scene.middle - scene.size * up]]) - self.scene.middle
        low = self.scene.middle + up * (points @ up).min()
        wide = float(np.ceil(2.2 * np.linalg.norm(points, axis=1).max() / CELL) * CELL)
        nodes.add_grid("/ground", width=wide, height=wide, cell_size=CELL, section_size=10 * CELL,
                       position=tuple(low), wxyz=tuple(_upright(up[None])[0]))  # fmt: skip
        position, middle = map(np.array, self.camera)
        left = np.cross(up, middle - position)
        left *= SCALE * np.linalg.norm(middle - position) / np.linalg.norm(left)
        nodes.add_label("/scale", "squares of 10 mm", position=tuple(low + left), anchor="center-center")

    def _weight(self, up: Array) -> Array:
        """Return the arrow (1, 2, 3) of gravity, above what is held."""
        size = self.scene.size
        return np.array([[self.scene.middle + 1.8 * size * up, self.scene.middle + 1.3 * size * up]], dtype=np.float32)


def _body(nodes: Any, scene: Scene) -> Any:
    """Draw the object; None for a bare mass."""
    if scene.shape is None:
        return None
    solid = of_shape(scene.shape)
    round_all_over = len(solid.points) > 300
    return nodes.add_mesh_simple(
        "/palm/object", solid.points.astype(np.float32), solid.triangles.astype(np.uint32), color=OBJECT, opacity=0.35,
        flat_shading=not round_all_over, side="double",
    )  # fmt: skip


def _several(nodes: Any, name: str, solid: Solid, count: int, color: Any, opacity: float = 1.0) -> Any:
    """Draw `count` copies of a solid, which are placed later; None for none."""
    if not count:
        return None
    clear = None if opacity == 1.0 else np.full(count, opacity)  # what has any is not seen through what is held
    return nodes.add_batched_meshes_simple(
        name, solid.points.astype(np.float32), solid.triangles.astype(np.uint32), np.tile([1.0, 0, 0, 0], (count, 1)),
        np.zeros((count, 3)), batched_scales=np.ones((count, 3)), batched_colors=_of_copies(color),
        batched_opacities=clear, side="double", lod="off",
    )  # fmt: skip


def _put(node: Any, places: Array, radii: Array) -> None:
    """Place copies of a ball."""
    if node is None:
        return
    node.batched_positions = places.astype(np.float32)
    node.batched_scales = np.repeat(radii[:, None], 3, axis=1).astype(np.float32)


def _lay(node: Any, ends: Array, radii: Array | float) -> None:
    """Place copies of what reaches from z = 0 to z = 1 from each end (n, 0, 3) to the other (n, 1, 3)."""
    if node is None:
        return
    along = ends[:, 1] - ends[:, 0]
    lengths = np.linalg.norm(along, axis=1)
    node.batched_positions = ends[:, 0].astype(np.float32)
    node.batched_wxyzs = _upright(along).astype(np.float32)
    wide = np.broadcast_to(radii, lengths.shape)
    node.batched_scales = np.column_stack([wide, wide, lengths]).astype(np.float32)


def _upright(directions: Array) -> Array:
    """Return (w, x, y, z) of the shortest turns that take z to directions (n, 3)."""
    lengths = np.linalg.norm(directions, axis=1, keepdims=True)
    x, y, z = np.where(lengths > 0, directions / np.where(lengths > 0, lengths, 1.0), [0.0, 0.0, 1.0]).T
    turns = np.column_stack([1 + z, -y, x, np.zeros_like(z)])
    turns[z < -1 + 1e-12] = [0.0, 1.0, 0.0, 0.0]  # all that lead there are as short
    return np.asarray(turns / np.linalg.norm(turns, axis=1, keepdims=True))


def _of_copies(color: Any) -> Any:
    """Return colours (..., 3) as the viewer takes those of copies and arrows: linear, where all others are sRGB."""
    share = np.asarray(color) / 255
    linear = np.where(share <= 0.04045, share / 12.92, ((share + 0.055) / 1.055) ** 2.4)
    return np.round(255 * linear).astype(np.uint8)


def _rgb(color: str) -> tuple[int, ...]:
    return tuple(int(color[i : i + 2], 16) for i in (1, 3, 5))
