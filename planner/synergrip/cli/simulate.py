"""``synergrip simulate``: a plan played in a physics engine, beside what it promised."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from synergrip.cli import ending
from synergrip.cli.progress import shares
from synergrip.cli.running import (
    Format,
    FormatOption,
    answering,
    color,
    draw_at,
    picture_place,
    possible,
    show,
    shown_anyway,
    writing,
)


class Speed(StrEnum):
    """How fast a plan is played."""

    SLOW = "slow"
    REAL = "real"


def simulate(
    plan: Annotated[Path, typer.Argument(metavar="PLAN", help="The folder of a saved plan, or its plan.json.")],
    form: FormatOption = Format.TEXT,
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", metavar="DIR", help="Write model.xml, simulation.json and simulation.csv."),
    ] = None,
    picture: Annotated[
        Path | None, typer.Option("--picture", metavar="FILE", help="Draw it over time: .svg, .png or .pdf.")
    ] = None,
    speed: Annotated[
        Speed, typer.Option("--speed", help="slow: inertia does not count; real: as fast as the plan is.")
    ] = Speed.SLOW,
    step: Annotated[float, typer.Option(metavar="SECONDS", help="Step of the simulation.")] = 2e-4,
    friction: Annotated[float, typer.Option(metavar="FACTOR", help="What all friction is multiplied by.")] = 1.0,
    once: Annotated[
        bool,
        typer.Option(
            "--once",
            help="Play it one time, and not again at half the step, which tells what the step does. Whatever "
            'task.linearise of the plan is: there "once" is how it was planned.',
        ),
    ] = False,
) -> None:
    """Play a saved plan in MuJoCo: exit code 0 when every contact held, 3 when one slipped, crept or was lost."""
    with answering(form):
        from synergrip.reports.data.simulation_files import (
            refuse_simulation_place,
            simulation_document,
            write_simulation,
        )
        from synergrip.reports.text.text_simulation import simulation_text
        from synergrip.simulation.simulation import simulate as played

        picture_place(picture)
        if output:
            possible("--output", output, refuse_simulation_place)
        found = played(plan, speed=speed.value, step=step, friction=friction, half_step=not once, progress=shares())
        document, wrote = simulation_document(found), list[str]()

        def text() -> str:
            return simulation_text(found, color()) + "".join(f"\nwrote {name}" for name in wrote)

        with shown_anyway(form, text, lambda: document):
            if output:
                with writing("--output", output):
                    wrote += [str(output / name) for name in write_simulation(output, found)]
                ending.keep(*wrote)
            if picture:
                from synergrip.reports.pictures.simulation_picture import draw_simulation

                draw_at(picture, lambda path: draw_simulation(found, path))
                document["picture"] = str(picture)
                wrote.append(str(picture))
        show(form, text, lambda: document)
    raise typer.Exit(found.exit_code)
