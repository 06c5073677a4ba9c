"""Where an answer comes from: which version answered which problem, when, with what solver."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import UTC, datetime
from typing import Any, Protocol

from synergrip import __version__
from synergrip.documents.source import Source
from synergrip.planning.outcome import Outcome

KEY = "provenance"


class Asked(Protocol):
    """What an answer tells of its problem; `load_problem` returns such a one."""

    @property
    def title(self) -> str:
        """Title for people."""

    @property
    def notes(self) -> Sequence[str]:
        """What is doubtful about the grasp, though it is no error."""

    @property
    def source(self) -> Source:
        """Its text."""


def provenance_document(outcome: Outcome, source: Source | None = None) -> dict[str, Any]:
    """Return where an answer comes from; `problem` is null for a grasp and a task made in code."""
    problem = None
    if source is not None:
        written = "text" if isinstance(source.content, str) else "dict"
        problem = {"name": source.name, written: source.content, "sha256": source.sha256}
    return {
        "version": __version__,
        "problem": problem,
        "overrides": list(source.overrides) if source else [],
        "solver": outcome.decisions[-1].solution.solver if outcome.decisions else None,
        "date": datetime.now(UTC).isoformat(timespec="seconds"),
    }
