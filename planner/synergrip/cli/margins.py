"""``synergrip margins``: how sure a grasp is, and how heavy, slippery, hard, fast and far it may get."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from synergrip.cli import ending
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
    possible,
    show,
    shown_anyway,
)

if TYPE_CHECKING:
    from synergrip.margin.direct_number import DirectNumber
    from synergrip.margin.timing.fastest_timing import FastestTiming

TIMED = "palm.csv"
"""The file of the fastest timing, in the folder that is asked for."""


def margins(
    problem: ProblemArgument,
    form: FormatOption = Format.TEXT,
    overrides: SetOption = None,
    only: Annotated[
        list[str] | None,
        typer.Option("--only", metavar="NAME", help="A number such as heaviest_kg; may be repeated."),
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", metavar="DIR", help=f"Where {TIMED} of --only fastest_timing_s goes."),
    ] = None,
) -> None:
    """Say how far every contact is from slipping, and how heavy, slippery, hard, fast and far the task may get."""
    with answering(form):
        from synergrip.files import refuse_unwritable
        from synergrip.margin.margins import Margins
        from synergrip.margin.margins import margins as found_by
        from synergrip.problems.problem import load_problem
        from synergrip.reports.data.json_margins import margins_document
        from synergrip.reports.text.text_margins import margins_text

        loaded = load_problem(problem, overrides or [])
        place = None if output is None else output / TIMED
        if place is not None:
            possible("--output", place, refuse_unwritable)
        with placed(loaded), heard():
            found = found_by(loaded.grasp, loaded.task, only=tuple(only or ()), heard=_tell)
        if not isinstance(found, Margins):
            end_without_plan(form, loaded, found)
        told = margins_document(loaded.title, found, loaded.notes)
        written: list[Path] = []

        def text() -> str:
            return margins_text(loaded, found, color(), *written)

        if place is not None and found.timing is not None and found.timing.path is not None:
            with shown_anyway(form, text, lambda: told):
                written.append(found.timing.write(place))
                ending.keep(place)
        show(form, text, lambda: told)
    raise typer.Exit(130 if found.interrupted else 0)


def _tell(number: DirectNumber | FastestTiming) -> None:
    if sys.stderr.isatty():
        print(f"found    {number.name}", file=sys.stderr, flush=True)
