"""Why there is no plan: what is to blame, what clashes, when, and what would help."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from itertools import chain

from synergrip.changes.asked import STATED, Asked, Posed
from synergrip.changes.at_a_value import solved
from synergrip.changes.least_change import LeastChange, least_change
from synergrip.changes.turning import dials
from synergrip.conic.conflicts import Conflict
from synergrip.conic.limits.dial import Cause, Dial
from synergrip.conic.limits.friction_cone import FRICTION
from synergrip.conic.limits.slip_margin import KEY
from synergrip.explain.along import FIRST, as_far_as_followed, more_knots, near_enough, tried, tried_briefly
from synergrip.explain.explanation import STAGES, Explanation
from synergrip.explain.long_form import completed
from synergrip.explain.refused import refused
from synergrip.explain.repairs import UNLIMITED, Repair, by_size, ranked, repaired
from synergrip.explain.synergies.candidates import INTERRUPTED
from synergrip.explain.when import NOT_KNOWN, when
from synergrip.explain.words import blamed, most_margin
from synergrip.log import LONG
from synergrip.planning.outcome import Infeasible, Unknown
from synergrip.planning.pace import BRIEF, SHORT, WHOLE, Effort

BEST = 3
"""Repairs of the short form."""
UNANSWERED = "solver"
"""Stage of an answer that ended at the start posture: what is short is not looked for along the motion, which takes
many times as long."""
ROUGH = 2e-3
"""Share of a change within which the short form bisects, on a hand, which is asked for 2 % more anyway."""
PASSES, FOR_EACH = 4, 8
"""Passes along the motion that the short form makes in all where planning ended at the start posture, and how many more
for each program that planning took: an answer costs some twenty times what planning did, at most."""
SAMPLED = "allow.scenarios."
"""How the keys begin of what is tried first where samples of the grasp miss."""
SMALL = math.log(FIRST[0])
"""Change than which no smaller one is tried."""


def explained(
    no: Infeasible | Unknown, *, short: bool = False, heard: Callable[[Repair], None] = lambda repair: None
) -> Explanation:
    """Return why there is no plan.

    Args:
        no: what `plan` said.
        short: whether the three smallest changes are enough, and what is short of them is not looked at.
        heard: is told of each repair as it is found.
    """
    try:
        found = _explained(no, short=short, heard=heard)
    except KeyboardInterrupt:  # what plan said is known all the same
        cause, known = _blamed(no, (), [], ())
        found = Explanation(cause, no.why, known, (), (), NOT_KNOWN, whole=False, interrupted=True)
    missing = () if found.missing_synergies is None else found.missing_synergies.notes
    moves = no.grasp.held is not None and no.task.linearise == "along"
    return replace(found, moves=moves, interrupted=found.interrupted or INTERRUPTED in missing)


def _explained(no: Infeasible | Unknown, *, short: bool, heard: Callable[[Repair], None]) -> Explanation:
    """Return why there is no plan; arguments as of `explained`."""
    timed = no.task
    sampled = timed.allowed is not None and timed.allowed.scenarios is not None and no.grasp.held is not None
    missed = sampled and isinstance(no, Unknown)  # maybe by scenarios alone: changes are to keep them, too
    asked = Asked.of(no.grasp, timed if no.asked is None else no.asked, timed, scenarios=missed)
    posed = asked.posed(no.analysis)
    if posed is None or (isinstance(no, Infeasible) and no.stage in STAGES):
        return refused(no, asked, short=short)
    program = posed.program()
    decision = solved("any plan", program)
    if isinstance(no, Unknown) and not decision.infeasible:
        if missed and short:  # each change takes as many samples as the plan
            return Explanation(_cause(no, (), []), no.why, (), (), (), NOT_KNOWN, whole=False)
        return _of_the_motion(no, asked, posed, short=short, heard=heard)
    LONG.debug("looking for what the start posture takes of each number")
    numbers = dials(asked, timed, posed.analysis)
    try:
        rough = ROUGH if short and no.grasp.held is not None else 0.0
        found = [least_change(dial, posed, program, rough=rough, no=decision) for dial in numbers]
    except KeyboardInterrupt:  # what plan said is known all the same
        cause, known = _blamed(no, (), [], numbers)
        return Explanation(cause, no.why, known, (), (), NOT_KNOWN, whole=False, interrupted=True, posed=posed)
    helping = ranked([each for each in found if each.size > 0])
    walked = isinstance(no, Unknown) and no.stage != UNANSWERED
    most, effort = (BEST, WHOLE if walked else SHORT) if short else (None, WHOLE)
    passes = PASSES + FOR_EACH * sum(each.attempts for each in no.decisions) if effort.brief else UNLIMITED
    planned, interrupted = _as_found(
        repaired(helping, posed, most=most, prove=not short, effort=effort, passes=passes, heard=heard)
    )
    others: list[Repair] = []
    if isinstance(no, Unknown) and (walked or not short) and not interrupted:
        known_to_help = short and any(each.verified for each in planned)
        turned = [each.dial for each in helping] if known_to_help else numbers
        left, brief = _with_room(turned, planned), WHOLE if known_to_help else BRIEF
        others, interrupted = _tried(no, asked, posed, left, heard, short=short, effort=brief)
    held, rest = _smaller(planned, others)
    cause, known = _blamed(no, held, helping, numbers)
    text, in_vain = _text(no, held, known, interrupted=interrupted), _in_vain(found)
    text = f"{text}; {STATED}" if sampled and not missed and held else text
    known = _without_margins(known) if "margin" in in_vain else known
    in_vain = tuple(cause for cause in in_vain if not any(each.cause == cause for each in rest))
    first = Explanation(cause, text, known, held, in_vain, NOT_KNOWN, not short, interrupted, posed=posed, others=rest)
    try:
        strict = posed if posed.strict else asked.posed(no.analysis, every=True)
        first = first if strict is None else replace(first, when=when(strict))
    except KeyboardInterrupt:
        return replace(first, interrupted=True)
    return first if short or interrupted else completed(no, first, asked, posed, program, numbers, heard)


def _with_room(numbers: Sequence[Dial[Asked]], held: Sequence[Repair]) -> list[Dial[Asked]]:
    """Return the numbers of which the hand that moves may need less than the start posture, or something else."""
    small = {each.key for each in held if each.verified and each.size < SMALL}
    return [dial for dial in numbers if dial.key not in small]


def _smaller(planned: Sequence[Repair], others: Sequence[Repair]) -> tuple[tuple[Repair, ...], tuple[Repair, ...]]:
    """Return the changes, the smaller of two where the hand that moves needs less than its start, and others."""
    if not others:
        return tuple(planned), ()
    least = {each.key: each.least for each in planned}
    other = {each.key: replace(each, least=least.get(each.key)) for each in others}
    held = [min(each, other.get(each.key, each), key=lambda one: (not one.verified, one.size)) for each in planned]
    keys = {each.key for each in held}
    ordered = by_size(held, lambda each: each.size, lambda each: each.cause)
    return tuple(ordered), tuple(each for each in others if each.key not in keys)


def _of_the_motion(
    no: Unknown, asked: Asked, posed: Posed, *, short: bool, heard: Callable[[Repair], None]
) -> Explanation:
    """Return what is known of a motion that the start posture has a plan for, and the hand that moves has none."""
    cause = _cause(no, (), [])
    numbers = sorted(dials(asked, no.task, posed.analysis), key=lambda dial: not dial.key.startswith(SAMPLED))
    knots = more_knots(asked, heard, BRIEF if short else WHOLE) if no.between_only else ()
    found, interrupted = _as_found(knots)
    if not interrupted:
        more, interrupted = _tried(no, asked, posed, numbers, heard, short=short)
        found += more
    others = tuple(sorted(found, key=lambda each: each.size))
    return Explanation(cause, no.why, (), (), (), NOT_KNOWN, not short, interrupted, others=others)


def _tried(
    no: Unknown, asked: Asked, posed: Posed, numbers: Sequence[Dial[Asked]], heard: Callable[[Repair], None], *,
    short: bool, effort: Effort = BRIEF,
) -> tuple[list[Repair], bool]:  # fmt: skip
    """Return changes that are tried along the motion, and whether somebody interrupted.

    A tolerance comes first where it is known by how much the motion is not reached, and is not tried twice. In the
    short form as much of the motion as was followed comes next; the long one looks for more of it by itself.
    """
    near = no.reached is not None and no.reached.off_m is not None
    left = [dial for dial in numbers if not (near and dial.cause == "tolerance")]
    if not short:
        return _as_found(chain(near_enough(no, asked, posed, heard, short=False), tried(left, heard)))
    followed = as_far_as_followed(no, numbers, posed, heard)
    found, interrupted = _as_found(chain(near_enough(no, asked, posed, heard, short=True), followed))
    if interrupted:
        return found, True
    known = {each.cause for each in found}
    more, interrupted = _as_found(tried_briefly([dial for dial in left if dial.cause not in known], heard, effort))
    return found + more, interrupted


def _as_found(repairs: Iterable[Repair]) -> tuple[list[Repair], bool]:
    """Return repairs, and whether somebody interrupted before they were all there."""
    found: list[Repair] = []
    try:
        for repair in repairs:
            found.append(repair)
    except KeyboardInterrupt:
        return found, True
    return found, False


def _cause(
    no: Infeasible | Unknown, held: tuple[Repair, ...], helping: list[LeastChange], numbers: Sequence[Dial[Asked]] = ()
) -> Cause:
    """Return what is to blame: the smallest change, or the stage, or else the limit with most of the proof."""
    if held:
        return held[0].cause
    if isinstance(no, Unknown):
        return STAGES.get(no.stage, "reach")
    if helping:
        return helping[0].dial.cause
    chief = next((each for each in no.conflicts if not each.friction), None)
    own: Cause = next((dial.cause for dial in numbers if chief is not None and dial.key == chief.key), "limit")
    return "friction" if chief is None else own


def _text(no: Infeasible | Unknown, held: tuple[Repair, ...], known: tuple[Conflict, ...], *, interrupted: bool) -> str:
    """Return what is to blame, where it shows, and since when; the reason of the answer where no change helps."""
    if isinstance(no, Unknown) or not held:
        none = "" if isinstance(no, Unknown) or interrupted else "no single change of a number helps; "
        return f"{none}{no.why}"
    cones = next((each for each in known if each.friction), None)
    shows = f"; it shows in the friction cones of {', '.join(cones.items)}" if cones else ""
    margin = "" if no.largest_margin is None or no.largest_margin < 0 or not no.task.margin else most_margin(no)
    there = "" if held[0].verified else " in the linear model of the start posture (no plan was found with it)"
    return blamed(held[0]) + there + margin + shows


def _blamed(
    no: Infeasible | Unknown, held: tuple[Repair, ...], helping: list[LeastChange], numbers: Sequence[Dial[Asked]]
) -> tuple[Cause, tuple[Conflict, ...]]:
    """Return what is to blame, and what clashes, with what is to blame first."""
    cause = _cause(no, held, helping, numbers)
    known = no.conflicts if isinstance(no, Infeasible) else ()
    blamed = next((each.dial.key for each in helping if each.dial.cause == cause), "")
    if cause == "friction":
        return cause, tuple(sorted(known, key=lambda each: not each.friction))
    return cause, tuple(sorted(known, key=lambda each: each.key != blamed))


def _without_margins(known: tuple[Conflict, ...]) -> tuple[Conflict, ...]:
    """Return what clashes with friction cones under their own name, where no margin of theirs is at fault."""
    return tuple(replace(each, key=FRICTION) if each.friction and each.key == KEY else each for each in known)


def _in_vain(found: list[LeastChange]) -> tuple[Cause, ...]:
    """Return the causes of which no value helps, proven; of several numbers that are turned one by one nothing is."""
    causes = [each.dial.cause for each in found]
    vain = (each.dial.cause for each in found if each.value is None and each.proven)
    return tuple(cause for cause in vain if causes.count(cause) == 1)
