"""A hand in a posture as a picture, with what it is to hold if anything: also where contacts do not touch."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import chain
from pathlib import Path

import numpy as np

from synergrip.linalg import Array
from synergrip.reports.pictures.contact_colors import contact_colors
from synergrip.reports.pictures.layout import COLUMN, Columns, window
from synergrip.reports.pictures.page import Page
from synergrip.reports.pictures.sheet import BLUE, FAINT, GREEN, GREY, INK, VERMILION, Panel, Sheet
from synergrip.reports.pictures.solids import outline
from synergrip.reports.pictures.view import View, best_view, view_from
from synergrip.reports.view.scene import Frame, Scene

WIDE = 1.6
"""Panels of this picture beside those of others."""
MOST = 24
"""Pads that are named below the picture."""
NAMED = "orange x, green y, blue z"


def draw_posture(scene: Scene, frame: Frame, title: str, path: Path) -> None:
    """Draw a hand from two sides: bones, pads with numbers, the object, and gravity.

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
        return np.vstack([frame.bones.reshape(-1, 3), frame.links, frame.pads, frame.places, frame.position])

    def views(self) -> tuple[View, View]:
        """Return the view that shows most, and one from a quarter turn beside it."""
        first = best_view(self.points, ())
        azimuth = float(np.arctan2(first.toward[1], first.toward[0]))
        return first, view_from(azimuth + np.pi / 2, float(np.arcsin(first.toward[2])))

    def write(self, path: Path) -> None:
        """Lay the panels out, draw them and write the file."""
        views = self.views()
        shown = [window(np.vstack([view.flat(self.points), self._solid(view)])) for view in views]
        widest = max(each.span for each in shown)
        tallest = max(float(np.ptp(view.flat(self.points)[:, 1])) + 2.4 * self.scene.size for view in views)
        height = WIDE * COLUMN * float(np.clip(tallest / widest, 0.4, 1.2))
        page = Page(self.title, self.frame.caption, _TwoPanels(2), height, tuple(chain(self._named(), self._legend())))

        def draw(sheet: Sheet, index: int, left: float, top: float) -> None:
            view, each = views[index], shown[index]
            self._draw(sheet.panel(left, top, WIDE * COLUMN, height, each.middle, widest), view)

        page.write(path, draw)

    def _solid(self, view: View) -> Array:
        """Return the outline of the object on paper, or its middle."""
        where = view.flat(self.frame.position)[None]
        return where if self.scene.shape is None else where + outline(self.scene.shape, view)

    def _draw(self, panel: Panel, view: View) -> None:
        frame, scene = self.frame, self.scene
        if scene.shape is not None:
            near = 5.0 + float(view.depth(frame.position))
            panel.area(self._solid(view), FAINT, 0.5, near)
            lines = (view.flat(line + frame.position) for line in scene.shape.lines())
            panel.strokes(list(lines), GREY, 0.6, near)
        for bone in frame.bones:
            panel.strokes([view.flat(bone)], INK, 3.0, 5.0 + float(view.depth(bone).mean()))
        self._axes(panel, view)
        colors = contact_colors(scene.contacts)
        size = 0.35 * scene.size
        for k, place in enumerate(frame.pads, start=1):
            panel.dots(view.flat(place)[None], GREY, 4.0, 9.0, edge=0.6)
            if not scene.contacts:
                panel.note(view.flat(place) + self._beside(view, place), str(k))
        each = zip(scene.contacts, frame.tips, frame.places, frame.normals, strict=True)
        for k, (name, tip, place, normal) in enumerate(each, start=1):
            panel.strokes([view.flat(np.array([tip, place]))], colors[name], 1.0, 9.1, dashed=True)
            panel.strokes([view.flat(np.array([place, place + size * normal]))], colors[name], 1.4, 9.2)
            panel.dots(view.flat(place)[None], colors[name], 6.0, 9.3, edge=0.6)
            panel.note(view.flat(place) + self._beside(view, place), str(k))
        if scene.gravity:
            above = frame.position + 1.7 * scene.size * frame.up
            panel.arrows(view.flat(above)[None], view.flat(-0.5 * scene.size * frame.up)[None], GREY)

    def _axes(self, panel: Panel, view: View) -> None:
        """Draw the axes of the palm."""
        for axis, color in zip(np.eye(3), (VERMILION, GREEN, BLUE), strict=True):
            panel.arrows(view.flat(np.zeros((1, 3))), view.flat(0.5 * self.scene.size * axis)[None], color)

    def _beside(self, view: View, place: Array) -> Array:
        """Return where a number stands beside a place (3,), on paper: away from the middle."""
        away = view.flat(place - self.points.mean(axis=0))
        return np.asarray(0.22 * self.scene.size * away / max(float(np.linalg.norm(away)), 1e-9))

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
        contacts = " Lines at contacts: normals into the object; dashed: to the pads." if self.scene.contacts else ""
        gravity = " Grey arrow: gravity." if self.scene.gravity else ""
        held = f" Object at ({_numbers(self.frame.position)}) mm." if self.scene.contacts else ""
        yield f"Arrows at the palm: {NAMED}.{contacts}{gravity}{held} From two sides, a quarter turn apart."


class _TwoPanels(Columns):
    """Panels that are wider than those of other pictures."""

    @property
    def width(self) -> float:
        """Of the sheet [inch]."""
        return 2 * WIDE * COLUMN + 1.0

    def place(self, index: int) -> tuple[int, float]:
        """Return the block of a column and how far from the left it starts [inch]."""
        return 0, 0.4 + index * (WIDE * COLUMN + 0.2)


def _numbers(place: Sequence[float] | Array) -> str:
    return ", ".join(f"{round(1e3 * float(value), 1) + 0.0:g}" for value in place)
