"""What a file claims of its references, as text and as a JSON document: how much of it is so."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from synergrip.documents.quantities import apart
from synergrip.planning.check import FAILS, Judgement
from synergrip.planning.claims import AS_WRITTEN, Claims, Difference
from synergrip.planning.in_cases import ALL_CASES
from synergrip.planning.told import finite
from synergrip.problems.in_short import many
from synergrip.reports.text.tables import wrapped


def claims_lines(judgement: Judgement, *, details: bool) -> Iterator[str]:
    """Yield how much of what the file says is so; each with details, and where nothing else is wrong."""
    claims = judgement.claims
    if not claims.checks:
        return
    alone = all(check.passed or check in claims.checks for check in judgement.checks)
    yield from wrapped("claims   ", _counted(claims, stands_in=judgement.stands_in, told=details or alone))
    if claims.right and details:
        yield from wrapped("claims   ", f"as the references have it: {', '.join(claims.right)}")
    for each in claims.differences:
        if details or alone or _made_for_cases(each):
            yield from wrapped("claims   ", _difference(each))
    if claims.skipped and (details or alone):
        yield from wrapped("claims   ", f"not compared, as no references can tell: {', '.join(claims.skipped)}")


def _counted(claims: Claims, *, stands_in: bool, told: bool) -> str:
    """Return how many claims are so, and whether the numbers are those that were written."""
    own = [check for check in claims.checks if check.name != AS_WRITTEN]
    wrong = sum(not check.passed for check in own)
    count = many(len(own), "thing")
    head = f"all of the {count} that the file says of its references are so"
    if wrong:
        head = f"{wrong} of the {count} that the file says of its references {'is' if wrong == 1 else 'are'} not so"
        head += " in the linear model, all there is to compare with" * stands_in
    if len(own) < len(claims.checks) and AS_WRITTEN not in claims.right:
        head += f"{', and' if wrong else ', but'} its numbers are not those that were written (by its digest)"
    return head + "; -v and --format json tell which" * (wrong > 0 and not told)


def _difference(each: Difference) -> str:
    says, found = each.says, each.found
    if isinstance(says, float) and isinstance(found, int | float) and not isinstance(found, bool):
        says, found = apart(says, float(found))
    if each.key == "verdict":
        return f"verdict: the file says {_word(says)}, its references {'fail' if found == FAILS else 'keep all limits'}"
    told = f"{each.key}: the file says {_word(says)}, it is {_word(found)}"
    made = "the plan was made with [allow], which this problem does not state: give the same --set"
    return f"{told}; {made}" if _made_for_cases(each) else told


def _made_for_cases(each: Difference) -> bool:
    return isinstance(each.says, str) and each.says.startswith(ALL_CASES)


def _word(value: object) -> str:
    return "null" if value is None else str(value).lower() if isinstance(value, bool) else str(value)


def claims_document(claims: Claims) -> dict[str, Any]:
    """Return which keys of the file are right, which are not, with the worst of each, and which were not compared."""
    wrong = [
        {"key": each.key, "says": each.says, "found": each.found, "error": finite(each.error)}
        for each in claims.differences
    ]
    return {"right": list(claims.right), "wrong": wrong, "not_compared": list(claims.skipped)}
