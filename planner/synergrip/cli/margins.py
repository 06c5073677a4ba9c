"""``synergrip margins``: how sure a grasp is, and how heavy, slippery, hard, fast and far it may get."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from synergrip.cli import ending
from synergrip.cli.beside import tell
from synergrip.cli.loading import load_placed
from synergrip.cli.running import (
    Format,
    FormatOption,
    ProblemArgument,
    SetOption,
    answering,
    color,
    draw_at,
    end_without_plan,
    heard,
    picture_place,
    placed,
    possible,
    show,
    shown_anyway,
)

if TYPE_CHECKING:
    from synergrip.margin.direct_number import DirectNumber
    from synergrip.margin.found import Margins
    from synergrip.margin.timing.fastest_timing import FastestTiming

ASKED = (
    "critical_friction_scale, heaviest_kg, load_factor, least_peak_N, least_effort, shortest_duration_s, "
    "largest_amplitude, disturbance, quality, sensitivities, critical_friction_per_contact, "
    "largest_amplitude_per_mode, fastest_timing_s"
)
TIMED = "palm.csv"
"""The file of the fastest timing, in the folder that is asked for."""


def margins(
    problem: ProblemArgument,
    form: FormatOption = Format.TEXT,
    overrides: SetOption = None,
    only: Annotated[
        list[str] | None,
        typer.Option(
            "--only", metavar="NAME", help=f"One of {ASKED}; may be repeated. Without it, all but the last three."
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
    whole: Annotated[
        bool, typer.Option("--all", help="What every change of a number is worth, not only the three worth most.")
    ] = False,
    box: Annotated[
        str | None,
        typer.Option("--box", metavar="'FX FY FZ MX MY MZ'", help="Half-widths [N, N m] of a box of extra wrenches."),
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", metavar="DIR", help=f"Where {TIMED} of --only fastest_timing_s goes."),
    ] = None,
    picture: Annotated[
        Path | None,
        typer.Option("--picture", metavar="FILE", help="Draw margins over time and in the cones: .svg, .png, .pdf."),
    ] = None,
) -> None:
    """Say how far every contact is from slipping, and how heavy, slippery, hard, fast and far the task may get."""
    with answering(form):
        from synergrip.files import refuse_unwritable
        from synergrip.margin.found import Margins
        from synergrip.margin.margins import margins as found_by
        from synergrip.reports.data.json_margins import margins_document
        from synergrip.reports.text.text_margins import margins_text

        loaded = load_placed(problem, overrides)
        picture_place(picture)
        place = None if output is None else output / TIMED
        if place is not None:
            possible("--output", place, refuse_unwritable)
        with placed(loaded), heard():
            found = found_by(
                loaded.grasp, loaded.task, only=tuple(only or ()), heard=_tell,
                directions=[six("--direction", text) for text in direction] if direction else None,
                box=None if box is None else six("--box", box),
            )  # fmt: skip
        if not isinstance(found, Margins):
            end_without_plan(form, loaded, found)
        told, timed, drawn = margins_document(loaded.title, found, loaded.notes), list[Path](), list[Path]()

        def text() -> str:
            said = margins_text(loaded, found, color(), whole=whole, written=next(iter(timed), None))
            return "\n".join([said, *(f"\nwrote {picture}" for picture in drawn)])

        with shown_anyway(form, text, lambda: told):
            if place is not None and found.timing is not None and found.timing.path is not None:
                timed.append(found.timing.write(place))
                ending.keep(place)
            if picture is not None:
                _draw(found, loaded.title, picture)
                drawn.append(picture)
        show(form, text, lambda: told | ({"picture": str(picture)} if drawn else {}))
    raise typer.Exit(130 if found.interrupted else 0)


def _draw(found: Margins, title: str, picture: Path) -> None:
    from synergrip.reports.pictures.margins_picture import draw_margins

    draw_at(picture, lambda path: draw_margins(found, title, path))


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


def _tell(number: DirectNumber | FastestTiming) -> None:
    if sys.stderr.isatty():
        tell(f"found    {number.name}")
