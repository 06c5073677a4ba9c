"""Figure 3 of the paper for any problem: how each synergy moves the hand, and the internal forces it generates."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from synergrip.errors import InputError
from synergrip.grasps.objects import Object
from synergrip.linalg import Array, frozen
from synergrip.reports.data.execution import surroundings
from synergrip.reports.pictures.bearings import HIGH, WIDE, draw_bearings, draw_scale
from synergrip.reports.pictures.contact_colors import contact_colors
from synergrip.reports.pictures.effects import Effect, effects
from synergrip.reports.pictures.forces import places_known
from synergrip.reports.pictures.key import Key
from synergrip.reports.pictures.layout import MARGIN, MOST, Columns, Window, size_that_fits, window
from synergrip.reports.pictures.legend import Asked, grasp_notes, subtitle
from synergrip.reports.pictures.motions import Motions, draw_motion, motions
from synergrip.reports.pictures.page import SPACE, Foot, Page
from synergrip.reports.pictures.paper import Paper
from synergrip.reports.pictures.scene import arrows, draw_forces, draw_object
from synergrip.reports.pictures.sheet import GREY, USUAL, Sheet
from synergrip.reports.pictures.solids import outline
from synergrip.reports.pictures.steps import PLAIN
from synergrip.reports.pictures.view import View, best_view
from synergrip.statics.analysis import Analysis

TITLE, TITLES = 0.32, 0.5  # [inch]
ARROW = 1.6
"""The longest arrow for each length of a normal."""
OFF = 0.2
"""How far from its contact a number stands at least [inch]."""
SCALE, WIDTH_MM = 1.05, 180.0
"""Room for a bar of length [inch], and the usual width of a picture in a paper [mm]."""


def draw_grasp_synergies(asked: Asked, analysis: Analysis, path: Path, paper: Paper | None = None) -> str:
    """Draw each synergy of a problem in a column: the motion of the hand, and the forces at the contacts.

    Args:
        asked: title, hand and task; without a hand only the forces are drawn.
        analysis: of its grasp.
        path: ends in .svg, .png or .pdf.
        paper: of a picture for a paper, in which the notes are left to its caption.

    Returns:
        What its notes say, as a caption.

    Raises:
        InputError: matrices that do not say where the contacts are, or a suffix that says no format.
        OSError: the file cannot be written.
    """
    grasp, held = analysis.grasp, asked.held
    if not places_known(grasp):
        message = "nothing can be drawn: the matrices do not say where the contacts are; give their point_m and normal"
        raise InputError.at("", message)
    if paper is not None:
        paper.refuse_height("synergies")
    moved = motions(held.hand, held.synergies, held.q, [touch.pad for touch in held.touches], MOST) if held else None
    units = [motion.step.unit for motion in moved.each] if moved else [PLAIN] * min(grasp.n_z, MOST)
    body = held.body if held else Object(position=frozen(np.zeros(3)))
    picture = _Picture(asked, analysis, moved, effects(analysis, units), body, paper)
    picture.write(path)
    return " ".join([f"{asked.title}: {subtitle(analysis)}.", *picture.notes])


@dataclass(frozen=True)
class _Picture:
    """All that is drawn, before it is known where on the sheet."""

    asked: Asked
    analysis: Analysis
    moved: Motions | None
    effects: tuple[Effect, ...]
    body: Object
    paper: Paper | None

    @property
    def columns(self) -> Columns:
        """Where the panels go."""
        return Columns(len(self.effects), None if self.paper is None else self.paper.wide(WIDTH_MM))

    @property
    def notes(self) -> tuple[str, ...]:
        """What is to be said of it."""
        spin = any(each.forces.largest_spin > 0 for each in self.effects)
        gravity = self.gravity
        upward = gravity is not None and self.view.flat(gravity)[1] > 0
        downward = ("Drawn with z of the palm up: g points up because the palm looks down.",) if upward else ()
        return (*grasp_notes(self.asked, self.analysis, spin), *downward)

    @property
    def gravity(self) -> Array | None:
        """(3,) at the start, palm frame [m/s^2]; None where it is not known."""
        held = self.asked.held
        return surroundings(self.asked.timed, held.body.mass)[0] if held else None

    @property
    def view(self) -> View:
        points = np.array([contact.point for contact in self.analysis.grasp.contacts])
        return self.moved.view() if self.moved else best_view(points, [each.forces.forces for each in self.effects])

    @property
    def normal(self) -> float:
        """How long a normal is drawn [m]."""
        return 0.5 * self.analysis.response.scale.length

    def above(self, view: View) -> Window | None:
        """Return what the panels of the hand show."""
        if self.moved is None:
            return None
        drawn = np.vstack([view.flat(self.moved.points), self._solid(view) + view.flat(self.body.position)])
        return window(drawn, self.columns.column)

    def below(self, view: View) -> Window:
        """Return what the panels of the forces show."""
        contacts = self.analysis.grasp.contacts
        drawn = [each.forces.points + arrows(each.forces, ARROW * self.normal) for each in self.effects]
        drawn += [np.array([c.point, c.point + self.normal * c.frame[:, 0]]) for c in contacts]
        return window(np.vstack([*(view.flat(points) for points in drawn), self._solid(view)]), self.columns.column)

    def _solid(self, view: View) -> Array:
        return outline(self.body.shape, view) if self.body.shape else np.zeros((1, 2))

    def write(self, path: Path) -> None:
        """Lay the panels out, draw them and write the file."""
        view, columns = self.view, self.columns
        above, below = self.above(view), self.below(view)
        upper, column = TITLE + (above.height if above else 0.0), columns.column

        def draw(sheet: Sheet, index: int, left: float, top: float) -> None:
            name = self.moved.each[index].title if self.moved else self.effects[index].name
            size = size_that_fits(name, 0.9 * column, 11)
            sheet.write(left + column / 2, top + 0.2, name, size, across="center", bold=True)
            if self.moved and above:
                panel = sheet.panel(left, top + TITLE, column, above.height, above.middle, above.span)
                draw_object(panel, view, self.body, self.body.position, self.analysis.grasp.contacts)
                draw_motion(panel, view, self.moved.rest, self.moved.each[index])
            self._forces(sheet, view, below, index, left, top + upper)

        title, under, notes, letters = self.asked.title, subtitle(self.analysis), True, USUAL
        if self.paper is not None:
            title, under, notes, letters = self.paper.title, "", False, self.paper.letters
        page = Page(
            title, under, columns, upper + TITLES + below.height,
            self.notes if notes else (), self._foot(view, above, below), letters,
        )  # fmt: skip
        page.write(path, draw)

    def _forces(self, sheet: Sheet, view: View, shown: Window, index: int, left: float, top: float) -> None:
        effect, column = self.effects[index], self.columns.column
        first, second = effect.titles
        middle = left + column / 2
        sheet.write(middle, top + 0.2, first, size_that_fits(first, column, 10.5), across="center")
        sheet.write(middle, top + 0.38, second, size_that_fits(second, column, 9), GREY, across="center")
        panel = sheet.panel(left, top + TITLES, column, shown.height, shown.middle, shown.span)
        contacts = self.analysis.grasp.contacts
        draw_object(panel, view, self.body, np.zeros(3), contacts)
        off = max(0.36 * self.normal, OFF * shown.span / column)
        draw_forces(panel, view, contacts, effect.forces, self.normal, ARROW * self.normal, off)

    def _foot(self, view: View, above: Window | None, below: Window) -> Foot:
        """Return axes, gravity, lengths and the names of the contacts."""
        columns, gravity = self.columns, self.gravity
        names = self.analysis.grasp.contact_names
        numbered = [(f"{k} {name}", contact_colors(names)[name]) for k, name in enumerate(names, start=1)]
        left = MARGIN + (2 if gravity is not None else 1) * WIDE
        scales = [(above, "hand"), (below, "forces")] if above else [(below, "")]
        key = Key(tuple(numbered), max(columns.width - MARGIN - left - SCALE * len(scales), 1.0))
        height = max(HIGH, key.height)

        def draw(sheet: Sheet, top: float) -> None:
            at = MARGIN + draw_bearings(sheet, view, MARGIN, top + (height - HIGH) / 2, gravity) + 0.1
            for shown, word in scales:
                draw_scale(sheet, at, top + height / 2 + 0.12, shown.span / columns.column, SCALE - 0.35, word)
                at += SCALE
            key.draw(sheet, at, top + (height - key.height) / 2)

        return Foot(height + SPACE, draw)
