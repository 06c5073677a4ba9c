"""The line about what happens between the knots."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from synergrip.conic.limits.limit import Usage
from synergrip.documents.quantities import SHOWN_IN, in_mm, plain
from synergrip.linalg import Array
from synergrip.planning.between import LIMIT, Between
from synergrip.planning.outcome import Plan
from synergrip.planning.told import nearest
from synergrip.problems.in_short import many
from synergrip.reports.text.tables import wrapped

FINE = {"N": (1e3, "mN"), "m": (1e6, "um")}
"""What small forces and lengths are told in."""


def between_lines(plan: Plan) -> Iterator[str]:
    """Yield the lines of ``between``; none when nothing is known of it."""
    if plan.between is not None:
        yield from looked_at(plan.between, plan.task.between, plan.motion.times)


def looked_at(between: Between, asked: str | None, knots: Array) -> Iterator[str]:
    """Yield the lines of ``between``: what was looked at, what load and wish do there, and what of the limits.

    Args:
        between: what was looked at.
        asked: `task.between`.
        knots: (T,) [s].
    """
    yield from wrapped("between  ", "; ".join([*_departures(between), _limits(between, asked, knots)]))


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
        yield f"the load leaves its straight line by {plain(between.load_departure, 3)} N"
    if between.path_departure:
        leaves = "its own" if between.load_departure else "leaves its straight line"
        yield f"the wanted motion {leaves} by {in_mm(between.path_departure)}"


def _limits(between: Between, asked: str | None, knots: Array) -> str:
    if between.excess <= LIMIT:
        exact = between.exact and not between.straight
        hold = f"all limits hold there too{to_within(between.usages)}"
        return f"{hold}, and so at all times" if exact else hold
    worst = max(between.broken, key=lambda usage: usage.violation)
    k, i = worst.worst()
    reached, limit = nearest(worst)
    advice = []
    if between.rooms is None and asked != "hold":
        advice = ['task.between = "hold" keeps the limits there']
    elif asked == "report":
        advice = ['without task.between = "report" they are kept there']
    at_knots = between.broken_at(worst.title, knots)
    jumps = np.count_nonzero(worst.times == worst.times[k]) > 1  # there, references are the same on both sides
    if at_knots:  # more of them would not help: it is there that something else is to be done
        advice = []
    elif not jumps:
        advice.append("more knots straighten it")
    told = f"; {', '.join(advice)}" if advice else ", at knots as well" * at_knots
    return (
        f"{worst.title} of {worst.items[i]} reaches {reached} at t = {plain(worst.times[k], 3)} s, "
        f"past its limit of {limit}{told}"
    )


def to_within(usages: Sequence[Usage]) -> str:
    """Return to within what limits hold that are missed by less than what counts as kept; nothing where none is."""
    missed = dict[str, Usage]()
    for usage in usages:  # of several of a name, as of several cases, the worst
        if usage.violation > max(LIMIT, missed[usage.title].violation if usage.title in missed else 0.0):
            missed[usage.title] = usage
    if not missed:
        return ""
    return f" ({', '.join(f'{usage.title} to within {_size(usage)}' for usage in missed.values())})"


def tolerated(plan: Plan) -> str:
    """Return by how much limits may be missed that count as kept, of those whose values are beyond their bounds."""
    tolerances = {check.name: check.tolerance for check in plan.checks}
    beyond = [usage for usage in plan.usages if usage.violation > LIMIT]
    told = (f"{_fine(tolerances[usage.title], usage.unit)} for the {usage.title}" for usage in beyond)
    return f"beyond the limit by less than the tolerance: {', '.join(told)}"


def _size(usage: Usage) -> str:
    return _fine(float(usage.excess.max()), usage.unit)


def _fine(value: float, unit: str) -> str:
    """Return a small value [`unit`] above 0, rounded up to two digits."""
    factor, name = FINE.get(unit, SHOWN_IN.get(unit, (1.0, unit)))
    return f"{plain(_rounded_up(factor * value), 2)} {name}".rstrip()


def _rounded_up(value: float) -> float:
    """Return a number above 0 with two digits, not below what it is."""
    unit = 10.0 ** (math.floor(math.log10(value)) - 1)
    return math.ceil(value / unit * (1 - 1e-9)) * unit
