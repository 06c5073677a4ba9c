"""A judgement of given references, as text and as a JSON document."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from synergrip.documents.quantities import apart
from synergrip.errors import Refusal
from synergrip.planning.check import FAILS, Judgement
from synergrip.planning.claims import Claims, Difference
from synergrip.planning.in_cases import ALL_CASES
from synergrip.planning.told import (
    between_document,
    cases_document,
    check_document,
    finite,
    margin_document,
    structure_document,
    usage_document,
)
from synergrip.planning.verified import LIMIT
from synergrip.problems.problem import Problem
from synergrip.reports.text.tables import table, wrapped
from synergrip.reports.text.text_between import looked_at
from synergrip.reports.text.text_cases import judged_cases
from synergrip.reports.text.text_plan import refused_lines, usage_rows, verdict_word
from synergrip.reports.text.text_problem import problem_lines


def judgement_text(problem: Problem, judgement: Judgement, color: bool = False) -> str:
    """Return what was judged, every check, what the file claims, and what the plan uses of every limit."""
    own = [check for check in judgement.checks if check not in judgement.claims.checks or not check.passed]
    rows = [(c.name, f"{c.error:.2e}", f"{c.tolerance:.0e}", "✓" if c.passed else "FAILS") for c in own]
    word = verdict_word("this plan fails" if judgement.verdict == FAILS else judgement.verdict, color)
    failed = [check.name for check in judgement.checks if not check.passed]
    missed = judgement.between is not None and judgement.between.excess > LIMIT
    kept = f"this plan keeps every limit of the problem{' at its knots, and not between them' * missed}"
    why = f"it breaks: {', '.join(failed)}" if failed else kept
    if failed and all(check.passed or check in judgement.claims.checks for check in judgement.checks):
        why = f"{kept}, but its file says what is not so of this problem: {', '.join(failed)}"
    lines = [*problem_lines(problem), "", table(("check", "error", "tolerance", ""), rows), *_claims(judgement.claims)]
    if judgement.between is not None:
        lines += looked_at(judgement.between, judgement.task.between)
    lines += judged_cases(judgement.cases, judgement.fresh, judgement.formulation.allowed)
    used = [row for usage in judgement.usages for row in usage_rows(usage)]
    return "\n".join([*lines, "", *wrapped(f"{word}  ", why), table(("", "worst", "at", "limit"), used)])


def _claims(claims: Claims) -> Iterator[str]:
    """Yield which claims of the file are right, what is wrong, and what was not compared."""
    if claims.right:
        yield from wrapped("claims   ", f"as the references have it: {', '.join(claims.right)}")
    for each in claims.differences:
        yield from wrapped("claims   ", _difference(each))
    if claims.skipped:
        yield from wrapped("claims   ", f"not compared, as no references can tell: {', '.join(claims.skipped)}")


def _difference(each: Difference) -> str:
    says, found = each.says, each.found
    if isinstance(says, float) and isinstance(found, int | float) and not isinstance(found, bool):
        says, found = apart(says, float(found))
    told = f"{each.key}: the file says {_word(says)}, it is {_word(found)}"
    made = isinstance(says, str) and says.startswith(ALL_CASES)
    return (
        f"{told}; the plan was made with [allow], which this problem does not state: give the same --set" * made or told
    )


def _word(value: object) -> str:
    return "null" if value is None else str(value).lower() if isinstance(value, bool) else str(value)


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
        "margin": margin_document(judgement.usages[0]) | {"per_contact_N": judgement.margins.tolist()},
        "limits": [usage_document(usage) for usage in judgement.usages],
        "checks": [check_document(check) for check in judgement.checks],
        "between": between_document(judgement.between),
        "allowances": cases_document(judgement.cases, judgement.formulation.allowed, judgement.fresh),
        "claims": _claims_document(judgement.claims),
    }  # fmt: skip


def _claims_document(claims: Claims) -> dict[str, Any]:
    """Return which keys of the file are right, which are not, with the worst of each, and which were not compared."""
    wrong = [
        {"key": each.key, "says": each.says, "found": each.found, "error": finite(each.error)}
        for each in claims.differences
    ]
    return {"right": list(claims.right), "wrong": wrong, "not_compared": list(claims.skipped)}
