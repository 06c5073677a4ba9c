"""``synergrip plan``: the main job."""

from __future__ import annotations

import signal
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from synergrip.cli import ending
from synergrip.cli.beside import aside
from synergrip.cli.loading import load_planned
from synergrip.cli.progress import tell_what_takes_long, telling
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
    placed,
    possible,
    show,
    shown_anyway,
    writing,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from synergrip.planning.outcome import Outcome
    from synergrip.planning.solvers import Answerer
    from synergrip.problems.problem import Problem
    from synergrip.reports.data.saved_margins import KnownMargins

SOLVER = "clarabel"


def plan(
    problem: ProblemArgument,
    form: FormatOption = Format.TEXT,
    overrides: SetOption = None,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="DIR", help="Where files go (default out/PROBLEM).")
    ] = None,
    solver: Annotated[
        str, typer.Option("--solver", help="clarabel, or cvxpy: an independent formulation at the start posture.")
    ] = SOLVER,
    save_program: Annotated[
        Path | None, typer.Option("--save-program", metavar="FILE", help="Save the exact final program (.npz).")
    ] = None,
    exact: Annotated[
        bool, typer.Option("--exact", help="Prove a no again in fractions; proof.json is for anybody to check.")
    ] = False,
    picture: Annotated[
        Path | None, typer.Option("--picture", metavar="FILE", help="Draw the plan over time: .svg, .png or .pdf.")
    ] = None,
    report: Annotated[
        bool, typer.Option("--report", help="Also write report.html: playback, charts, tables; it opens offline.")
    ] = False,
    margins: Annotated[
        bool,
        typer.Option(
            "--margins",
            help="Also write margins.json, and into the report how far the task may go and what would help: takes as "
            "long as 10 to 30 plans.",
        ),
    ] = False,
    pyramids: Annotated[
        int | None,
        typer.Option(metavar="FACETS", help="Also say what inscribed friction pyramids cost; never for the verdict."),
    ] = None,
    qp_solver: Annotated[
        str | None, typer.Option(metavar="NAME", help="With --pyramids: any solver that qpsolvers finds (osqp).")
    ] = None,
    details: DetailsOption = False,
) -> None:
    """Plan a problem, verify the answer, write it; when there is no plan, prove it and say why."""
    with answering(form):
        loaded, planned = load_planned(problem, overrides)  # what is wrong with it is told before the slow imports

        from synergrip.cli.exact import proven
        from synergrip.cli.pyramids import asked, compared
        from synergrip.cli.with_margins import margins_beside, margins_told
        from synergrip.files import refuse_unwritable
        from synergrip.planning.answer import FORMATS
        from synergrip.planning.planning import plan as make
        from synergrip.planning.solvers import answerer
        from synergrip.reports.data.json_plan import outcome_document
        from synergrip.reports.data.plan_files import refuse_place, write_outcome
        from synergrip.reports.text.text_plan import outcome_text
        from synergrip.signals import held_back

        picture_place(picture)
        if report:
            from synergrip.reports.html.page import refuse_without_libraries

            refuse_without_libraries()
        answers, request = telling(answerer(solver)), asked(pyramids, qp_solver)
        tell_what_takes_long()
        folder, drawn = output or Path("out") / loaded.name, ""
        written: list[str] | None = None
        possible("--output", folder, refuse_place)
        if save_program:
            possible("--save-program", save_program, refuse_unwritable)

        def text() -> str:
            return outcome_text(loaded, outcome, folder, written, color(), details=details) + told + cost + drawn

        with shown_anyway(form, text, lambda: document):
            with held_back(signal.SIGINT):  # a plan that is found is written before an interrupt is heard
                outcome = planned if planned and solver == SOLVER else found_by(make, loaded, answers)
                _explained(outcome)
                document = outcome_document(loaded.title, loaded.grasp, outcome, loaded.notes, loaded.source)
                cost = compared(outcome, request, document)
                told, proof = proven(outcome, document) if exact else ("", None)
                found = margins_beside(outcome, loaded) if margins else None
                with writing("--output", folder):
                    known, more = margins_told(loaded, found)
                    seen = _page(document, outcome, folder, known) if report else None
                    formats = loaded.file.output.write or FORMATS
                    written = write_outcome(folder, document, outcome, formats, proof, seen, more)
                ending.keep(*(folder / name for name in written))
            if save_program:
                with writing("--save-program", save_program):
                    _save(outcome, save_program)
            if picture and _drawn(outcome, loaded.title, picture):
                document["picture"], drawn = str(picture), f"\nwrote {picture}"
        show(form, text, lambda: document)
    raise typer.Exit(document["exit_code"])


def _explained(outcome: Outcome) -> None:
    """Work out why there is no plan, which an interrupt ends with what is found by then."""
    from synergrip.planning.outcome import Plan

    if not isinstance(outcome, Plan):
        with heard():
            _ = outcome.explanation


def found_by(make: Callable[..., Outcome], problem: Problem, answers: Answerer) -> Outcome:
    """Plan; an interrupt keeps what the goals so far have led to."""
    with placed(problem), heard():
        return make(problem.grasp, problem.task, answers)


def _page(document: dict[str, Any], outcome: Outcome, folder: Path, known: KnownMargins | None) -> str:
    from synergrip.reports.data.plan_files import csv_of
    from synergrip.reports.html.page import report_text

    return report_text(document, csv_of(outcome), folder, folder, known)


def _save(outcome: Outcome, path: Path) -> None:
    """Save the program that the answer rests on: the plan's, or that of the proof."""
    from synergrip.planning.outcome import Infeasible

    program = outcome.program if isinstance(outcome, Infeasible) else outcome.decisions[-1].program
    if program is None:
        aside(f"no program was solved, so '{path}' was not written")
    else:
        program.save(path)
        ending.keep(path)


def _drawn(outcome: Outcome, title: str, picture: Path) -> bool:
    """Draw a plan; say so when there is none."""
    from synergrip.planning.outcome import Plan
    from synergrip.reports.pictures.plan_picture import draw_plan

    if not isinstance(outcome, Plan):
        aside(f"there is no plan, so '{picture}' was not drawn")
        return False
    draw_at(picture, lambda path: draw_plan(outcome, title, path))
    return True
