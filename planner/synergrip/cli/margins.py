"""``synergrip margins``: how sure a grasp is, and how heavy, slippery, hard, fast and far it may get."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Annotated

import typer

from synergrip.cli.running import (
    Format,
    FormatOption,
    ProblemArgument,
    SetOption,
    answering,
    color,
    end_without_plan,
    heard,
    placed,
    show,
)

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
    whole: Annotated[
        bool, typer.Option("--all", help="What every change of a number is worth, not only the three worth most.")
    ] = False,
) -> None:
    """Say how far every contact is from slipping, and how heavy, slippery, hard, fast and far the task may get."""
    with answering(form):
        from synergrip.margin.margins import Margins
        from synergrip.margin.margins import margins as found_by
        from synergrip.problems.problem import load_problem
        from synergrip.reports.data.json_margins import margins_document
        from synergrip.reports.text.text_margins import margins_text

        loaded = load_problem(problem, overrides or [])
        with placed(loaded), heard():
            found = found_by(loaded.grasp, loaded.task, only=tuple(only or ()), heard=_tell)
        if not isinstance(found, Margins):
            end_without_plan(form, loaded, found)
        told = margins_document(loaded.title, found, loaded.notes)
        show(form, lambda: margins_text(loaded, found, color(), whole=whole), lambda: told)
    raise typer.Exit(130 if found.interrupted else 0)


def _tell(number: DirectNumber) -> None:
    if sys.stderr.isatty():
        print(f"found    {number.name}", file=sys.stderr, flush=True)
