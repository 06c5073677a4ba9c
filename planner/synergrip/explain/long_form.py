"""What takes longer to find out of a no: which limits clash, pairs of changes, single contacts, stiffness."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

import numpy as np

from synergrip.changes.asked import Asked, Posed
from synergrip.changes.least_change import least_change
from synergrip.changes.turning import contact_dials, stiffness_dial
from synergrip.conic.limits.dial import Dial
from synergrip.conic.program import Program
from synergrip.explain.along import first_repair, second_changes
from synergrip.explain.clashing import clashing
from synergrip.explain.explanation import Explanation
from synergrip.explain.pairs import GIVEN, pairs
from synergrip.explain.repairs import Repair, ranked, repaired
from synergrip.explain.synergies.missing_synergies import missing_synergies
from synergrip.planning.outcome import Infeasible, Unknown

LARGE = math.log(2)
"""Change of a single limit than which two smaller ones are looked for."""
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
        single = [each.size for each in first.repairs if each.verified and each.cause not in GIVEN]
        least = min(single, default=np.inf)
        for pair in _pairs(first, posed, program, numbers) if least > LARGE else ():
            if max(each.size for each in pair) < least:
                known = replace(known, pairs=(*known.pairs, pair))
        if isinstance(no, Infeasible):
            known = replace(known, missing_synergies=missing_synergies(no))
    except KeyboardInterrupt:
        return replace(known, interrupted=True)
    return known


def _pairs(
    first: Explanation, posed: Posed, program: Program, numbers: Sequence[Dial[Asked]]
) -> Iterator[tuple[Repair, Repair]]:
    """Return pairs of changes with a plan, where no single limit has one, or only a large change of it."""
    alone = any(each.verified for each in first.repairs)
    along = first.repairs and not alone
    return second_changes(first.repairs, numbers, posed) if along else pairs(numbers, posed, program)


def _others(asked: Asked, posed: Posed, program: Program, heard: Callable[[Repair], None]) -> Iterator[Repair]:
    """Yield changes of the friction of single contacts, and of the stiffness, with which there is a plan."""
    alone = [least_change(dial, posed, program) for dial in contact_dials(asked).values()]
    for repair in repaired(ranked(alone), posed, heard=heard):
        if repair.verified:
            yield repair
    dial = stiffness_dial(asked)
    stiffer = first_repair(dial, [dial.value * factor for factor in STIFFER])
    if stiffer is not None:
        heard(stiffer)
        yield stiffer
