"""What a task comes to with k synergies, as tables for people."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from synergrip.documents.quantities import plain
from synergrip.explain.synergies.needed_points import NeededPoint
from synergrip.explain.synergies.subset_values import GOALS
from synergrip.explain.synergies.synergies_needed import SynergiesNeeded
from synergrip.problems.problem import Problem
from synergrip.reports.text.tables import table, wrapped
from synergrip.reports.text.text_problem import problem_lines

MODELS = {"start": "linear model of the start posture", "along": "verdicts and figures of the hand that moves"}
HEADER = ("n_z", "plan", "largest margin", "effort", "peak force", "off its place")
MOST = 8
"""Subsets that are listed."""
MISSING = "-"


def needed_text(problem: Problem, needed: SynergiesNeeded) -> str:
    """Return both curves, the fewest synergies, and what is certain of them."""
    named = f"{needed.set}, " if needed.set else ""
    lines = [*problem_lines(problem)]
    lines += wrapped("needed   ", f"of {named}{len(needed.synergies)} synergies; {MODELS[needed.model]}")
    lines += ["", "the first k", _table(needed.first, names=False)]
    lines += ["", f"the best k, by {GOALS[needed.by].name}", _table(needed.best, names=True), *_searched(needed), ""]
    lines += [*_fewest(needed), *_proof(needed)]
    return "\n".join(lines + ["interrupted; what is shown is finished"] * needed.interrupted)


def _table(points: Sequence[NeededPoint], *, names: bool) -> str:
    rows = [(*cells(point), *([" ".join(point.synergies)] if names else [])) for point in points]
    return table((*HEADER, *(["synergies"] if names else [])), rows, right=(0, 2, 3, 4, 5))


def cells(point: NeededPoint) -> tuple[str, ...]:
    """Return the cells of a row below `HEADER`."""
    plan = "yes" if point.verdict == "feasible" else f"{'no' if point.certified else 'unknown'}: {point.stage}"
    margin = "no bound" if point.largest_margin == math.inf else _number(point.largest_margin, 1.0, "N")
    off = point.outside or point.tracking_error
    return (
        str(len(point.synergies)), plan, margin, _number(point.effort, 1.0, "N"), _number(point.peak, 1.0, "N"),
        _number(off, 1e3, "mm"),
    )  # fmt: skip


def _number(value: float | None, factor: float, unit: str) -> str:
    return MISSING if value is None else f"{plain(factor * value)} {unit}"


def _searched(needed: SynergiesNeeded) -> Iterator[str]:
    """Yield how the best were found."""
    stepwise = [str(len(point.synergies)) for point in needed.best if not point.every]
    if stepwise:
        text = (
            f"all subsets were looked at but for n_z = {', '.join(stepwise)}: there the best is that which adding one "
            "synergy to the best of one less, and then exchanging one at a time, leads to"
        )
        yield from wrapped("         ", text)
    elif needed.best:
        yield "         of all subsets"


def _fewest(needed: SynergiesNeeded) -> Iterator[str]:
    if not needed.fewest:
        whole = len(needed.best) == len(needed.synergies)
        yield f"fewest   {'none: all together have no plan' if whole else 'none found in what was looked at'}"
        return
    count = len(needed.minimal)
    all_of = "all" if needed.all_minimal else "found"
    where = " in the linear model" * (needed.model == "along")
    such = f"{count} such subset{'s' * (count > 1)} ({all_of})"
    yield f"fewest   {needed.fewest} of {len(needed.synergies)}{where}: {such}"
    for names in needed.minimal[:MOST]:
        yield f"         {' '.join(names)}"
    if count > MOST:
        yield f"         and {count - MOST} more"


def _proof(needed: SynergiesNeeded) -> Iterator[str]:
    """Yield what is certain of fewer synergies."""
    if not needed.refuted:
        return
    counts = ", ".join(
        f"{refuted} of {looked_at} of {size}" for size, (looked_at, refuted) in enumerate(needed.refuted, 1)
    )
    what = f"subsets certified to have no plan in the linear model: {counts} synergies"
    none = "so fewer do not do" if needed.fewest else "so these do not do"
    sure = none if needed.proven else "not all there are, so that fewer might do"
    yield from wrapped("proof    ", f"{what}; {sure}")
