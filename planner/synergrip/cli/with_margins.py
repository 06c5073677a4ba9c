"""The option ``--margins`` of ``synergrip plan``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from synergrip.cli.beside import aside
from synergrip.cli.running import heard, placed

if TYPE_CHECKING:
    from synergrip.margin.found import Margins
    from synergrip.planning.outcome import Outcome
    from synergrip.problems.problem import Problem
    from synergrip.reports.data.saved_margins import KnownMargins


def margins_beside(outcome: Outcome, problem: Problem) -> Margins | None:
    """Return the margins of a plan, those that are finished when somebody interrupts; say so where there are none."""
    from synergrip.margin.margins import Wishes, margins_of
    from synergrip.planning.outcome import Plan

    if not isinstance(outcome, Plan) or outcome.interrupted:
        why = "the plan was interrupted" if isinstance(outcome, Plan) else "there is no plan"
        aside(f"{why}, so there are no margins")
        return None
    with placed(problem), heard():
        found = margins_of(outcome, problem.grasp, problem.task, Wishes.of(problem.grasp, problem.task))
    if found.interrupted:
        aside("interrupted; the margins that are told are finished")
    return found


def margins_told(problem: Problem, found: Margins | None) -> tuple[KnownMargins | None, dict[str, str]]:
    """Return margins as a report has them, and margins.json by its name, to be written with the plan."""
    if found is None:
        return None, {}
    from synergrip.reports.data.json_margins import margins_document
    from synergrip.reports.data.margins_files import FILE
    from synergrip.reports.data.plan_files import to_json
    from synergrip.reports.data.saved_margins import KnownMargins

    document: dict[str, Any] = margins_document(problem.title, found, problem.notes, problem.source)
    return KnownMargins.of(found, document), {FILE: to_json(document) + "\n"}
