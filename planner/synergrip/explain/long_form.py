"""What takes longer to find out of a no: which limits clash, pairs of changes, single contacts, stiffness."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

from synergrip.conic.limits.dial import Dial
from synergrip.conic.program import Program
from synergrip.explain.asked import Asked, Posed
from synergrip.explain.clashing import clashing
from synergrip.explain.explanation import Explanation
from synergrip.explain.least_change import least_change
from synergrip.explain.pairs import pairs
from synergrip.explain.repairs import Repair, outcome_of, ranked, repaired
from synergrip.explain.synergies.missing_synergies import missing_synergies
from synergrip.explain.turning import contact_dials, stiffness_dial
from synergrip.planning.outcome import Infeasible, Plan, Unknown

ALONG = (1.25, 2.0, 5.0, 20.0, 100.0)
"""Factors that are tried of each number where only the hand that moves has no plan."""
STIFFER = (2.0, 0.5, 5.0, 0.2)
"""Factors of stiffness that are tried; no claim is made of others."""


def completed(
    no: Infeasible | Unknown, first: Explanation, asked: Asked, posed: Posed, program: Program,
    numbers: Sequence[Dial[Asked]], heard: Callable[[Repair], None],
) -> Explanation:  # fmt: skip
    """Return an explanation with what takes longer; an interrupt keeps what is found.

    Args:
        no: what `plan` said.
        first: what is known so far.
        asked: what is asked.
        posed: the same, as a program of the start posture.
        program: that program.
        numbers: all that could be others.
        heard: is told of each repair as it is found.
    """
    known = first
    try:
        known = replace(known, clashing=clashing(asked))
        for other in _others(asked, posed, program, heard):
            known = replace(known, others=(*known.others, other))
        for pair in () if any(each.verified for each in first.repairs) else pairs(numbers, posed, program):
            known = replace(known, pairs=(*known.pairs, pair))
        if isinstance(no, Infeasible):
            known = replace(known, missing_synergies=missing_synergies(no))
    except KeyboardInterrupt:
        return replace(known, interrupted=True)
    return known


def _others(asked: Asked, posed: Posed, program: Program, heard: Callable[[Repair], None]) -> Iterator[Repair]:
    """Yield changes of the friction of single contacts, and of the stiffness, with which there is a plan."""
    alone = [least_change(dial, posed, program) for dial in contact_dials(asked)]
    for repair in repaired(ranked(alone), posed, heard=heard):
        if repair.verified:
            yield repair
    dial = stiffness_dial(asked)
    yield from _first_with_a_plan(dial, STIFFER, heard)


def tried_along(numbers: Sequence[Dial[Asked]], heard: Callable[[Repair], None]) -> Iterator[Repair]:
    """Yield of each number the first of some values with which there is a plan along the motion.

    Args:
        numbers: that could be others.
        heard: is told of each.
    """
    for dial in numbers:
        factors = ALONG if dial.eased == "up" else [1 / factor for factor in ALONG]
        low, high = sorted((dial.value, dial.end))
        values = [value for value in (dial.value * factor for factor in factors) if low <= value <= high]
        yield from _first_with_a_plan(dial, values, heard)


def _first_with_a_plan(dial: Dial[Asked], values: Sequence[float], heard: Callable[[Repair], None]) -> Iterator[Repair]:
    """Yield the first of some values with which there is a plan."""
    for value in values:
        outcome = outcome_of(dial.turned(value)) if value != dial.value else None
        if isinstance(outcome, Plan):
            found = Repair.of(dial, value, outcome)
            heard(found)
            yield found
            return
