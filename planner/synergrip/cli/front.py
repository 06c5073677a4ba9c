"""``synergrip front``: what a slip margin, or slippery contacts, cost in force."""

from __future__ import annotations

from enum import StrEnum
from typing import TYPE_CHECKING, Annotated

import typer

from synergrip.cli.loading import load_placed
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

if TYPE_CHECKING:
    from collections.abc import Iterator

    from synergrip.margin.friction_front import FrictionPoint
    from synergrip.margin.front import FrontPoint
    from synergrip.planning.outcome import Outcome, Plan
    from synergrip.problems.problem import Problem


class Against(StrEnum):
    """What is traded against peak force."""

    MARGIN = "margin"
    FRICTION = "friction"


def front(
    problem: ProblemArgument,
    count: Annotated[int, typer.Option("-n", "--points", min=2, max=1000, help="How many points.")] = 8,
    against: Annotated[
        Against, typer.Option(help="What costs force: slip margin, up to the largest, or less and less friction.")
    ] = Against.MARGIN,
    form: FormatOption = Format.TEXT,
    overrides: SetOption = None,
) -> None:
    """Trade slip margin, or friction, against peak force: the least peak normal force for each (Pareto front)."""
    with answering(form):
        from synergrip.planning.outcome import Plan
        from synergrip.reports.text.front_report import front_document, front_text

        loaded = load_placed(problem, overrides)
        with placed(loaded), heard():
            best = _best(loaded, against)
        if not isinstance(best, Plan):
            end_without_plan(form, loaded, best)
        points: list[FrontPoint | FrictionPoint] = []
        interrupted = best.interrupted
        try:
            with heard():
                for point in _points(loaded, best, against, count) if not interrupted else ():
                    points.append(point)  # one by one, so that an interrupt keeps the finished ones
                    counted(len(points), count, "points")
        except KeyboardInterrupt:
            interrupted = True
        show(form, lambda: front_text(loaded, points, interrupted), lambda: front_document(points, interrupted))
    raise typer.Exit(130 if interrupted else 0)


def _best(loaded: Problem, against: Against) -> Outcome:
    """Return the plan at the end of the front from which the others follow, or why there is none."""
    from synergrip.margin.friction_front import least_peak
    from synergrip.margin.front import largest
    from synergrip.planning.solvers import SOLVERS

    if against is Against.FRICTION:
        return least_peak(loaded.grasp, loaded.task)
    return largest(loaded.grasp, loaded.timed, telling(SOLVERS["clarabel"]))


def _points(loaded: Problem, best: Plan, against: Against, count: int) -> Iterator[FrontPoint | FrictionPoint]:
    from synergrip.margin.friction_front import friction_front
    from synergrip.margin.front import front as points_of
    from synergrip.planning.solvers import SOLVERS

    if against is Against.FRICTION:
        return friction_front(best, loaded.task, count)
    return points_of(best, count, telling(SOLVERS["clarabel"]))
