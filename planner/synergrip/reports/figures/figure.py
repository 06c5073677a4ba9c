"""The front of the figures: what there is to draw, and drawing it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from synergrip.documents.naming import naming_arguments
from synergrip.errors import InputError, one_of
from synergrip.explain.synergies.synergies_needed import synergies_needed
from synergrip.planning.answer import Answer
from synergrip.planning.outcome import Outcome
from synergrip.planning.planning import plan as planned
from synergrip.problems.problem import Problem
from synergrip.reports.data.saving import path_of, written_at
from synergrip.reports.figures.cones_figure import draw_cones_figure
from synergrip.reports.figures.margin_figure import draw_margin
from synergrip.reports.figures.overview_figure import draw_overview
from synergrip.reports.figures.subject import Subject, subject_of
from synergrip.reports.pictures.grasp_synergies import draw_grasp_synergies
from synergrip.reports.pictures.needed_curve import draw_needed
from synergrip.reports.pictures.paper import STANDARD, Paper
from synergrip.reports.pictures.sheet import picture_suffix
from synergrip.statics.analysis import analyse

Told = Callable[[int, int, int], None]


@dataclass(frozen=True)
class Figure:
    """Something that is drawn for a paper."""

    of_plan: bool
    """Whether it takes a plan; else the problem is enough."""
    draw: Callable[[Subject, Path, Paper, Told], str]
    """Draws it and returns what is to be said below it."""


def _margin(subject: Subject, path: Path, paper: Paper, told: Told) -> str:
    return draw_margin(subject.document or {}, path, paper)


def _cones(subject: Subject, path: Path, paper: Paper, told: Told) -> str:
    return draw_cones_figure(subject, path, paper)


def _overview(subject: Subject, path: Path, paper: Paper, told: Told) -> str:
    return draw_overview(subject.document or {}, subject.folder, path, paper)


def _synergies(subject: Subject, path: Path, paper: Paper, told: Told) -> str:
    asked = subject.asked()
    return draw_grasp_synergies(asked, analyse(asked.grasp, asked.timed.wrench), path, paper)


def _needed(subject: Subject, path: Path, paper: Paper, told: Told) -> str:
    asked = subject.asked()
    found = synergies_needed(asked.grasp, asked.timed, told=told)
    if found.interrupted:  # half of the curves are no figure
        raise KeyboardInterrupt
    return draw_needed(found, path, asked.title, paper)


FIGURES = {
    "margin": Figure(True, _margin), "cones": Figure(True, _cones), "overview": Figure(True, _overview),
    "synergies": Figure(False, _synergies), "needed": Figure(False, _needed),
}  # fmt: skip
"""By their names."""


def figure_of(what: object, key: str = "what") -> Figure:
    """Return a figure by its name or raise an `InputError` at `key` that lists the names."""
    if not isinstance(what, str) or what not in FIGURES:
        raise InputError.at(key, one_of(what, FIGURES))
    return FIGURES[what]


@naming_arguments
def figure(
    what: str, source: str | Path | Problem | Answer, path: str | Path, *, width_mm: float | None = None,
    height_mm: float | None = None, font: str = "", font_size: float = STANDARD, title: str = "",
    dpi: float | None = None, overrides: Sequence[str] = (),
) -> Path:  # fmt: skip
    """Draw a figure for a paper, what ``synergrip figure`` draws, and return the file.

    Args:
        what: "margin" (slip margins over time), "cones" (forces inside their friction cones), "overview" (the hand
            beside margins and forces), "synergies" (what each synergy does) or "needed" (how many a task needs).
        source: a problem, its file or its bundled name, which is planned where the figure takes a plan; or an answer,
            its folder or its plan.json, which is not planned again.
        path: the file, replaced whole or not at all: .svg, .pdf or .png.
        width_mm: on paper [mm].
        height_mm: on paper [mm], where it does not follow from the width.
        font: a family that is installed, or serif, sans-serif, monospace.
        font_size: of axis labels [points]; other letters are in proportion.
        title: above the figure; none when empty, as papers have their captions.
        dpi: dots per inch of a .png, 160 when None.
        overrides: texts such as ``limits.margin=0.3 N``, put over the file of a problem.

    Raises:
        InputError: no such figure, source or font; a source without a plan where it takes one; sizes that are none;
            dots per inch of a file that has none, or too many.
        OutputError: it cannot be written.

    Example:
        >>> figure("margin", "tripod", "margin.pdf", width_mm=84, font="serif")  # doctest: +SKIP
        PosixPath('margin.pdf')
    """
    chosen, place = figure_of(what), path_of(path, "path")
    picture_suffix(place, "path")
    paper = Paper(width_mm, height_mm, font, font_size, title, dpi)
    paper.refuse_dpi(place)
    subject = subject_of(source, (overrides,) if isinstance(overrides, str) else overrides)
    if chosen.of_plan:
        subject = subject.answered(_planned)
    written_at("path", place, lambda: chosen.draw(subject, place, paper, lambda size, done, of: None))
    return place


def _planned(problem: Problem) -> Outcome:
    return planned(problem.grasp, problem.task)
