"""The options ``--pyramids`` and ``--qp-solver`` of ``synergrip plan``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from synergrip.cli.running import heard
from synergrip.errors import InputError

if TYPE_CHECKING:
    from synergrip.planning.outcome import Outcome
    from synergrip.planning.pyramids import Request


def asked(facets: int | None, backend: str | None) -> Request | None:
    """Return what is to be compared with, None when nothing is; before anything is solved."""
    if facets is None:
        if backend is not None:
            raise InputError.at("--qp-solver", "it solves friction pyramids only; add --pyramids 8")
        return None
    from synergrip.planning.pyramids import requested

    return requested(facets, backend or "osqp")


def compared(outcome: Outcome, request: Request | None, document: dict[str, Any]) -> str:
    """Return the lines that the comparison adds to the answer's text; put it into the answer's document."""
    if request is None:
        return ""
    from synergrip.planning.outcome import Plan
    from synergrip.planning.pyramids import compare
    from synergrip.reports.text.text_pyramids import comparison_document, comparison_lines

    comparison, stopped = None, isinstance(outcome, Plan) and outcome.interrupted
    if isinstance(outcome, Plan) and not stopped:
        try:
            with heard():
                comparison = compare(outcome, request)
        except KeyboardInterrupt:  # the plan is there and stays
            stopped = True
    document["pyramids"] = comparison_document(comparison)
    return "\n".join(["", "", *comparison_lines(comparison, stopped)])
