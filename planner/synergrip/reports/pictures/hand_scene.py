"""A hand that holds an object, in space: links, object, friction cones and the forces at one instant."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.errors import shortened
from synergrip.grasps.shapes.shape import circle
from synergrip.linalg import Array
from synergrip.reports.pictures.bearings import HIGH, draw_bearings, draw_scale
from synergrip.reports.pictures.contact_colors import contact_colors
from synergrip.reports.pictures.depth import Depth, darkened, faded
from synergrip.reports.pictures.free_places import apart
from synergrip.reports.pictures.line_chart import Box
from synergrip.reports.pictures.scene import front_and_back
from synergrip.reports.pictures.sheet import INK, Panel, Sheet
from synergrip.reports.pictures.view import View, best_view
from synergrip.reports.view.scene import Scene

HAND, OBJECT = "#8a97ab", "#d9c190"
"""Colours of the hand and of what it holds."""
CONE, FORCE = 0.32, 0.95
"""Height of a friction cone and length of the longest force, of the size of the object."""
NAMES, GAP, APART, LONGEST = 0.95, 0.1, 0.31, 14
"""Room for a name, between it and what is drawn, and between two names [inch]; its letters."""
THICKEST = 0.16
"""Radius of a link that is drawn, at most, of the size of the object."""


def draw_hand(sheet: Sheet, box: Box, scene: Scene, k: int) -> None:
    """Draw frame `k` of a scene in a box, axes and a bar of length below it."""
    drawn = _Drawn(scene, k, _view(scene, k))
    high = box.height - HIGH
    points = drawn.extent()
    low, top = points.min(axis=0), points.max(axis=0)
    size = top - low
    per_inch = max(size[0] / (box.width - 2 * NAMES), size[1] / (high - 0.3))
    panel = sheet.panel(box.left, box.top, box.width, high, (low + top) / 2, per_inch * box.width)
    drawn.object(panel)
    drawn.hand(panel, per_inch)
    drawn.contacts(panel, np.array([low[0] - GAP * per_inch, top[0] + GAP * per_inch]), APART * per_inch)
    below = box.top + high
    wide = draw_bearings(sheet, drawn.view, box.left, below, -scene.up[k])
    draw_scale(sheet, box.left + wide + 0.15, below + HIGH / 2 + 0.12, per_inch, 0.9)


def _view(scene: Scene, k: int) -> View:
    points = np.vstack([scene.bones[k].reshape(-1, 3), scene.places[k]])
    forces = scene.forces[k]
    return best_view(points, [each[None] for each in forces if np.linalg.norm(each) > 0], scene.up[k])


@dataclass(frozen=True)
class _Drawn:
    """One frame, seen from somewhere."""

    scene: Scene
    k: int
    view: View

    @property
    def _outline(self) -> Array:
        """(n, 2) of the object."""
        shape, turned = self.scene.shape, self.scene.rotation[self.k]
        middle = self.view.flat(self.scene.position[self.k])
        if shape is None:
            return middle[None]
        directions = circle() @ np.vstack([self.view.right, self.view.up])
        farthest = np.array([turned @ shape.farthest(turned.T @ direction) for direction in directions])
        return np.asarray(middle + self.view.flat(farthest))

    @property
    def _arrows(self) -> Array:
        """(m, 3) as long as they are drawn [m]."""
        forces = self.scene.forces[self.k]
        largest = float(np.linalg.norm(self.scene.forces, axis=2).max(initial=0.0))
        return np.asarray(forces * (FORCE * self.scene.size / largest) if largest > 0 else 0 * forces)

    @property
    def _thickness(self) -> float:
        return min(self.scene.thickness, THICKEST * self.scene.size)

    def extent(self) -> Array:
        """Return points (n, 2) around all that is drawn but names."""
        scene, k = self.scene, self.k
        bones = self.view.flat(scene.bones[k].reshape(-1, 3))
        thick = self._thickness
        ends = self.view.flat(scene.places[k] + self._arrows)
        return np.vstack([bones - thick, bones + thick, self._outline, ends])

    def object(self, panel: Panel) -> None:
        """Draw what is held, translucent."""
        scene, k = self.scene, self.k
        near, middle = self._near(scene.position[k]), self.view.flat(scene.position[k])
        if scene.shape is None:
            panel.cross(middle, INK, near)
            return
        edge = self._outline
        panel.area(edge, OBJECT, 0.5, near)
        for share in (0.85, 0.7, 0.55, 0.4) if _is_round(edge - middle) else ():  # light from the upper left
            shift = (1 - share) * 0.45 * float(np.abs(edge - middle).max()) * np.array([-1.0, 1.0])
            panel.area(middle + shift + share * (edge - middle), "#ffffff", 0.13, near)
        panel.strokes([edge], darkened(OBJECT, 0.4), 0.9, near)
        for line in scene.shape.lines():
            for piece, in_front in front_and_back(line @ scene.rotation[k].T, self.view):
                color = darkened(OBJECT, 0.35) if in_front else faded(darkened(OBJECT, 0.3), 0.3)
                panel.strokes([self.view.flat(piece) + middle], color, 0.6 if in_front else 0.3, near)

    def hand(self, panel: Panel, per_inch: float) -> None:
        """Draw the links as rods that light falls on, the far ones first."""
        bones = self.scene.bones[self.k]
        depth, wide = Depth.of(self.view, bones.reshape(-1, 3)), 2 * 72 * self._thickness / per_inch
        light = 0.3 * self._thickness * np.array([-1.0, 1.0])
        for bone in bones:
            near, flat = self._near(bone.mean(axis=0)), self.view.flat(bone)
            tone = faded(HAND, 0.45 * (1 - depth.near(bone)))
            for color, share, shift in ((darkened(tone, 0.45), 1.0, 0.0), (tone, 0.86, 0.0),
                                        (faded(tone, 0.35), 0.42, 1.0), (faded(tone, 0.65), 0.16, 1.0)):  # fmt: skip
                panel.strokes([flat + shift * light], color, share * wide, near)

    def contacts(self, panel: Panel, beside: Array, least: float) -> None:
        """Draw friction cones, forces and names at `beside` (2,), `least` apart, in the contacts' colours."""
        scene, k, arrows = self.scene, self.k, self._arrows
        colors = list(contact_colors(scene.contacts).values())
        places, ends = self.view.flat(scene.places[k]), self.view.flat(scene.places[k] + arrows)
        for index, color in enumerate(colors):
            self._cone(panel, index, color)
            panel.dots(places[index][None], color, 6.5, 1e3 + 2, edge=0.8)
        panel.arrows(places, ends - places, colors, 1e3 + 1, thick=0.034)
        self._names(panel, places, colors, beside, least)

    def _names(self, panel: Panel, places: Array, colors: list[str], beside: Array, least: float) -> None:
        """Write names and sizes of forces beside the picture, each with a line to its contact."""
        scene, k, middle = self.scene, self.k, beside.mean()
        for edge, outward in zip(beside, (-1.0, 1.0), strict=True):
            here = [i for i, place in enumerate(places) if (place[0] >= middle) == (outward > 0)]
            heights = apart(places[here, 1], least)
            for index, height in zip(here, heights, strict=True):
                at, size = np.array([edge, height]), float(np.linalg.norm(scene.forces[k, index]))
                panel.strokes([np.array([at, places[index]])], colors[index], 0.6, 1e3 + 1)
                name = shortened(scene.contacts[index], LONGEST)
                text = f"{name}\n{size:.2g} N" if size > 0 else name
                panel.note(at, text, colors[index], "left" if outward > 0 else "right", bold=True)

    def _cone(self, panel: Panel, index: int, color: str) -> None:
        """Draw the cone of directions in which a contact can push without slipping."""
        scene, k, high = self.scene, self.k, CONE * self.scene.size
        if not scene.friction[index] > 0:
            return
        from scipy.spatial import ConvexHull

        apex, normal = scene.places[k, index], scene.normals[k, index]
        beside = np.cross(normal, np.eye(3)[int(np.argmin(np.abs(normal)))])
        beside /= np.linalg.norm(beside)
        ring = circle() @ np.vstack([beside, np.cross(normal, beside)])
        base = self.view.flat(apex + high * normal + high * scene.friction[index] * ring)
        every = np.vstack([base, self.view.flat(apex)])
        panel.area(every[ConvexHull(every).vertices], color, 0.2, 1e3)
        panel.strokes([base], color, 0.7, 1e3)

    def _near(self, point: Array) -> float:
        """Return what is drawn over what: metres toward the viewer, all of them small."""
        return 10.0 + float(self.view.depth(point))


def _is_round(around: Array) -> bool:
    """Tell whether an outline (n, 2) about the origin is a circle."""
    lengths = np.linalg.norm(around, axis=1)
    return bool(lengths.min() > 0.98 * lengths.max())
