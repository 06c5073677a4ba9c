"""The lines about what a task allows for."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from synergrip.conic.allowed import Allowed
from synergrip.documents.quantities import plain
from synergrip.planning.fresh_samples import FreshSamples
from synergrip.planning.in_case import InCase, worst_case
from synergrip.planning.outcome import Plan
from synergrip.problems.in_short import many
from synergrip.reports.text.tables import wrapped
from synergrip.reports.text.text_between import to_within

OTHERS = 3
"""Cases that are named."""


def case_lines(plan: Plan) -> Iterator[str]:
    """Yield the lines of ``allow``: in how many cases limits hold, and where the slip margin is smallest."""
    if plan.cases:
        who = "of the linear model" if plan.executed is None else "executed on the hand that moves"
        within = to_within([usage for case in plan.cases for usage in case.usages])
        count = sum(case.by_maps for case in plan.cases)
        told = f"all limits hold in {many(len(plan.cases) - count, 'case')} {who}{within}"
        told += f", and in {count} with contacts off that are no worse by the maps of its knots" if count else ""
        yield from wrapped("allow    ", f"{told}; {_least(plan.cases)}{_share(plan)}")


def guaranteed_margin(plan: Plan) -> str:
    """Return that the smallest slip margin is the one as stated, and which one is kept in all that is allowed for."""
    if not plan.cases:
        return ""
    least = worst_case(plan.cases)
    if plan.fresh is not None:
        also = f"; {plain(least.margin)} N in what is guaranteed beside" if len(plan.cases) > 1 else ""
        return f" as stated{also}; scenarios keep what is asked, not this"
    drawn = " and of the scenarios drawn" if plan.formulation.allowed and plan.formulation.allowed.samples else ""
    return f" as stated; {plain(least.margin)} N in the worst case of all that is allowed for{drawn}"


def judged_cases(cases: Sequence[InCase], fresh: FreshSamples | None, allowed: Allowed | None) -> Iterator[str]:
    """Yield the lines of ``allow`` about references that were judged, and were not made for it: the worst cases."""
    if not cases or allowed is None:
        return
    rows = [" ".join((row[0], f"({row[1]})", row[2])) for row in case_table(cases)]
    yield from wrapped("allow    ", f"smallest slip margins of {many(len(cases), 'case')}: {'; '.join(rows)}")
    if fresh is not None and allowed.scenarios is not None:
        told = f"{fresh.missing} of {fresh.count} fresh scenarios (seed {allowed.scenarios.seed}) miss a limit"
        sure = f"with a confidence of {100 * allowed.scenarios.confidence:.6g} %"
        may = f"no more than {100 * fresh.share:.3g} % of any others do, and {100 * fresh.asked:.4g} % may"
        yield from wrapped("allow    ", f"{told}; {sure} {may}{': ' * bool(fresh.missed)}{fresh.missed}")


def _share(plan: Plan) -> str:
    """Return for which share of scenarios the plan holds; nothing where it was asked for none."""
    allowed = plan.formulation.allowed
    if allowed is None or allowed.scenarios is None:
        return ""
    asked, fresh = allowed.scenarios, plan.fresh
    sure = f"with a confidence of {100 * asked.confidence:.6g} %, all but {100 * asked.share:.4g} % of any others"
    if fresh is None:
        return f"; of {len(allowed.samples)} scenarios (seed {asked.seed}) all hold, and so, {sure}"
    count = "all" if not fresh.missing else f"{fresh.count - fresh.missing}"
    return (
        f"; of {fresh.count} fresh scenarios (seed {asked.seed}), executed at the true equilibria at {fresh.instants} "
        f"instants, {count} hold, and so, {sure}"
    )


def _least(cases: Sequence[InCase]) -> str:
    least = worst_case(cases)
    slip = least.usages[0]
    k, i = slip.worst()
    where = f"{slip.items[i]}, t = {slip.times[k]:.2f} s"
    return f"the smallest slip margin is {plain(least.margin)} N ({where}), {least.title}"


def case_table(cases: Sequence[InCase]) -> list[tuple[str, ...]]:
    """Return rows of the cases with the smallest slip margins: case, margin, where."""
    rows: list[tuple[str, ...]] = []
    for case in sorted(cases, key=lambda each: each.margin)[:OTHERS]:
        slip = case.usages[0]
        k, i = slip.worst()
        rows.append((f"{plain(case.margin)} N", f"{slip.items[i]}, t = {slip.times[k]:.2f} s", case.title))
    return rows
