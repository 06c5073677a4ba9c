"""``synergrip margins``: how sure a grasp is, and how heavy, slippery, hard, fast and far it may get."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Annotated

import typer

from synergrip.cli.running import Format, FormatOption, ProblemArgument, SetOption, answering, color, heard, show

if TYPE_CHECKING:
    from synergrip.margin.direct_number import DirectNumber


def margins(
    problem: ProblemArgument,
    form: FormatOption = Format.TEXT,
    overrides: SetOption = None,
    only: Annotated[
        list[str] | None,
        typer.Option("--only", metavar="NAME", help="A number such as heaviest_kg; may be repeated."),
    ] = None,
) -> None:
    """Say how far every contact is from slipping, and how heavy, slippery, hard, fast and far the task may get."""
    with answering(form):
        from synergrip.errors import SynergripError
        from synergrip.margin.margins import Margins
        from synergrip.margin.margins import margins as found_by
        from synergrip.problems.problem import load_problem, located
        from synergrip.reports.data.json_margins import margins_document
        from synergrip.reports.data.json_plan import outcome_document
        from synergrip.reports.text.text_margins import margins_text
        from synergrip.reports.text.text_plan import verdict_lines

        loaded = load_problem(problem, overrides or [])
        try:
            with heard():
                found = found_by(loaded.grasp, loaded.task, only=tuple(only or ()), heard=_tell)
        except SynergripError as error:
            raise located(loaded, error) from None
        if not isinstance(found, Margins):
            document = outcome_document(loaded.title, loaded.grasp, found, loaded.notes, loaded.source)
            show(form, lambda: "\n".join(verdict_lines(loaded, found, color())), lambda: document)
            raise typer.Exit(found.exit_code)
        told = margins_document(loaded.title, found, loaded.notes)
        show(form, lambda: margins_text(loaded, found, color()), lambda: told)
    raise typer.Exit(130 if found.interrupted else 0)


def _tell(number: DirectNumber) -> None:
    if sys.stderr.isatty():
        print(f"found    {number.name}", file=sys.stderr, flush=True)
