"""What inscribed friction pyramids would cost, as text and as a JSON document."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

from synergrip.documents.quantities import apart, plain
from synergrip.planning.pyramids import Answer, Comparison
from synergrip.reports.text.tables import wrapped

LABEL = "pyramids "
_BELOW = " " * len(LABEL)
NOTHING = "nothing to compare: no plan is verified, and inscribed pyramids allow no more than the cones"
STOPPED = "not compared: interrupted"


def comparison_lines(comparison: Comparison | None, stopped: bool = False) -> Iterator[str]:
    """Yield what pyramids cost and what the solver of quadratic programs made of them.

    Args:
        comparison: None without a plan to compare with.
        stopped: whether that is because somebody interrupted.
    """
    if comparison is None:
        yield from wrapped(LABEL, STOPPED if stopped else NOTHING)
        return
    facets = f"with {comparison.facets} facets inscribed in each friction cone (a comparison, no part of the verdict)"
    yield from wrapped(LABEL, f"{facets}: {_cost(comparison)}")
    if comparison.answer is None:
        yield from wrapped(_BELOW, _no_program(comparison))
    else:
        yield from wrapped(_BELOW, _answered(comparison, comparison.answer))


def comparison_document(comparison: Comparison | None) -> dict[str, Any] | None:
    """Return the comparison as a JSON document; None without a plan."""
    if comparison is None:
        return None
    answer = comparison.answer
    return {
        "facets": comparison.facets, "rejected": comparison.rejected, "effort": comparison.effort,
        "effort_ratio": comparison.effort_ratio, "peak_ratio": comparison.peak_ratio, "margin_N": comparison.margin,
        "solver": answer.solver if answer else None,
        "status": answer.status if answer else _no_program(comparison),
        "verified": answer is not None and answer.verified,
        "failed": [check.name for check in answer.checks if not check.passed] if answer else [],
        "gap": answer.gap if answer and math.isfinite(answer.gap) else None,
        "time_s": answer.seconds if answer else None, "time_ratio": comparison.time_ratio,
    }  # fmt: skip


def _cost(comparison: Comparison) -> str:
    if comparison.rejected:
        return "rejected, no plan keeps them (proven), although the cones allow one"
    if comparison.margin is None:
        return "neither a plan nor a proof that there is none was found"
    sizes = ((f"{comparison.effort} effort", comparison.effort_ratio), ("largest normal force", comparison.peak_ratio))
    parts = [f"{name} {_percent(ratio)}" for name, ratio in sizes if ratio is not None]
    within, true = apart(comparison.margin, float(comparison.cones.margins.min()))
    margin = f"smallest slip margin {within} N (cones: {true} N)"
    if comparison.cones.largest_margin is not None:  # what is lost is margin; the rest is of a smaller one
        return ", ".join([margin, *parts])
    return ", ".join([*parts, margin])


def _percent(ratio: float) -> str:
    return f"{round(100 * (ratio - 1), 1) + 0.0:+.1f} %"


def _answered(comparison: Comparison, answer: Answer) -> str:
    ratio, took = comparison.time_ratio, f"{plain(1e3 * answer.seconds, 2)} ms"
    times = "" if ratio is None else f", {plain(ratio, 2)} times as long as the cones took"
    return f"{answer.solver} says '{answer.status}': {_judged(comparison, answer)}; {took}{times}"


def _judged(comparison: Comparison, answer: Answer) -> str:
    if answer.verified and comparison.rejected:
        return "verified, its references keep every limit and the true cones, but not the pyramids"
    if answer.verified:
        goal = f", goal within {answer.gap:.0e} of the best" if math.isfinite(answer.gap) else ""
        return f"verified, its references keep every limit and the true cones{goal}"
    if not answer.checks:
        return "not verified, it returned no references"
    failed = ", ".join(f"{check.name} ({check.error:.0e})" for check in answer.checks if not check.passed)
    return f"not verified, its references break {failed}"


def _no_program(comparison: Comparison) -> str:
    others = ", ".join(comparison.other_cones)
    return f"no quadratic program: pyramids replace friction cones only; this problem has other cones: {others}"
