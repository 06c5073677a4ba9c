"""``synergrip front``: what a slip margin costs in force."""

from __future__ import annotations

from typing import Annotated

import typer

from synergrip.cli.progress import counted, telling
from synergrip.cli.running import (
    Format,
    FormatOption,
    ProblemArgument,
    SetOption,
    answering,
    end_without_plan,
    heard,
    placed,
    show,
)


def front(
    problem: ProblemArgument,
    count: Annotated[int, typer.Option("-n", "--points", min=2, max=1000, help="How many points.")] = 8,
    form: FormatOption = Format.TEXT,
    overrides: SetOption = None,
) -> None:
    """Trade slip margin against peak force: the least peak for each margin, up to the largest (Pareto front)."""
    with answering(form):
        from synergrip.margin.front import front as points_of
        from synergrip.margin.front import largest
        from synergrip.planning.outcome import Plan
        from synergrip.planning.solvers import SOLVERS
        from synergrip.problems.problem import load_problem
        from synergrip.reports.text.front_report import front_document, front_text

        solver, loaded = telling(SOLVERS["clarabel"]), load_problem(problem, overrides or [])
        with placed(loaded), heard():
            best = largest(loaded.grasp, loaded.timed, solver)
        if not isinstance(best, Plan):
            end_without_plan(form, loaded, best)
        points, interrupted = [], best.interrupted
        try:
            with heard():
                for point in points_of(best, count, solver) if not interrupted else ():
                    points.append(point)  # one by one, so that an interrupt keeps the finished ones
                    counted(len(points), count, "points")
        except KeyboardInterrupt:
            interrupted = True
        show(form, lambda: front_text(loaded, points, interrupted), lambda: front_document(points, interrupted))
    raise typer.Exit(130 if interrupted else 0)
