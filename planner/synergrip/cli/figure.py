"""``synergrip figure``: a picture for a paper."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from synergrip.cli import ending
from synergrip.cli.loading import is_unplaced, load_placed
from synergrip.cli.progress import counted, tell_what_takes_long, telling
from synergrip.cli.running import (
    Format,
    FormatOption,
    SetOption,
    answering,
    end_without_plan,
    heard,
    possible,
    show,
    writing,
)

if TYPE_CHECKING:
    from synergrip.problems.problem import Problem
    from synergrip.reports.figures.subject import Subject

FIGURES = "margin, cones, overview, synergies or needed"
OPTIONS = {
    "what": "WHAT", "path": "--output", "width_mm": "--width", "height_mm": "--height", "font": "--font",
    "font_size": "--font-size", "dpi": "--dpi",
}  # fmt: skip
"""Arguments of the library, and how they are called here."""


def figure(
    what: Annotated[str, typer.Argument(metavar="WHAT", help=f"{FIGURES}.")],
    source: Annotated[
        str, typer.Argument(metavar="SOURCE", help="A problem, its file or bundled name; or a saved plan's folder.")
    ],
    output: Annotated[Path, typer.Option("-o", "--output", metavar="FILE", help="Into .svg, .pdf or .png.")],
    form: FormatOption = Format.TEXT,
    width: Annotated[float | None, typer.Option("--width", metavar="MM", help="On paper, in mm.")] = None,
    height: Annotated[
        float | None, typer.Option("--height", metavar="MM", help="On paper, in mm; of margin, overview and needed.")
    ] = None,
    font: Annotated[
        str, typer.Option("--font", metavar="NAME", help="An installed font, or serif, sans-serif, monospace.")
    ] = "",
    font_size: Annotated[float, typer.Option("--font-size", metavar="PT", help="Of axis labels, in points.")] = 8.0,
    title: Annotated[str, typer.Option("--title", help="Above the figure; none without it.")] = "",
    dpi: Annotated[float | None, typer.Option("--dpi", metavar="DOTS", help="Of a .png, dots per inch (160).")] = None,
    overrides: SetOption = None,
) -> None:
    """Draw a figure for a paper, and print a caption for it. A saved plan is not planned again."""
    with answering(form), _of_options():
        from synergrip.errors import InputError
        from synergrip.files import refuse_unwritable
        from synergrip.reports.figures.figure import figure_of
        from synergrip.reports.figures.subject import subject_of
        from synergrip.reports.pictures.paper import Paper
        from synergrip.reports.pictures.sheet import picture_suffix

        chosen, paper = figure_of(what), Paper(width, height, font, font_size, title, dpi)
        picture_suffix(output, "path")
        paper.refuse_dpi(output)
        possible("--output", output, refuse_unwritable)
        try:
            subject = subject_of(source, overrides or [])
        except InputError as error:
            if not is_unplaced(error):
                raise
            subject = subject_of(load_placed(source, overrides))
        if chosen.of_plan:
            subject = _answered(subject, form)

        def told_of(size: int, done: int, of: int) -> None:
            counted(done, of, f"subsets of {size}")

        with heard(), writing("--output", output):
            caption = chosen.draw(subject, output, paper, told_of)
        ending.keep(output)
        told: dict[str, Any] = {"figure": what, "file": str(output), "caption": caption, "exit_code": 0}
        show(form, lambda: f"caption  {caption}\n\nwrote {output}", lambda: told)


def _answered(subject: Subject, form: Format) -> Subject:
    """Return the subject with a plan, made where there is none; without one this ends here."""
    from synergrip.cli.plan import found_by
    from synergrip.planning.outcome import Outcome, Plan
    from synergrip.planning.planning import plan
    from synergrip.planning.solvers import answerer

    def planned(problem: Problem) -> Outcome:
        tell_what_takes_long()
        outcome = found_by(plan, problem, telling(answerer("clarabel")))
        if not isinstance(outcome, Plan):
            end_without_plan(form, problem, outcome)
        if outcome.interrupted:  # of a plan that not all goals have led to there is no figure
            raise KeyboardInterrupt
        return outcome

    return subject.answered(planned)


@contextmanager
def _of_options() -> Iterator[None]:
    """Let errors name the option where the library names its argument."""
    from synergrip.errors import InputError

    try:
        yield
    except InputError as error:
        raise error.located(lambda issue: replace(issue, key=OPTIONS.get(issue.key, issue.key))) from None
