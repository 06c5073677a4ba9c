"""``synergrip analyse``: Theorem 1 accounting of a grasp."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from synergrip.cli.running import Format, FormatOption, ProblemArgument, SetOption, answering, color, show

if TYPE_CHECKING:
    from synergrip.plans.analysis import Analysis
    from synergrip.plans.problem import Problem


def analyse(
    problem: ProblemArgument,
    form: FormatOption = Format.TEXT,
    overrides: SetOption = None,
    picture: Annotated[
        Path | None,
        typer.Option("--picture", metavar="FILE", help="Draw what each synergy does, into .svg, .png or .pdf."),
    ] = None,
    table: Annotated[
        bool, typer.Option("--table", help="Add the dimensions with the first 1, 2, ... synergies, hard and soft.")
    ] = False,
) -> None:
    """Show what the synergies control: internal forces, rigid motions, redundancy. Nothing is optimised."""
    code = 0
    with answering(form):
        from synergrip.errors import NotRestrainedError, SynergripError
        from synergrip.plans.analysis import analyse as work_out
        from synergrip.plans.dimensions import dimension_table
        from synergrip.plans.problem import load_problem, located
        from synergrip.reports.json_analysis import analysis_document, unrestrained_document
        from synergrip.reports.text_analysis import analysis_text
        from synergrip.reports.text_check import refused_text
        from synergrip.reports.text_dimensions import dimensions_document, dimensions_text

        _judge_suffix(picture)
        loaded = load_problem(problem, overrides or [])
        analysis = None
        try:
            analysis = work_out(loaded.grasp, loaded.task.wrench)
            text, document = analysis_text(loaded, analysis, color()), analysis_document(analysis)
        except NotRestrainedError as refusal:
            text, document = refused_text(loaded, refusal, color()), unrestrained_document(loaded.grasp, refusal)
            code = refusal.exit_code
        except SynergripError as error:
            raise located(loaded, error) from None
        if table:
            columns = dimension_table(loaded)
            text += f"\n\n{dimensions_text(columns, loaded.grasp.synergies)}"
            document["table"] = dimensions_document(columns, loaded.grasp.n_z)
        if picture is not None:
            written = _drawn(loaded, analysis, picture)
            text += f"\n\nwrote {written}" if written else ""
            document["picture"] = written
        show(form, lambda: text, lambda: document)
    raise typer.Exit(code)


def _judge_suffix(picture: Path | None) -> None:
    """Refuse a picture whose suffix says no format before anything is done."""
    if picture is not None:
        from synergrip.reports.pictures.sheet import picture_suffix

        picture_suffix(picture, "--picture")


def _drawn(problem: Problem, analysis: Analysis | None, picture: Path) -> str | None:
    """Draw and return what was written, if anything; what cannot be drawn or written is bad input."""
    from synergrip.errors import InputError
    from synergrip.reports.pictures.grasp_synergies import draw_grasp_synergies

    if analysis is None:
        print(f"the object is not restrained, so '{picture}' was not drawn", file=sys.stderr)
        return None
    try:
        draw_grasp_synergies(problem, analysis, picture)
    except InputError as error:
        raise error.under("--picture") from None
    except OSError as error:
        raise InputError.at("--picture", f"cannot write '{picture}': {error.strerror or error}") from None
    return str(picture)
