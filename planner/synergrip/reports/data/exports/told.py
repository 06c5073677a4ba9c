"""What was exported, as text, as a document, and what stays empty."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from synergrip.reports.data.exports.exported_plan import ExportedPlan
from synergrip.reports.data.exports.exporting import Exported


def export_text(plan: ExportedPlan, found: Sequence[Exported]) -> str:
    """Return the answer of ``synergrip export``."""
    knots = len(plan.times)
    lines = [plan.title, f"{knots} {'knots' if knots > 1 else 'knot'}: {plan.figures}", ""]
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
    """Yield what of each format the plan knows nothing of, and what is odd about its file."""
    for note in plan.notes:
        yield f"note     {plan.source}: {note}"
    for each in found:
        yield from (f"empty    {each.to}: {empty.field} ({empty.why})" for empty in each.empty)
