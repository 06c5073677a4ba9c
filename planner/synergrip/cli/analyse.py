"""``synergrip analyse``: Theorem 1 accounting of a grasp."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from synergrip.cli import ending
from synergrip.cli.beside import aside
from synergrip.cli.loading import load_placed
from synergrip.cli.running import (
    Format,
    FormatOption,
    ProblemArgument,
    SetOption,
    answering,
    color,
    picture_place,
    placed,
    show,
    shown_anyway,
    writing,
)

if TYPE_CHECKING:
    from synergrip.errors import NotRestrainedError
    from synergrip.problems.problem import Problem
    from synergrip.statics.analysis import Analysis
    from synergrip.statics.dimensions import DimensionColumn
    from synergrip.statics.grasp_properties import GraspProperties

    Columns = tuple[DimensionColumn, DimensionColumn]
    Asked = tuple[Columns | None, GraspProperties | None]


def analyse(
    problem: ProblemArgument,
    form: FormatOption = Format.TEXT,
    overrides: SetOption = None,
    picture: Annotated[
        Path | None,
        typer.Option("--picture", metavar="FILE", help="Draw what each synergy does, into .svg, .png or .pdf."),
    ] = None,
    table: Annotated[
        bool,
        typer.Option("--table", help="Show the dimensions with the first 1, 2, ... synergies instead, hard and soft."),
    ] = False,
    quality: Annotated[
        bool,
        typer.Option(
            "--quality", help="Show what textbooks name instead: classes, squeezes, stiffness, manipulability."
        ),
    ] = False,
) -> None:
    """Show what the synergies control: internal forces, rigid motions, redundancy. Nothing is optimised."""
    with answering(form):
        from synergrip.errors import NotRestrainedError
        from synergrip.statics.analysis import analyse as work_out
        from synergrip.statics.dimensions import dimension_table
        from synergrip.statics.grasp_properties import grasp_properties

        picture_place(picture)
        loaded = load_placed(problem, overrides)
        found: Analysis | NotRestrainedError
        with placed(loaded):
            try:
                found = work_out(loaded.grasp, loaded.timed.wrench)
            except NotRestrainedError as refusal:
                found = refusal
            asked = (dimension_table(loaded.grasp) if table else None,
                     grasp_properties(loaded.grasp) if quality else None)  # fmt: skip
            written = None
            with shown_anyway(form, lambda: _text(loaded, found, asked, None),
                              lambda: _document(loaded, found, asked)):  # fmt: skip
                written = _drawn(loaded, found, picture) if picture else None
            show(form, lambda: _text(loaded, found, asked, written),
                 lambda: _document(loaded, found, asked) | ({"picture": written} if picture else {}))  # fmt: skip
    raise typer.Exit(found.exit_code if isinstance(found, NotRestrainedError) else 0)


def _text(problem: Problem, found: Analysis | NotRestrainedError, asked: Asked, written: str | None) -> str:
    from synergrip.errors import NotRestrainedError
    from synergrip.reports.text.tables import wrapped
    from synergrip.reports.text.text_analysis import analysis_text
    from synergrip.reports.text.text_check import refused_text
    from synergrip.reports.text.text_dimensions import dimensions_text
    from synergrip.reports.text.text_problem import problem_lines
    from synergrip.reports.text.text_properties import properties_text

    columns, properties = asked
    if isinstance(found, NotRestrainedError):
        parts = [refused_text(problem, found, color())]
    elif columns is not None or properties is not None:
        parts = ["\n".join(problem_lines(problem))]
    else:
        parts = [analysis_text(problem, found, color())]
    if columns is not None:
        parts.append(dimensions_text(columns, problem.grasp.synergies))
    if properties is not None:
        parts.append(properties_text(properties))
    if problem.notes:
        parts.append("\n".join(line for note in problem.notes for line in wrapped("note     ", note)))
    if written is not None:
        parts.append(f"wrote {written}")
    return "\n\n".join(parts)


def _document(problem: Problem, found: Analysis | NotRestrainedError, asked: Asked) -> dict[str, Any]:
    from synergrip.errors import NotRestrainedError
    from synergrip.reports.data.json_analysis import analysis_document, unrestrained_document
    from synergrip.reports.data.json_properties import properties_document
    from synergrip.reports.text.text_dimensions import dimensions_document

    columns, properties = asked
    if isinstance(found, NotRestrainedError):
        document = unrestrained_document(problem.grasp, found)
    else:
        document = analysis_document(found)
    if problem.notes:
        document["notes"] = [*document.get("notes", ()), *problem.notes]
    more = {} if columns is None else {"table": dimensions_document(columns, problem.grasp.n_z)}
    return document | more | ({} if properties is None else {"properties": properties_document(properties)})


def _drawn(problem: Problem, found: Analysis | NotRestrainedError, picture: Path) -> str | None:
    """Draw and return what was written, if anything; what cannot be drawn or written is bad input."""
    from synergrip.errors import InputError, NotRestrainedError
    from synergrip.reports.pictures.grasp_synergies import draw_grasp_synergies

    if isinstance(found, NotRestrainedError):
        aside(f"the object is not restrained, so '{picture}' was not drawn")
        return None
    with writing("--picture", picture):
        try:
            draw_grasp_synergies(problem, found, picture)
        except InputError as error:
            raise error.under("--picture") from None
    ending.keep(picture)
    return str(picture)
