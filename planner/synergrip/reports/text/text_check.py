"""A judgement of given references, as text and as a JSON document."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

from synergrip.errors import Refusal
from synergrip.planning.between import LIMIT
from synergrip.planning.check import FAILS, Judgement
from synergrip.planning.outcome import BETWEEN
from synergrip.planning.springs import spring_notes
from synergrip.planning.told import (
    between_document,
    cases_document,
    check_document,
    margin_document,
    structure_document,
    usage_document,
)
from synergrip.problems.in_short import many
from synergrip.problems.problem import Problem
from synergrip.reports.text.tables import table, wrapped
from synergrip.reports.text.text_between import looked_at
from synergrip.reports.text.text_broken import broken, names_of, not_holding
from synergrip.reports.text.text_cases import judged_cases
from synergrip.reports.text.text_claims import claims_document, claims_lines
from synergrip.reports.text.text_plan import refused_lines, verdict_word
from synergrip.reports.text.text_problem import problem_lines
from synergrip.reports.text.text_usages import error_rows, limit_rows

STANDS_IN = (
    "the figures are those of the linear model at the start posture, as the hand is at no equilibrium with these "
    "references; a limit that is kept there says nothing about the hand"
)


def judgement_text(problem: Problem, judgement: Judgement, color: bool = False, *, details: bool = False) -> str:
    """Return what the hand does with the references, what that breaks, and whether the file says the same.

    Args:
        problem: what was asked.
        judgement: of the references.
        color: whether the verdict has its colour.
        details: whether every check and every claim has a line.
    """
    word = verdict_word("this plan fails" if judgement.verdict == FAILS else judgement.verdict, color)
    lines = [*problem_lines(problem), "", *wrapped(f"{word}  ", _why(judgement))]
    for told in broken(judgement):
        lines += wrapped("breaks   ", told)
    for told in _notes(judgement):
        lines += wrapped("note     ", told)
    head = ("", "linear model" if judgement.stands_in else "worst", "at", "limit")
    rows = limit_rows(judgement.usages, judgement.task, judgement.analysis.grasp)
    lines += [table(head, [*rows, *error_rows(judgement.motion, judgement.task, judgement.analysis)]), ""]
    lines += [*_checked(judgement, details=details)]
    if judgement.between is not None:
        lines += looked_at(judgement.between, judgement.task.between, judgement.motion.times)
    lines += judged_cases(judgement.cases, judgement.fresh, judgement.formulation.allowed)
    lines += claims_lines(judgement, details=details)
    return "\n".join(lines)


def _why(judgement: Judgement) -> str:
    """Return in one sentence what fails, or that all is kept."""
    if judgement.stands_in:
        return f"with these references the hand is at no equilibrium {judgement.lost}"
    if names := names_of(judgement):
        return f"it breaks: {', '.join(names)}"
    missed = judgement.between is not None and judgement.between.excess > LIMIT
    kept = f"keeps every limit of the problem{' at its knots, and not between them' * missed}"
    return f"it {kept}, but not all that its file says is true" if judgement.verdict == FAILS else f"this plan {kept}"


def _notes(judgement: Judgement) -> list[str]:
    """Return what is to be known of the figures: of what model they are, what contacts let go, what springs take."""
    executed, torques = judgement.executed, judgement.motion.torques
    of_springs = () if executed is None else spring_notes(executed, torques, judgement.task)
    return [*not_holding(judgement), *[STANDS_IN] * judgement.stands_in, *of_springs]


def _checked(judgement: Judgement, *, details: bool) -> Iterator[str]:
    """Yield how many checks pass; with details each of them."""
    own = [check for check in judgement.checks if check not in judgement.claims.checks]
    failed = sum(not check.passed for check in own)
    told = f"{failed} of {many(len(own), 'check')} fail" if failed else f"{many(len(own), 'check')} ✓"
    yield from wrapped("check    ", told + "; -v shows each" * (not details))
    if details:
        units = {usage.title: usage.unit for usage in judgement.usages} if judgement.executed is not None else {}
        rows = [
            (
                check.name, f"{check.error:.2e}" if math.isfinite(check.error) else "", f"{check.tolerance:.0e}",
                units.get(check.name.removeprefix(f"{BETWEEN}: "), ""), "✓" if check.passed else "FAILS",
            )
            for check in own
        ]  # fmt: skip
        yield table(("check", "error", "tolerance", "unit", ""), rows)


def refused_text(problem: Problem, refusal: Refusal, color: bool = False) -> str:
    """Return why no references at all can do what a problem asks, or why its grasp cannot be analysed."""
    word = verdict_word("infeasible", color)
    return "\n".join([*problem_lines(problem), "", *refused_lines(word, refusal.stage, str(refusal))])


def judgement_document(judgement: Judgement) -> dict[str, Any]:
    """Return the judgement as a JSON document."""
    return {
        "verdict": judgement.verdict, "exit_code": judgement.exit_code,
        "why": _why(judgement), "broken": list(broken(judgement)), "notes": _notes(judgement),
        "structure": structure_document(judgement.analysis.grasp, judgement.analysis),
        "time_s": judgement.motion.times.tolist(),
        "margin": margin_document(judgement.usages[0]) | {"per_contact_N": judgement.margins.tolist()},
        "limits": [usage_document(usage) for usage in judgement.usages],
        "checks": [check_document(check) for check in judgement.checks],
        "between": between_document(judgement.between),
        "allowances": cases_document(judgement.cases, judgement.formulation.allowed, judgement.fresh),
        "claims": claims_document(judgement.claims),
    }  # fmt: skip
