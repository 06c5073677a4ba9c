"""What was exported, as text, as a document, and what stays empty."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from synergrip.errors import shortened
from synergrip.reports.data.exports.exported_plan import ExportedPlan
from synergrip.reports.data.exports.exporting import Empty, Exported
from synergrip.reports.text.tables import wrapped

LONGEST_TITLE = 200
"""Characters of a title that are shown."""


def export_text(plan: ExportedPlan, found: Sequence[Exported]) -> str:
    """Return the answer of ``synergrip export``."""
    knots = len(plan.times)
    lines = [shortened(plan.title, LONGEST_TITLE), f"{knots} {'knots' if knots > 1 else 'knot'}: {plan.figures}", ""]
    width = max(len(each.to) for each in found)
    for each in found:
        lines += [f"{each.to if not i else '':{width}}  {file}" for i, file in enumerate(each.files)]
    return "\n".join(lines)


def export_document(plan: ExportedPlan, found: Sequence[Exported]) -> dict[str, Any]:
    """Return what was exported as a document."""
    return {
        "title": plan.title, "plan": plan.source, "figures": plan.figures, "knots": len(plan.times), "exit_code": 0,
        "files": [str(file) for each in found for file in each.files],
        "exports": [
            {"to": each.to, "files": [str(file) for file in each.files],
             "left_empty": [empty._asdict() for empty in each.empty]}
            for each in found
        ],
        "notes": list(plan.notes),
    }  # fmt: skip


def left_empty(plan: ExportedPlan, found: Sequence[Exported]) -> Iterator[str]:
    """Yield what of which formats the plan knows nothing of, and what is odd about its file."""
    for note in plan.notes:
        yield from wrapped("note     ", f"{plan.source}: {note}")
    formats: dict[Empty, list[str]] = {}
    for each in found:
        for empty in each.empty:
            formats.setdefault(empty, []).append(each.to)
    for empty, names in formats.items():
        yield from wrapped("empty    ", f"{', '.join(names)}: {empty.field} ({empty.why})")
