"""The line about what happens between the knots."""

from __future__ import annotations

from collections.abc import Iterator

from synergrip.planning.between import Between
from synergrip.planning.outcome import Plan
from synergrip.planning.told import nearest
from synergrip.planning.verified import LIMIT
from synergrip.reports.text.tables import wrapped
from synergrip.reports.text.text_problem import many


def between_lines(plan: Plan) -> Iterator[str]:
    """Yield the lines of ``between``; none when nothing is known of it."""
    if plan.between is not None:
        yield from looked_at(plan.between, plan.task.between)


def looked_at(between: Between, asked: str | None) -> Iterator[str]:
    """Yield the lines of ``between``: what was looked at, what load and wish do there, and what of the limits.

    Args:
        between: what was looked at.
        asked: `task.between`.
    """
    yield from wrapped("between  ", "; ".join([*_departures(between), _limits(between, asked)]))


def _departures(between: Between) -> Iterator[str]:
    if between.rooms is not None:
        yield f"the hand that moves, at {len(between.usages[0].times)} instants, knots and corners among them"
        return
    if between.straight:
        yield "loads and wishes are straight lines from knot to knot"
        return
    looked = [many(len(between.corners), "corner") + " between the knots"] * bool(between.corners)
    if between.samples:
        looked.append(f"{between.samples} instants in each {'curved piece' if looked else 'interval'}")
    else:
        looked.append("straight lines from one to the next")
    yield " and ".join(looked)
    if between.load_departure:
        yield f"the load leaves its straight line by {between.load_departure:.3g} N"
    if between.path_departure:
        leaves = "its own" if between.load_departure else "leaves its straight line"
        yield f"the wanted motion {leaves} by {1e3 * between.path_departure:.3g} mm"


def _limits(between: Between, asked: str | None) -> str:
    if between.excess <= LIMIT:
        exact = between.exact and not between.straight
        return "all limits hold there too, and so at all times" if exact else "all limits hold there too"
    worst = max(between.usages, key=lambda usage: usage.violation)
    k, i = worst.worst()
    reached, limit = nearest(worst)
    advice = "; more knots straighten it"
    if between.rooms is None and asked != "hold":
        advice = '; task.between = "hold" keeps the limits there, more knots straighten it'
    elif asked == "report":
        advice = '; without task.between = "report" they are kept there, more knots straighten it'
    return (
        f"{worst.title} of {worst.items[i]} reaches {reached} at t = {worst.times[k]:.3g} s, "
        f"past its limit of {limit}{advice}"
    )
