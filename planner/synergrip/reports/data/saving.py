"""An answer handed out from code: the files and the picture that the command line makes, and its errors."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from synergrip.documents.source import Source
from synergrip.errors import InputError, OutputError, kind_of, one_of
from synergrip.files import IMPOSSIBLE
from synergrip.planning.answer import FORMATS
from synergrip.planning.outcome import Outcome, Plan
from synergrip.planning.provenance import Asked
from synergrip.reports.data.json_plan import outcome_document
from synergrip.reports.data.plan_files import csv_of, write_outcome

if TYPE_CHECKING:
    from synergrip.margin.found import Margins
    from synergrip.reports.data.viewer import Viewer

T = TypeVar("T")


def save(outcome: Outcome, folder: str | Path, formats: Sequence[str], problem: Asked | None) -> tuple[Path, ...]:
    """Write an answer; see `Answer.save`."""
    place, chosen = path_of(folder, "folder"), _formats(formats)
    title, notes, source = (outcome.grasp.title, (), None) if problem is None else _told(problem)
    document = outcome_document(title, outcome.grasp, outcome, notes, source)
    written = written_at("folder", place, lambda: write_outcome(place, document, outcome, chosen))
    return tuple(place / name for name in written)


def report(outcome: Outcome, path: str | Path, problem: Asked | None, margins: Margins | None = None) -> Path:
    """Write the report of an answer; see `Answer.report`."""
    from synergrip.reports.data.json_margins import margins_document
    from synergrip.reports.data.saved_margins import KnownMargins
    from synergrip.reports.html.page import write_report

    place, same = path_of(path, "path"), None if margins is None else _of_this(outcome, margins)
    title, notes, source = (outcome.grasp.title, (), None) if problem is None else _told(problem)
    known = None if same is None else KnownMargins.of(same, margins_document(title, same, notes, source))
    document = outcome_document(title, outcome.grasp, outcome, notes, source)
    written_at(
        "path", place, lambda: write_report(place, document, csv_of(outcome), beside=place.parent, margins=known)
    )
    return place


def _of_this(outcome: Outcome, margins: object) -> Margins:
    """Return margins, or refuse those of another answer."""
    from synergrip.margin.found import Margins

    if not isinstance(margins, Margins):
        raise InputError.at("margins", f"expected what margins(grasp, task) returns, got {kind_of(margins)}")
    if not (isinstance(outcome, Plan) and _alike(outcome, margins.plan)):
        raise InputError.at("margins", "are of another plan; give those of the grasp and the task of this answer")
    return margins


def _alike(one: Plan, other: Plan) -> bool:
    return np.array_equal(one.dz_r, other.dz_r) and np.array_equal(one.margins, other.margins)


def draw(plan: Plan, path: str | Path, title: str) -> Path:
    """Draw a plan; see `Tabled.draw`."""
    from synergrip.reports.pictures.plan_picture import draw_plan
    from synergrip.reports.pictures.sheet import picture_suffix

    if not isinstance(title, str):
        raise InputError.at("title", f"expected a text, got {kind_of(title)}")
    place = path_of(path, "path")
    picture_suffix(place, "path")
    written_at("path", place, lambda: draw_plan(plan, title or plan.grasp.title, place))
    return place


def notebook(plan: Plan) -> str:
    """Return a plan as a notebook shows it; see `Tabled`."""
    from synergrip.reports.html.notebook import plan_html

    return plan_html(plan)


def viewer(outcome: Outcome, height: int) -> Viewer:
    """Return the 3-D view of an answer; see `Answer.viewer`."""
    from synergrip.reports.data.viewer import viewer_of
    from synergrip.reports.view.planned import scene_of

    document = outcome_document(outcome.grasp.title, outcome.grasp, outcome)
    return viewer_of(scene_of(document), height)


def _told(problem: Asked) -> tuple[str, Sequence[str], Source | None]:
    if not (hasattr(problem, "notes") and hasattr(problem, "source")):
        raise InputError.at("problem", f"expected what load_problem returns, got {kind_of(problem)}")
    return problem.title, problem.notes, problem.source


def path_of(value: object, argument: str) -> Path:
    """Return the path that an argument, "folder" or "path", names."""
    if not isinstance(value, str | PathLike) or not fspath(value) or "\0" in str(value):
        raise InputError.at(argument, f"expected the path of a {'folder' if argument == 'folder' else 'file'}, such as "
                            f"'out/ball{'' if argument == 'folder' else '.svg'}', got {value!r}")  # fmt: skip
    return Path(value)


def _formats(formats: object) -> tuple[str, ...]:
    words = (formats,) if isinstance(formats, str) else formats
    if not isinstance(words, Sequence) or not words:
        raise InputError.at("formats", f"expected some of {', '.join(FORMATS)}, got {formats!r}")
    for word in words:
        if word not in FORMATS:
            raise InputError.at("formats", one_of(word, FORMATS))
    return tuple(words)


def written_at(argument: str, path: Path, write: Callable[[], T]) -> T:
    """Return what `write` does; what the file system refuses becomes an error at an argument."""
    try:
        return write()
    except OSError as error:
        message = f"cannot write '{path}': {error.strerror or error}"
        if error.errno in IMPOSSIBLE:
            raise InputError.at(argument, message) from None
        raise OutputError(message, argument) from None
