"""What judged references break: each limit where, when and by how much, and contacts that do not hold."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from synergrip.conic.limits.limit import Usage
from synergrip.conic.limits.ties import first_largest
from synergrip.documents.quantities import both_apart, in_mm, plain, read_as
from synergrip.documents.words import listed
from synergrip.linalg import Array
from synergrip.planning.between import LIMIT
from synergrip.planning.check import LINEAR, RIGID, Judgement
from synergrip.planning.in_balance import BALANCE, out_of_balance
from synergrip.planning.in_cases import ALL_CASES
from synergrip.planning.outcome import BETWEEN, Check
from synergrip.planning.verified import EQUILIBRIUM
from synergrip.statics.unbalanced_springs import unbalanced_springs

STABILITY = "stability"
PULLED = 1e-6
"""Share of the largest force below which a pull, or a slip, is rounding."""


def names_of(judgement: Judgement) -> tuple[str, ...]:
    """Return what is broken by its names, each once, wherever it is."""
    places = {f"{BETWEEN}: ": " between the knots", f"{ALL_CASES}: ": " in what is allowed for", LINEAR: ""}
    names = dict[str, None]()
    for check in _failed(judgement):
        if check.name == BETWEEN and not _between_alone(judgement):
            continue
        place = next((each for each in places if check.name.startswith(each)), "")
        name = check.name.removeprefix(place).removesuffix(" [m]")
        if name not in names:
            names[f"{name}{places.get(place, '')}"] = None
    return tuple(names)


def broken(judgement: Judgement) -> Iterator[str]:
    """Yield what is broken: the worst of each limit, where, when and by how much; that of the claims is another matter.

    A limit that is broken at the knots and between them is told once, with the worse of both.
    """
    failed = {check.name: check for check in _failed(judgement)}
    told = set[str]()
    for check in failed.values():
        name = check.name.removeprefix(f"{BETWEEN}: ").removeprefix(LINEAR)
        if name in told or check.name.startswith(ALL_CASES):
            continue
        told.add(name)
        yield from _of(judgement, check, name, failed.get(f"{BETWEEN}: {name}"))
    yield from _in_cases(judgement, list(failed.values()))


def not_holding(judgement: Judgement) -> Iterator[str]:
    """Yield which contacts would come off or slip, as the figures are those of contacts that do neither."""
    times, names = judgement.motion.times, judgement.analysis.grasp.contact_names
    forces = judgement.motion.forces
    least = PULLED * float(np.abs(forces).max(initial=0.0))
    ends = []
    pulls = -forces[:, judgement.analysis.grasp.normal_rows]
    for what, sizes in (("come off", pulls), ("slip", -judgement.margins)):
        there = sizes > least
        if what == "slip":  # one that comes off is told as that
            there = there & ~(pulls > least)
        if np.any(there):
            i = [names[i] for i in np.flatnonzero(there.any(axis=0))]
            t = plain(float(times[np.flatnonzero(there.any(axis=1))[0]]), 3)
            ends.append(f"{listed(i)} would {what} (first at t = {t} s)")
    if ends:
        pulled = ", also when pulled" if np.any(pulls > least) else ""
        yield f"{' and '.join(ends)}: the figures are those of contacts that stick whatever happens{pulled}"


def _failed(judgement: Judgement) -> list[Check]:
    return [check for check in judgement.checks if not check.passed and check not in judgement.claims.checks]


def _between_alone(judgement: Judgement) -> list[Usage]:
    """Return what is used, between the knots, of the limits that are broken there and kept at the knots."""
    there = () if judgement.between is None else judgement.between.broken
    at_knots = {check.name for check in _failed(judgement)}
    return [usage for usage in there if usage.title not in at_knots]


def _of(judgement: Judgement, check: Check, name: str, also: Check | None) -> Iterator[str]:
    """Yield what is to be said of one that failed, and failed between the knots as well."""
    usage = next((each for each in judgement.usages if each.title == name), None)
    if name == EQUILIBRIUM and judgement.lost:
        if not judgement.stands_in:  # else the verdict says so
            yield judgement.lost
    elif name == RIGID and judgement.off is not None:
        yield _behind(judgement.off, judgement.motion.times, check.tolerance)
    elif name == BETWEEN and judgement.between is not None:  # one check of all limits, of the linear model
        for each in _between_alone(judgement):
            yield from _sides(each, LIMIT * each.size, None, f"{BETWEEN}: ")
    elif usage is not None:
        place = LINEAR if check.name.startswith(LINEAR) else f"{BETWEEN}: " if check.name != name else ""
        room = np.full(usage.value.shape, check.tolerance) if judgement.executed is not None else LIMIT * usage.size
        between = () if judgement.between is None or not (also or place) else judgement.between.usages
        worst = next((each for each in between if each.title == name), usage)
        allowed = room if worst is usage else np.full(worst.value.shape, check.tolerance)
        yield from _sides(worst, allowed, None if place == f"{BETWEEN}: " else (usage, room), place)
    elif name == STABILITY:
        yield f"{check.name}: the equilibrium gives way, its least stiffness is {read_as(-check.error, 'N/m', 3)}"
    elif name == BALANCE and (found := unbalanced_springs(judgement.analysis.grasp)) is not None:
        yield out_of_balance(found, judgement.analysis.grasp)
    else:
        yield f"{check.name}: off by {check.error:.2g}, {check.tolerance:.0e} allowed"


def _behind(off: Array, times: Array, tolerance: float) -> str:
    k = first_largest(off[:, None], 1e-6 * float(off.max()))[0]
    where = f"{in_mm(float(off[k]))} from where it is wanted at t = {plain(float(times[k]), 3)} s"
    return f"the object is {where}, {in_mm(tolerance)} allowed{_at(off > tolerance)}"


def _sides(usage: Usage, room: Array, at: tuple[Usage, Array] | None, place: str) -> Iterator[str]:
    """Yield the worst on either side of a limit that is broken, and at how many knots that side is."""
    for side in (1, -1):
        excess = _beyond(usage, side)
        if not np.any(excess > room):
            continue
        k, i = first_largest(excess / usage.scale)
        bound = float((usage.upper if side > 0 else usage.lower)[i])
        shown, limit = both_apart(float(usage.value[k, i]), bound, usage.unit)
        count = "" if at is None else _at(np.any(_beyond(at[0], side) > at[1], axis=1))
        by, way = read_as(float(excess[k, i]), usage.unit, 3), "above" if side > 0 else "below"
        yield (
            f"{place}{usage.title} of {usage.items[i]} is {shown} at t = {plain(float(usage.times[k]), 3)} s, "
            f"{by} {way} its limit of {limit}{count}"
        )


def _beyond(usage: Usage, side: int) -> Array:
    return usage.value - usage.upper if side > 0 else usage.lower - usage.value


def _at(beyond: NDArray[np.bool_]) -> str:
    """Return at how many knots; nothing where there is one."""
    if len(beyond) == 1 or not np.any(beyond):
        return ""
    return f"; at {int(np.sum(beyond))} of {len(beyond)} knots"


def _in_cases(judgement: Judgement, failed: list[Check]) -> Iterator[str]:
    """Yield what is broken in cases that the task allows for."""
    titles = {check.name.removeprefix(f"{ALL_CASES}: "): check for check in failed if check.name.startswith(ALL_CASES)}
    if judgement.missed_in_cases:
        yield from (f"{ALL_CASES}: {told}" for told in judgement.missed_in_cases)
    for title, check in titles.items():
        of = [(case, usage) for case in judgement.cases for usage in case.usages if usage.title == title]
        if not of:
            if title != EQUILIBRIUM:
                yield f"{check.name}: {plain(check.error, 3)}, {plain(check.tolerance, 3)} allowed"
        elif not judgement.missed_in_cases:
            case, usage = max(of, key=lambda pair: pair[1].violation)
            yield from _sides(usage, LIMIT * usage.size, None, f"{ALL_CASES}: {case.title}: ")
