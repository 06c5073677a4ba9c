"""A judgement of given references, as text and as a JSON document."""

from __future__ import annotations

from typing import Any

from synergrip.plans.check import Judgement
from synergrip.plans.problem import Problem
from synergrip.reports.json_analysis import structure_document
from synergrip.reports.json_plan import margin_document, usage_document
from synergrip.reports.tables import table
from synergrip.reports.text_plan import usage_row
from synergrip.reports.text_problem import problem_lines


def judgement_text(problem: Problem, judgement: Judgement, color: bool = False) -> str:
    """Return what was judged, every check, and what the plan uses of every limit."""
    rows = [(c.name, f"{c.error:.2e}", f"{c.tolerance:.0e}", "✓" if c.passed else "FAILS") for c in judgement.checks]
    code = {"feasible": "\x1b[1;32m", "infeasible": "\x1b[1;31m"}[judgement.verdict]
    word = f"{code}{judgement.verdict}\x1b[0m" if color else judgement.verdict
    failed = [check.name for check in judgement.checks if not check.passed]
    why = f"this plan breaks: {', '.join(failed)}" if failed else "this plan keeps every limit of the problem"
    lines = [*problem_lines(problem), "", table(("check", "error", "tolerance", ""), rows), "", f"{word}  {why}"]
    return "\n".join([*lines, table(("", "worst", "at", "limit"), [usage_row(usage) for usage in judgement.usages])])


def judgement_document(judgement: Judgement) -> dict[str, Any]:
    """Return the judgement as a JSON document."""
    names = [contact.name for contact in judgement.analysis.grasp.contacts]
    checks = [
        {"name": c.name, "error": c.error, "tolerance": c.tolerance, "passed": c.passed} for c in judgement.checks
    ]
    return {
        "verdict": judgement.verdict, "exit_code": judgement.exit_code,
        "structure": structure_document(judgement.analysis.grasp, judgement.analysis),
        "time_s": judgement.motion.times.tolist(),
        "margin": margin_document(judgement.margins, names, judgement.motion.times),
        "limits": [usage_document(usage) for usage in judgement.usages],
        "checks": checks,
    }  # fmt: skip
