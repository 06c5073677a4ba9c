"""Where an answer comes from: which version answered which problem, when, with what solver."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from hashlib import sha256
from json import dumps
from typing import Any, Protocol

from synergrip import __version__
from synergrip.planning.outcome import Outcome

KEY = "provenance"


@dataclass(frozen=True)
class Source:
    """What was asked, as it was written."""

    name: str
    content: str | Mapping[str, Any]
    """The text of a file, or a dict of its structure."""
    overrides: tuple[str, ...] = ()

    @property
    def sha256(self) -> str:
        """Of the text in UTF-8, or of the dict as JSON with sorted keys."""
        content = self.content
        text = content if isinstance(content, str) else dumps(content, sort_keys=True, separators=(",", ":"))
        return sha256(text.encode()).hexdigest()


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
