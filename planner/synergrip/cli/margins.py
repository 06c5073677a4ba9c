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
    picture_place,
    placed,
    show,
    shown_anyway,
    writing,
)

if TYPE_CHECKING:
    from synergrip.margin.direct_number import DirectNumber
    from synergrip.margin.margins import Margins


def margins(
    problem: ProblemArgument,
    form: FormatOption = Format.TEXT,
    overrides: SetOption = None,
    only: Annotated[
        list[str] | None,
        typer.Option(
            "--only", metavar="NAME", help="A number such as heaviest_kg, disturbance or quality; may be repeated."
        ),
    ] = None,
    direction: Annotated[
        list[str] | None,
        typer.Option(
            "--direction",
            metavar="'FX FY FZ MX MY MZ'",
            help="An extra wrench along which to say how much is withstood; may be repeated.",
        ),
    ] = None,
    box: Annotated[
        str | None,
        typer.Option("--box", metavar="'FX FY FZ MX MY MZ'", help="Half-widths [N, N m] of a box of extra wrenches."),
    ] = None,
    picture: Annotated[
        Path | None,
        typer.Option("--picture", metavar="FILE", help="Draw margins over time and in the cones: .svg, .png, .pdf."),
    ] = None,
) -> None:
    """Say how far every contact is from slipping, and how heavy, slippery, hard, fast and far the task may get."""
    with answering(form):
        from synergrip.margin.margins import Margins
        from synergrip.margin.margins import margins as found_by
        from synergrip.problems.problem import load_problem
        from synergrip.reports.data.json_margins import margins_document
        from synergrip.reports.text.text_margins import margins_text

        loaded = load_problem(problem, overrides or [])
        picture_place(picture)
        with placed(loaded), heard():
            found = found_by(
                loaded.grasp, loaded.task, only=tuple(only or ()), heard=_tell,
                directions=[six("--direction", text) for text in direction] if direction else None,
                box=None if box is None else six("--box", box),
            )  # fmt: skip
        if not isinstance(found, Margins):
            end_without_plan(form, loaded, found)
        told, drawn = margins_document(loaded.title, found, loaded.notes), list[str]()

        def text() -> str:
            return "\n".join([margins_text(loaded, found, color()), *(f"\nwrote {name}" for name in drawn)])

        with shown_anyway(form, text, lambda: told):
            if picture:
                _draw(found, loaded.title, picture)
                drawn.append(str(picture))
        show(form, text, lambda: told | ({"picture": str(picture)} if picture else {}))
    raise typer.Exit(130 if found.interrupted else 0)


def _draw(found: Margins, title: str, picture: Path) -> None:
    from synergrip.reports.pictures.margins_picture import draw_margins

    with writing("--picture", picture):
        draw_margins(found, title, picture)
    ending.keep(picture)


def six(option: str, text: str) -> list[float]:
    """Return the numbers of an option, told as mistakes by its name."""
    from synergrip.errors import InputError

    try:
        found = [float(part) for part in text.replace(",", " ").split()]
    except ValueError:
        found = []
    if len(found) != 6:
        wanted = "6 numbers, 3 forces and 3 moments, such as '0 0 -1 0 0 0'"
        raise InputError.at(option, f"expected {wanted}; got '{text}'")
    return found


def _tell(number: DirectNumber) -> None:
    if sys.stderr.isatty():
        print(f"found    {number.name}", file=sys.stderr, flush=True)
