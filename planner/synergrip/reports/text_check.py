"""A judgement of given references, as text and as a JSON document."""

from __future__ import annotations

from typing import Any

from synergrip.errors import Refusal
from synergrip.plans.check import Judgement
from synergrip.plans.problem import Problem
from synergrip.reports.json_analysis import structure_document
from synergrip.reports.json_plan import check_document, margin_document, usage_document
from synergrip.reports.tables import table
from synergrip.reports.text_plan import refused_lines, usage_rows, verdict_word
from synergrip.reports.text_problem import problem_lines


def judgement_text(problem: Problem, judgement: Judgement, color: bool = False) -> str:
    """Return what was judged, every check, and what the plan uses of every limit."""
    rows = [(c.name, f"{c.error:.2e}", f"{c.tolerance:.0e}", "✓" if c.passed else "FAILS") for c in judgement.checks]
    word = verdict_word(judgement.verdict, color)
    failed = [check.name for check in judgement.checks if not check.passed]
    why = f"this plan breaks: {', '.join(failed)}" if failed else "this plan keeps every limit of the problem"
    lines = [*problem_lines(problem), "", table(("check", "error", "tolerance", ""), rows), "", f"{word}  {why}"]
    used = [row for usage in judgement.usages for row in usage_rows(usage)]
    return "\n".join([*lines, table(("", "worst", "at", "limit"), used)])


def refused_text(problem: Problem, refusal: Refusal, color: bool = False) -> str:
    """Return why no references at all can do what a problem asks, or why its grasp cannot be analysed."""
    word = verdict_word("infeasible", color)
    return "\n".join([*problem_lines(problem), "", *refused_lines(word, refusal.stage, str(refusal))])


def judgement_document(judgement: Judgement) -> dict[str, Any]:
    """Return the judgement as a JSON document."""
    return {
        "verdict": judgement.verdict, "exit_code": judgement.exit_code,
        "structure": structure_document(judgement.analysis.grasp, judgement.analysis),
        "time_s": judgement.motion.times.tolist(),
        "margin": margin_document(judgement.usages[0]),
        "limits": [usage_document(usage) for usage in judgement.usages],
        "checks": [check_document(check) for check in judgement.checks],
    }  # fmt: skip
