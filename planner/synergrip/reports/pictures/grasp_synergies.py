"""Figure 3 of the paper for any problem: how each synergy moves the hand, and the internal forces it generates."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from synergrip.errors import InputError
from synergrip.grasps.objects import Object
from synergrip.linalg import Array, frozen
from synergrip.problems.problem import Problem
from synergrip.reports.pictures.effects import Effect, effects
from synergrip.reports.pictures.forces import places_known
from synergrip.reports.pictures.layout import COLUMN, MOST, Columns, Window, window
from synergrip.reports.pictures.legend import grasp_notes, subtitle
from synergrip.reports.pictures.motions import Motions, draw_motion, motions
from synergrip.reports.pictures.page import Page
from synergrip.reports.pictures.scene import arrows, draw_forces, draw_numbers, draw_object
from synergrip.reports.pictures.sheet import GREY, Sheet
from synergrip.reports.pictures.solids import outline
from synergrip.reports.pictures.steps import PLAIN
from synergrip.reports.pictures.view import View, best_view
from synergrip.statics.analysis import Analysis

TITLE, TITLES = 0.32, 0.5  # [inch]
ARROW = 1.6
"""The longest arrow for each length of a normal."""


def draw_grasp_synergies(problem: Problem, analysis: Analysis, path: Path) -> None:
    """Draw each synergy of a problem in a column: the motion of the hand, and the forces at the contacts.

    Args:
        problem: without a hand only the forces are drawn.
        analysis: of its grasp.
        path: ends in .svg, .png or .pdf.

    Raises:
        InputError: matrices that do not say where the contacts are, or a suffix that says no format.
        OSError: the file cannot be written.
    """
    grasp, held = analysis.grasp, problem.held
    if not places_known(grasp):
        message = "nothing can be drawn: the matrices do not say where the contacts are; give their point_m and normal"
        raise InputError.at("", message)
    moved = motions(held.hand, held.synergies, held.q, [touch.pad for touch in held.touches], MOST) if held else None
    units = [motion.step.unit for motion in moved.each] if moved else [PLAIN] * min(grasp.n_z, MOST)
    body = held.body if held else Object(position=frozen(np.zeros(3)))
    _Picture(problem, analysis, moved, effects(analysis, units), body).write(path)


@dataclass(frozen=True)
class _Picture:
    """All that is drawn, before it is known where on the sheet."""

    problem: Problem
    analysis: Analysis
    moved: Motions | None
    effects: tuple[Effect, ...]
    body: Object

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
        return window(np.vstack([view.flat(self.moved.points), self._solid(view) + view.flat(self.body.position)]))

    def below(self, view: View) -> Window:
        """Return what the panels of the forces show."""
        contacts = self.analysis.grasp.contacts
        drawn = [each.forces.points + arrows(each.forces, ARROW * self.normal) for each in self.effects]
        drawn += [np.array([c.point, c.point + self.normal * c.frame[:, 0]]) for c in contacts]
        return window(np.vstack([*(view.flat(points) for points in drawn), self._solid(view)]))

    def _solid(self, view: View) -> Array:
        return outline(self.body.shape, view) if self.body.shape else np.zeros((1, 2))

    def write(self, path: Path) -> None:
        """Lay the panels out, draw them and write the file."""
        view = self.view
        above, below = self.above(view), self.below(view)
        upper = TITLE + (above.height if above else 0.0)

        def draw(sheet: Sheet, index: int, left: float, top: float) -> None:
            name = self.moved.each[index].title if self.moved else self.effects[index].name
            sheet.write(left + COLUMN / 2, top + 0.2, name, 11, across="center", bold=True)
            if self.moved and above:
                panel = sheet.panel(left, top + TITLE, COLUMN, above.height, above.middle, above.span)
                draw_object(panel, view, self.body, self.body.position, self.analysis.grasp.contacts)
                draw_motion(panel, view, self.moved.rest, self.moved.each[index])
            self._forces(sheet, view, below, index, left, top + upper)

        page = Page(
            self.problem.title, subtitle(self.analysis), Columns(len(self.effects)), upper + TITLES + below.height,
            tuple(grasp_notes(self.problem, self.analysis)),
        )  # fmt: skip
        page.write(path, draw)

    def _forces(self, sheet: Sheet, view: View, shown: Window, index: int, left: float, top: float) -> None:
        effect = self.effects[index]
        first, second = effect.titles
        sheet.write(left + COLUMN / 2, top + 0.2, first, 10.5, across="center")
        sheet.write(left + COLUMN / 2, top + 0.38, second, 9, GREY, across="center")
        panel = sheet.panel(left, top + TITLES, COLUMN, shown.height, shown.middle, shown.span)
        contacts = self.analysis.grasp.contacts
        draw_object(panel, view, self.body, np.zeros(3), contacts)
        draw_forces(panel, view, contacts, effect.forces, self.normal, ARROW * self.normal)
        draw_numbers(panel, view, contacts, 0.3 * self.normal)
