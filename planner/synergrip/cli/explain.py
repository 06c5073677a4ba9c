"""``synergrip explain``: why a problem has no plan, and what would give it one."""

from __future__ import annotations

import signal
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from synergrip.cli import ending
from synergrip.cli.beside import aside, tell
from synergrip.cli.loading import load_placed
from synergrip.cli.progress import PATIENCE, tell_what_takes_long, telling
from synergrip.cli.running import (
    DetailsOption,
    Format,
    FormatOption,
    ProblemArgument,
    SetOption,
    answering,
    color,
    draw_at,
    heard,
    picture_place,
    possible,
    show,
    shown_anyway,
    writing,
)

if TYPE_CHECKING:
    from synergrip.explain.explanation import Explanation
    from synergrip.explain.repairs import Repair
    from synergrip.planning.outcome import Infeasible, Unknown


def explain(
    problem: ProblemArgument,
    form: FormatOption = Format.TEXT,
    overrides: SetOption = None,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="DIR", help="Where explain.json goes (out/PROBLEM).")
    ] = None,
    picture: Annotated[
        Path | None, typer.Option("--picture", metavar="FILE", help="Draw what is missing over time: .svg, .png, .pdf.")
    ] = None,
    details: DetailsOption = False,
) -> None:
    """Say why there is no plan, when, what clashes, and which changes of one number give one, each planned again."""
    with answering(form):
        loaded = load_placed(problem, overrides)

        from synergrip.cli.plan import found_by
        from synergrip.planning.outcome import Plan
        from synergrip.planning.planning import plan as make
        from synergrip.planning.solvers import SOLVERS
        from synergrip.reports.data.explain_files import refuse_explanation_place, write_explanation
        from synergrip.reports.data.json_plan import outcome_document
        from synergrip.reports.text.text_plan import explanation_text
        from synergrip.signals import held_back

        picture_place(picture)
        tell_what_takes_long()
        folder, wrote = output or Path("out") / loaded.name, list[str]()
        possible("--output", folder, refuse_explanation_place)
        with held_back(signal.SIGINT):
            outcome = found_by(make, loaded, telling(SOLVERS["clarabel"]))
            known = None if isinstance(outcome, Plan) else _explained(outcome)
            document = outcome_document(loaded.title, loaded.grasp, outcome, loaded.notes, loaded.source, known)

        def text() -> str:
            said = explanation_text(loaded, outcome, known, color(), details=details)
            return "\n".join([said, "", *(f"wrote {name}" for name in wrote)])

        with shown_anyway(form, text, lambda: document):
            with writing("--output", folder):
                wrote.append(str(write_explanation(folder, document)))
            ending.keep(*map(Path, wrote))
            if picture and _drawn(known, loaded.title, picture):
                wrote.append(str(picture))
        show(form, text, lambda: document)
    raise typer.Exit(document["exit_code"])


def _explained(no: Infeasible | Unknown) -> Explanation:
    """Return all that is known of a no; an interrupt keeps what is found."""
    begun = time.monotonic()

    def heard_of(repair: Repair) -> None:
        if not (sys.stderr.isatty() or time.monotonic() - begun > PATIENCE):
            return
        said = "a plan" if repair.verified else "no plan"
        tell(f"planned  with {repair.set}: {said}")

    with heard():
        return no.explain(heard=heard_of)


def _drawn(known: Explanation | None, title: str, picture: Path) -> bool:
    """Draw what is missing over time; say so when there is nothing to draw."""
    from synergrip.explain.compromise import compromise
    from synergrip.reports.pictures.no_picture import draw_no

    least = None if known is None or known.posed is None else compromise(known.posed)
    if known is None or least is None:
        aside(f"nothing is missing that could be drawn over time, so '{picture}' was not drawn")
        return False
    draw_at(picture, lambda path: draw_no(known, least, title, path))
    return True
