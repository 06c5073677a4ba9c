"""A hand in a posture as a picture, with what it is to hold if anything: also where contacts do not touch."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import chain
from pathlib import Path

import numpy as np

from synergrip.linalg import Array, frozen
from synergrip.reports.pictures.bearings import HIGH, draw_bearings, draw_scale
from synergrip.reports.pictures.contact_colors import contact_colors
from synergrip.reports.pictures.free_places import free_places
from synergrip.reports.pictures.layout import Columns
from synergrip.reports.pictures.name_columns import Name, columns_height, columns_width, draw_names
from synergrip.reports.pictures.page import Page
from synergrip.reports.pictures.scene import draw_solid
from synergrip.reports.pictures.sheet import GREY, INK, Panel, Sheet
from synergrip.reports.pictures.solids import outline
from synergrip.reports.pictures.view import View, axes_apart, best_view
from synergrip.reports.view.scene import Frame, Scene

WIDE, FLATTEST, TALLEST = 4.3, 0.5, 1.1
"""Width of a panel [inch], and its height at least and at most, of the width."""
MOST, NAMED = 24, 72
"""Pads that are named below the picture, and pads and links that are beside it."""


def draw_posture(scene: Scene, frame: Frame, title: str, path: Path) -> None:
    """Draw a hand from two sides: bones, pads with numbers, the object, and gravity; without contacts with all names.

    Args:
        scene: names, shape and radii.
        frame: where everything is.
        title: heading of the picture.
        path: ends in .svg, .png or .pdf.

    Raises:
        InputError: a suffix that says no format.
        OSError: the file cannot be written.
    """
    _Picture(scene, frame, title).write(path)


@dataclass(frozen=True)
class _Picture:
    scene: Scene
    frame: Frame
    title: str

    @property
    def points(self) -> Array:
        """All that is drawn (n, 3), but for the solid of the object."""
        frame = self.frame
        held = frame.position[None] if self._holds else np.zeros((0, 3))
        return np.vstack([frame.bones.reshape(-1, 3), frame.links, frame.pads, frame.places, held])

    @property
    def _holds(self) -> bool:
        return bool(self.scene.contacts) or self.scene.shape is not None

    def views(self) -> tuple[View, View]:
        """Return the view that shows most, and one from a quarter turn beside it; what is up stays up."""
        up = self.frame.up
        first = best_view(self.points, (), up, lambda view: axes_apart(view) and axes_apart(_beside(view, up)))
        return first, _beside(first, up)

    @property
    def _names(self) -> list[Name]:
        """What stands beside the hand: pads with their numbers, then links; nothing where there are contacts."""
        if self.scene.contacts:
            return []
        pads = [Name(f"{k} {name}", INK, bold=True) for k, name in enumerate(self.scene.pad_names, start=1)]
        return [*pads, *(Name(name, GREY) for name in self.scene.link_names)][:NAMED]

    def write(self, path: Path) -> None:
        """Lay the panels out, draw them and write the file."""
        views = self.views()
        drawn = [np.vstack([view.flat(self.points), self._solid(view)]) for view in views]
        low, high = ([end(points, axis=0) for points in drawn] for end in (np.min, np.max))
        size = np.max(np.array(high) - np.array(low), axis=0) + 0.7 * self.scene.size
        span = float(max(size[0], size[1] / TALLEST))
        tall = WIDE * float(np.clip(size[1] / span, FLATTEST, TALLEST))
        tall = max(tall, columns_height(self._names))
        notes = tuple(chain(self._named(), self._legend()))
        beside = columns_width(self._names)
        page = Page(self.title, self.frame.caption, _TwoPanels(2, beside=beside), tall + HIGH, notes)

        def draw(sheet: Sheet, index: int, left: float, top: float) -> None:
            middle, inch, wide = (low[index] + high[index]) / 2, span / WIDE, WIDE + 2 * beside * (index == 0)
            panel = sheet.panel(left, top, wide, tall, middle, wide * inch)
            self._draw(panel, views[index], 0.06 * span)
            if index == 0:
                places = views[0].flat(np.vstack([self.frame.pads, self.frame.links])[: len(self._names)])
                draw_names(panel, self._names, places, middle, np.array([wide, tall]) * inch / 2, inch)
            gravity = -self.frame.up if self.scene.gravity else None
            wide = draw_bearings(sheet, views[index], left, top + tall, gravity)
            draw_scale(sheet, left + wide + 0.15, top + tall + HIGH / 2 + 0.12, span / WIDE, 0.9)

        page.write(path, draw)

    def _solid(self, view: View) -> Array:
        """Return the outline of the object on paper, or its middle."""
        if self.scene.shape is None:
            return view.flat(self.points[:1])
        return view.flat(self.frame.position) + outline(self.scene.shape, view)

    def _draw(self, panel: Panel, view: View, off: float) -> None:
        frame, scene = self.frame, self.scene
        if scene.shape is not None:
            draw_solid(panel, view, scene.shape, frame.position)
        lines = [view.flat(bone) for bone in frame.bones]
        for bone, line in zip(frame.bones, lines, strict=True):
            panel.strokes([line], INK, 3.0, 5.0 + float(view.depth(bone).mean()))
        if not scene.contacts:
            panel.dots(view.flat(frame.links), INK, 4.0, 8.9, edge=0.8)
        panel.dots(view.flat(frame.pads), GREY, 4.0, 9.0, edge=0.6)
        if not scene.contacts:
            self._numbers(panel, view.flat(frame.pads), lines, [GREY] * len(frame.pads), off)
            return
        colors = list(contact_colors(scene.contacts).values())
        ends = [view.flat(np.array(pair)) for pair in zip(frame.tips, frame.places, strict=True)]
        normals = frame.places + 0.35 * scene.size * frame.normals
        pushed = [view.flat(np.array(pair)) for pair in zip(frame.places, normals, strict=True)]
        for color, apart, push in zip(colors, ends, pushed, strict=True):
            panel.strokes([apart], color, 1.0, 9.1, dashed=True)
            panel.strokes([push], color, 1.4, 9.2)
            panel.dots(push[:1], color, 6.0, 9.3, edge=0.6)
        self._numbers(panel, view.flat(frame.places), [*lines, *ends, *pushed], colors, off)

    def _numbers(self, panel: Panel, places: Array, lines: list[Array], colors: list[str], off: float) -> None:
        """Write the number of each pad or contact beside it, free of what is drawn."""
        outward = places - places.mean(axis=0, keepdims=True) if len(places) else places
        for k, place in enumerate(free_places(places, outward, lines, off)):
            panel.note(place, str(k + 1), colors[k], bold=True)

    def _named(self) -> Iterator[str]:
        """Yield what the numbers stand for, and where it is."""
        frame, scene = self.frame, self.scene
        if scene.contacts:
            what, names, places = "Contacts", frame.labels, frame.places
        else:
            what, names, places = "Pads", scene.pad_names, frame.pads
        told = [f"{k} {name} ({_numbers(place)})"
                for k, (name, place) in enumerate(zip(names[:MOST], places, strict=False), start=1)]  # fmt: skip
        if told:
            left = f"; {len(names) - MOST} more" if len(names) > MOST else ""
            yield f"{what}, in mm in the palm frame: {', '.join(told)}{left}."

    def _legend(self) -> Iterator[str]:
        held = f"The object is at ({_numbers(self.frame.position)}) mm. " if self._holds else ""
        contacts = "Lines at contacts: normals into the object; dashed: to their pads. " if self.scene.contacts else ""
        pads = "Black: pads by number and name; grey: " if self.scene.pad_names else "Names: "
        names = "" if self.scene.contacts else f"{pads}links, at their origins. "
        yield f"{held}{contacts}{names}x, y, z: axes of the palm. From two sides, a quarter turn apart."


@dataclass(frozen=True)
class _TwoPanels(Columns):
    """Panels that are wider than those of other pictures, with room for names on both sides of the first."""

    beside: float = 0.0

    @property
    def width(self) -> float:
        """Of the sheet [inch]."""
        return 2 * WIDE + 1.0 + 2 * self.beside

    def place(self, index: int) -> tuple[int, float]:
        """Return the block of a column and how far from the left it starts [inch]."""
        return 0, 0.4 + index * (WIDE + 0.2 + 2 * self.beside)


def _numbers(place: Sequence[float] | Array) -> str:
    return ", ".join(f"{round(1e3 * float(value), 1) + 0.0:g}" for value in place)


def _beside(view: View, up: Array) -> View:
    """Return the view from a quarter turn about `up` (3,) beside one."""
    axes = (view.right, view.up, view.toward)
    return View(*(frozen(np.cross(up, axis) + up * (up @ axis)) for axis in axes))
