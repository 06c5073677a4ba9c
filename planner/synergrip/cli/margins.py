"""``synergrip margins``: how sure a grasp is, and how heavy, slippery, hard, fast and far it may get."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from synergrip.cli import ending
from synergrip.cli.beside import aside, tell
from synergrip.cli.loading import load_placed
from synergrip.cli.running import (
    Format,
    FormatOption,
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
    writing,
)

if TYPE_CHECKING:
    from synergrip.margin.direct_number import DirectNumber
    from synergrip.margin.found import Margins
    from synergrip.margin.timing.fastest_timing import FastestTiming
    from synergrip.planning.outcome import Plan
    from synergrip.problems.problem import Problem

ASKED = (
    "critical_friction_scale, heaviest_kg, load_factor, least_peak_N, least_effort, shortest_duration_s, "
    "largest_amplitude, disturbance, quality, sensitivities, critical_friction_per_contact, "
    "largest_amplitude_per_mode, fastest_timing_s"
)
KEY = "PROBLEM|PLAN"


def margins(
    problem: Annotated[
        str,
        typer.Argument(
            metavar=KEY, help="A problem file or the name of a bundled problem; a saved plan or its folder."
        ),
    ],
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
        typer.Option(
            "-o",
            "--output",
            metavar="DIR",
            help="Write margins.json, for the report of the plan beside it, and palm.csv of fastest_timing_s.",
        ),
    ] = None,
    picture: Annotated[
        Path | None,
        typer.Option("--picture", metavar="FILE", help="Draw margins over time and in the cones: .svg, .png, .pdf."),
    ] = None,
) -> None:
    """Say how far every contact is from slipping, and how heavy, slippery, hard, fast and far the task may get."""
    with answering(form):
        from synergrip.margin.margins import Wishes, margins_of
        from synergrip.planning.outcome import Plan
        from synergrip.planning.planning import plan
        from synergrip.reports.data.json_margins import margins_document
        from synergrip.reports.data.margins_files import FILE, TIMED, refuse_margins_place, told_before, write_margins
        from synergrip.reports.text.text_margins import margins_text

        loaded, saved = _asked(problem, overrides)
        picture_place(picture)
        if output is not None:
            possible("--output", output, refuse_margins_place)
        with placed(loaded), heard():
            wishes = Wishes.of(
                loaded.grasp, loaded.task, only=tuple(only or ()),
                directions=[six("--direction", text) for text in direction] if direction else None,
                box=None if box is None else six("--box", box),
            )  # fmt: skip
            made = plan(loaded.grasp, loaded.task)
            if isinstance(made, Plan):
                of_saved = None if saved is None else _same(made, saved)
                found = margins_of(made, loaded.grasp, loaded.task, wishes, _tell)
        if not isinstance(made, Plan):
            end_without_plan(form, loaded, made)
        title = loaded.title if saved is None else str(saved["title"])
        told = margins_document(title, found, loaded.notes, loaded.source, of_saved)
        written, drawn = list[Path](), list[Path]()

        def text() -> str:
            said = margins_text(loaded, found, color(), whole=whole, written=_named(TIMED, written))
            files = [*(each for each in written if each.name != TIMED), *drawn]
            return "\n".join([said, *[""] * bool(files), *(f"wrote {each}" for each in files)])

        with shown_anyway(form, text, lambda: told):
            if output is not None:
                fuller = told_before(output, told)
                with writing("--output", output):
                    written += [output / name for name in write_margins(output, told, found.timing)]
                ending.keep(*written)
                _tell_of_another(output, told)
                if fuller:
                    aside(f"the '{FILE}' that was replaced had more of this plan: {', '.join(fuller)}")
            if picture is not None:
                _draw(found, loaded.title, picture)
                drawn.append(picture)
        show(form, text, lambda: told | ({"picture": str(picture)} if drawn else {}))
    raise typer.Exit(130 if found.interrupted else 0)


def _asked(name: str, overrides: list[str] | None) -> tuple[Problem, Mapping[str, Any] | None]:
    """Return the problem, and the document of the saved plan that it was read from, if that was named."""
    from synergrip.reports.html.saved_answer import read_answer, saved_file

    file = saved_file(Path(name), KEY)
    if file is None:
        return load_placed(name, overrides), None
    from synergrip.errors import InputError
    from synergrip.reports.data.saved_problem import problem_of

    if overrides:
        raise InputError.at("--set", f"'{file}' is planned already; give the problem to change it")
    document, _ = read_answer(file)
    return problem_of(document, KEY), document


def _same(made: Plan, saved: Mapping[str, Any]) -> str | None:
    """Return the digest of a saved plan, which was made again."""
    from synergrip.planning.digest import stated_digest
    from synergrip.reports.data.saved_problem import refuse_another

    refuse_another(made, saved, KEY)
    return stated_digest(saved)


def _named(name: str, written: list[Path]) -> Path | None:
    return next((each for each in written if each.name == name), None)


def _tell_of_another(folder: Path, told: Mapping[str, Any]) -> None:
    """Say that margins stand beside a plan that they are not of, whose report leaves them out."""
    from synergrip.errors import InputError
    from synergrip.planning.digest import stated_digest
    from synergrip.reports.html.saved_answer import read_answer

    file = folder / "plan.json"
    if not file.is_file():
        return
    try:
        document, _ = read_answer(file)
    except InputError:  # a report says what is wrong with it
        return
    if stated_digest(document) != told["plan_sha256"]:
        aside(f"'{file}' is of another plan, whose report leaves these margins out")


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
