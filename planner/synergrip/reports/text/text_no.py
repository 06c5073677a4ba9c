"""A no as text: what is to blame, when, what clashes, and what would help."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from shlex import quote

from synergrip.documents.quantities import plain
from synergrip.explain.explanation import Explanation
from synergrip.explain.repairs import Repair
from synergrip.explain.synergies.missing_synergies import MissingSynergies
from synergrip.explain.words import INTERRUPTED, changed, nearer, undone_share, values
from synergrip.linalg import Array
from synergrip.reports.text.tables import table, wrapped

FAR = {cause: " (up to 100 times)" for cause in ("friction", "duration")}
"""How far a number was turned of which no value helps, where it is not as far as it goes."""
AT_START = "in the linear model of the start posture"
LITTLE = 0.005
"""Share of a motion up to which it is not told that it is left undone."""
STOPS = "limits.joint_range: mechanical stops do not widen; it takes another hand or another start posture"
BEST = 3
"""Items of a limit that are named."""


def no_lines(found: Explanation, times: Array, place: Callable[[str], str], command: str = "") -> Iterator[str]:
    """Yield why there is no plan.

    Args:
        found: what is known.
        times: (T,) knots [s] of the task.
        place: says where a key stands: in the problem file, or on the command line.
        command: tells more than a short form knows.
    """
    yield from wrapped("Why      ", found.text)
    yield from more_lines(found, times, place, command)


def more_lines(found: Explanation, times: Array, place: Callable[[str], str], command: str = "") -> Iterator[str]:
    """Yield what is known beyond the reason; arguments as of `no_lines`."""
    late = found.when
    if where := when_words(late.first_s, late.intervals_s, late.alone, times, moves=found.moves):
        yield from wrapped("Where    ", where)
    if found.conflicts:
        yield from ("", "What clashes")
        rows = []
        for each in found.conflicts:
            more = f" and {len(each.items) - BEST} more" if len(each.items) > BEST else ""
            rows.append((each.key, share_words(each.share), ", ".join(each.items[:BEST]) + more, place(each.key)))
        yield table(("limit", "share of the proof", "at", "stated"), rows, right=(1,))
    yield from _repairs(found, command)
    if found.interrupted:
        yield from wrapped("note     ", INTERRUPTED)


def _repairs(found: Explanation, command: str) -> Iterator[str]:
    helped = found.pairs or any(each.verified for each in (*found.repairs, *found.others))
    if found.repairs:
        yield from _helping(found, command=command if not helped and not found.whole else "")
    if found.missing_synergies is not None:
        yield from _missing(found.missing_synergies)
    if found.others:
        too = ", too" if found.repairs or found.missing_synergies is not None else ""
        yield from ("", f"What would help{too}, tried and planned, and not the least there is")
        yield _changes([(each,) for each in found.others])
    if found.pairs:
        alone = any(each.verified for each in found.repairs)
        yield from ("", "Pairs of changes that help" if alone else "No single change helps; pairs that do")
        yield _changes(found.pairs)
    pairs = (each for pair in found.pairs for each in pair)
    if any(each.cause == "joint_range" for each in (*found.repairs, *found.others, *pairs)):
        yield from wrapped("         ", STOPS)
    if found.whole and not helped and not found.interrupted:
        pair = "" if found.posed is None else ", nor any pair"
        yield from wrapped("Help     ", f"no single change gives a plan of those that were tried{pair}")
    if found.clashing is not None:
        yield from wrapped("Clash    ", clash_words(found.clashing))
    if found.cannot_help:
        head, words = no_help_words(found.cannot_help, moves=found.moves)
        if found.moves:
            yield from ("", head, *wrapped("", words))
        else:
            yield from wrapped("No help  ", f"{head.removeprefix('No help ')}: {words}")


def no_help_words(causes: Sequence[str], *, moves: bool) -> tuple[str, str]:
    """Return in which model it is proven that no value of some numbers helps, and which numbers these are."""
    words = ", ".join(cause.replace("_", " ") + FAR.get(cause, "") for cause in causes)
    if moves:
        return f"No help {AT_START}, whatever the value (proven; not of the hand that moves)", words
    return f"No help proven of {AT_START.removeprefix('in ')}, whatever the value", words


def share_words(share: float) -> str:
    """Return a share of a proof."""
    return f"{share:.0%}" if share >= 0.01 else "< 1%"


def _helping(found: Explanation, *, command: str) -> Iterator[str]:
    """Yield the changes that help, and what is to be said of their values.

    Args:
        found: what is known.
        command: what looks for more, where no change of the short form has a plan; else empty.
    """
    if command:
        yield from ("", "No change that was tried has a plan yet; more are tried by", *wrapped("  ", command))
    else:
        smallest = "" if found.whole else f", the {len(found.repairs)} smallest" if len(found.repairs) > 1 else ""
        yield from ("", f"What would help{smallest}")
    yield _changes([(each,) for each in found.repairs])
    yield from _nearer([each for each in found.repairs if each.verified], whole=found.whole)
    if not all(each.verified or not each.tried for each in found.repairs):
        farther = "" if found.whole or command else "; synergrip explain plans with larger changes, too"
        told = "where no plan is found, the linear model of the start posture has one with that value"
        yield from wrapped("         ", f"{told}, and the hand that moves was tried with more{farther}")
    if not all(each.tried for each in found.repairs):
        told = (
            "what was not tried the linear model of the start posture has a plan with, too, and synergrip explain plans"
        )
        yield from wrapped("         ", f"{told} with it along the motion, which takes longer than goes with a no")


def _nearer(repairs: Sequence[Repair], *, whole: bool) -> Iterator[str]:
    """Yield how far values that the hand that moves has a plan with are from what its start posture takes."""
    if told := [said for said in map(nearer, repairs) if said]:
        between = "" if whole else "; synergrip explain tries values between"
        yield from wrapped("         ", f"the linear model of the start posture takes {', '.join(told)}{between}")


def _changes(rows: Sequence[tuple[Repair, ...]]) -> str:
    """Return a table of changes, each of one number or of several."""
    cells = [
        (changed(each) if k == 0 else f"and {changed(each)}", *values(each), f"--set {quote(each.set)}" * each.verified)
        for row in rows
        for k, each in enumerate(row)
    ]
    planned = [(again_words(each, undone_share(each)),) for row in rows for each in row]
    whole = [(*cell[:3], *said, cell[3]) for cell, said in zip(cells, planned, strict=True)]
    return table(("change", "from", "to", "planned again", "with"), whole)


def again_words(repair: Repair, share: float) -> str:
    """Return what planning with a change came to; `share` of the motion is left undone then."""
    if not repair.verified:
        return "no plan found" if repair.tried else "not tried"
    return f"{share:.0%} of the motion undone" if share >= LITTLE else "a plan"


def _missing(missing: MissingSynergies) -> Iterator[str]:
    """Yield how many synergies are missing, and who has columns that would do."""
    yield from wrapped("Missing  ", missing.why)
    if missing.candidates:
        rows = []
        for each in missing.candidates:
            said = each.verdict if not each.stage else f"{each.verdict} (stage: {each.stage})"
            setting = f"--set {quote(each.setting)}" if each.setting else ""
            names = f"all {len(each.names)} instead" if each.whole else " + ".join(each.names)
            rows.append((names, each.set, said, setting))
        yield from ("", "With other synergies")
        yield table(("columns", "of", "with them", "with"), rows)


def clash_words(keys: Sequence[str]) -> str:
    """Return which limits cannot hold together."""
    if not keys:
        return "load, motion and friction leave no plan by themselves, whatever the limits"
    if len(keys) == 1:
        return f"{keys[0]} with load, motion and friction: without any limits these are not proven to have no plan"
    return f"{', '.join(keys[:-1])} and {keys[-1]} cannot hold together; none of them can be left out of the proof"


def when_words(
    first: float | None, intervals: Sequence[Sequence[float]], alone: bool | None, times: Array, *, moves: bool
) -> str:
    """Return which instants have no plan; on a hand that moves, in which model.

    Args:
        first: the first of them [s], where it is known.
        intervals: from and to [s], of those without a plan even by themselves.
        alone: whether there are such.
        times: (T,) knots [s] of the task.
        moves: whether it is a hand that moves.
    """
    model = f"{AT_START} " if moves else ""
    if first is None or len(times) < 2:
        return ""
    if alone is False:
        together = f"together they have none up to t = {plain(first)} s"
        return f"{model}every instant has a plan by itself; for the steps between them, {together}"
    ends = [_stretch(start, end, times) for start, end in intervals]
    return f"{', '.join(ends)}: {model}none of these instants has a plan even by itself"


def _stretch(start: float, end: float, times: Array) -> str:
    if start <= times[0] and end >= times[-1]:
        return "throughout"
    return f"t = {plain(start)} s" if start == end else f"t = {plain(start)} s to {plain(end)} s"
