"""What helps where only the hand that moves has no plan: values that are tried along the motion, one by one.

Nothing here is the least of its kind, and of what is not found nothing is claimed.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence

import numpy as np

from synergrip.changes.asked import Asked, Posed
from synergrip.changes.at_a_value import between, first_plan
from synergrip.changes.turning import dials, knots_dial, tolerance_dial
from synergrip.conic.limits.dial import Dial
from synergrip.explain.repairs import Repair, beyond
from synergrip.planning.outcome import Unknown
from synergrip.planning.pace import BRIEF, WHOLE, Effort
from synergrip.tasks.tracking import target_displacement

FACTORS = (1.25, 2.0, 5.0, 20.0, 100.0)
"""Of each number, toward more room."""
FIRST = (1.25, 2.0)
"""The same in the short form."""
PARTS = (2, 4)
"""Into how many each step from knot to knot is parted."""
HALVES = 3
"""How often what lies between the last factor without and the first with a plan is halved."""
FEW = 3
"""How many numbers the short form tells, and single changes to each of which a second one is looked for."""
NEARLY = (1.0, 1.25, 2.0)
"""How many times as far as the object is off is tried as its tolerance; the first two in the short form."""
ALMOST, LEAST_PART = (1.0, 0.97), 0.05
"""Which shares of the part of a motion that was followed are tried as its size in the short form, and what part is
worth it."""
ROOMY = 0.05
"""How much farther than the start posture needs a number goes to which a second one is looked for."""


def tried(numbers: Sequence[Dial[Asked]], heard: Callable[[Repair], None]) -> Iterator[Repair]:
    """Yield of each number the first of some values with which there is a plan along the motion, halved a few times.

    Args:
        numbers: that could be others.
        heard: is told of each.
    """
    for dial in numbers:
        found = first_repair(dial, _values(dial, FACTORS))
        if found is not None:
            nearer = _nearer(dial, found)
            heard(nearer)
            yield nearer


def more_knots(asked: Asked, heard: Callable[[Repair], None], effort: Effort = WHOLE) -> Iterator[Repair]:
    """Yield the first of some more knots with which there is a plan, those that there are among them."""
    dial = knots_dial(asked)
    if dial is None:
        return
    found = first_repair(dial, [parts * (dial.value - 1) + 1 for parts in PARTS], effort)
    if found is not None:
        heard(found)
        yield found


def near_enough(
    no: Unknown, asked: Asked, posed: Posed, heard: Callable[[Repair], None], *, short: bool
) -> Iterator[Repair]:
    """Yield the tolerance within which a motion is followed that is off by a known distance, where there is a plan."""
    off = None if no.reached is None else no.reached.off_m
    if off is None:
        return
    dial = tolerance_dial(asked, no.task, posed.analysis)
    values = [_two_digits(factor * off) for factor in (NEARLY[:2] if short else NEARLY)]
    found = first_repair(dial, values, BRIEF if short else WHOLE)
    if found is not None:
        heard(found)
        yield found


def as_far_as_followed(
    no: Unknown, numbers: Sequence[Dial[Asked]], posed: Posed, heard: Callable[[Repair], None]
) -> Iterator[Repair]:
    """Yield how much of a motion has a plan, about as much as was followed of it."""
    dial = next((each for each in numbers if each.cause == "amplitude"), None)
    if no.reached is None or dial is None:
        return
    scale, wanted = posed.analysis.response.scale, target_displacement(posed.analysis, no.task, no.task.target.values)
    whole = float(np.linalg.norm(scale.twist(wanted), axis=1).max(initial=0.0))
    part = float(np.linalg.norm(scale.twist(no.reached.pose[None]))) / whole if whole > 0 else 0.0
    if not LEAST_PART < part < 1:
        return
    found = first_repair(dial, [dial.rounded(dial.value * part * share) for share in ALMOST], BRIEF)
    if found is not None:
        heard(found)
        yield found


def _two_digits(value: float) -> float:
    """Return a value above 0 rounded up to two digits."""
    digit = 10.0 ** (math.floor(math.log10(value)) - 1)
    return float(f"{math.ceil(value / digit) * digit:.2g}")


def _nearer(dial: Dial[Asked], found: Repair) -> Repair:
    """Return a smaller change that has a plan, too, by halves of what lies before the one that was found."""
    factors = [value for value in _values(dial, FACTORS) if abs(value - dial.value) < abs(found.to - dial.value)]
    without = factors[-1] if factors else dial.value
    for _ in range(HALVES):
        value = dial.rounded(between(without, found.to))
        nearer = first_repair(dial, [value])
        found, without = (found, value) if nearer is None else (nearer, without)
    return found


def tried_briefly(
    numbers: Sequence[Dial[Asked]], heard: Callable[[Repair], None], effort: Effort = BRIEF
) -> Iterator[Repair]:
    """Yield a few numbers with the smallest factor that a plan is soon found with, by an effort; else as `tried`."""
    told = 0
    for factor in FIRST:
        for dial in numbers:
            found = first_repair(dial, _values(dial, (factor,)), effort)
            if found is not None:
                heard(found)
                yield found
                told += 1
            if told == FEW:
                return
        if told:
            return


def second_changes(
    first: Sequence[Repair], numbers: Sequence[Dial[Asked]], posed: Posed
) -> Iterator[tuple[Repair, Repair]]:
    """Yield pairs with a plan along the motion: a change that the start posture has a plan with, and another number.

    Args:
        first: changes that give the start posture a plan, and the hand that moves none.
        numbers: that could be others.
        posed: what was asked, as a program of the start posture.
    """
    for repair in first[:FEW]:
        one = next(dial for dial in numbers if dial.key == repair.key and dial.value == repair.was)
        to = beyond(one, repair.to, ROOMY)
        changed = one.turned(to)
        for two in dials(changed, changed.timed, posed.analysis):
            second = first_repair(two, _values(two, FACTORS), BRIEF) if two.key != one.key else None
            if second is not None:
                yield Repair.of(one, to, second.outcome), second


def first_repair(dial: Dial[Asked], values: Sequence[float], effort: Effort = WHOLE) -> Repair | None:
    """Return the first of some values with which there is a plan, if any."""
    found = first_plan(dial, values, effort)
    return None if found is None else Repair.of(dial, *found)


def _values(dial: Dial[Asked], factors: Sequence[float]) -> list[float]:
    """Return other values of a number, within how far it may go."""
    turned = [dial.value * factor if dial.eased == "up" else dial.value / factor for factor in factors]
    low, high = sorted((dial.value, dial.end))
    return [value for value in turned if low <= value <= high and value != dial.value]
